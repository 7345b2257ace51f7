// Minimal problems that are well posed but lie where formulas like to break: image points at the principal point, views along the
// normal of the points' plane, thin or small triangles, rays in special position.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace test {

// A query, points in its view and, for problems with rays, rig points on the rays and the centres.
struct Scene {
  FocalPose query;
  std::vector<Eigen::Vector3d> points, rayPoints, centres;
};

struct AwkwardCase {
  std::string name;
  bool needsRay;
  std::function<void(Scene&, Random&)> apply;
};

// Turns the query so that it sees `target` at the principal point, but for `offset` (tangent of the angle).
inline void lookAt(Scene& scene, const Eigen::Vector3d& target, double offset, Random& random) {
  const Eigen::Vector3d z = (target - scene.query.position).normalized();
  const Eigen::Vector3d x = z.cross(random.direction()).normalized();
  scene.query.rotation << x, z.cross(x), z;
  if (offset != 0) scene.query.rotation = Eigen::AngleAxisd(offset, x) * scene.query.rotation;
}

// Moves the points towards the plane through their mean that is parallel to the image, by the factor `flatness`.
inline void flattenAlongView(Scene& scene, double flatness) {
  const Eigen::Vector3d z = scene.query.rotation.col(2);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) mean += scene.points[i] / 3;
  for (std::size_t i = 0; i < 3; ++i) scene.points[i] -= (1 - flatness) * z * z.dot(scene.points[i] - mean);
}

inline Eigen::Vector3d planeNormal(const Scene& scene) {
  return (scene.points[1] - scene.points[0]).cross(scene.points[2] - scene.points[0]).normalized();
}

// Turns the ray about its point so that it makes the angle `angle` with `direction`.
inline void aimRay(Scene& scene, const Eigen::Vector3d& direction, double angle, Random& random) {
  const Eigen::Vector3d axis = direction.cross(random.direction()).normalized();
  scene.centres[0] = scene.rayPoints[0] - 15 * (Eigen::AngleAxisd(angle, axis) * direction);
}

inline std::vector<AwkwardCase> awkwardCases() {
  std::vector<AwkwardCase> cases;
  const auto add = [&](const std::string& name, bool needsRay, const std::function<void(Scene&, Random&)>& apply) {
    cases.push_back({name, needsRay, apply});
  };
  for (double offset : {1e-3, 0.0}) {
    const std::string suffix = offset > 0 ? " near the centre" : " at the centre";
    for (std::size_t k : {0u, 1u, 2u})
      add("X" + std::to_string(k + 1) + suffix, false,
          [=](Scene& scene, Random& random) { lookAt(scene, scene.points[k], offset, random); });
    add("X4" + suffix, false, [=](Scene& scene, Random& random) {
      if (scene.points.size() > 3) lookAt(scene, scene.points[3], offset, random);
    });
    add("ray" + suffix, true, [=](Scene& scene, Random& random) { lookAt(scene, scene.rayPoints[0], offset, random); });
  }
  for (const char* flatness : {"0.1", "0.01", "1e-3", "1e-5", "0"})
    add(std::string("fronto-parallel, flattened to ") + flatness, false,
        [=](Scene& scene, Random&) { flattenAlongView(scene, std::atof(flatness)); });
  for (double size : {0.1, 0.01})
    add(size > 0.05 ? "triangle of 1/10" : "triangle of 1/100", false, [=](Scene& scene, Random&) {
      const Eigen::Vector3d centre = scene.points[0];
      for (std::size_t i = 1; i < 3; ++i) scene.points[i] = centre + size * (scene.points[i] - centre);
    });
  for (double thickness : {0.1, 0.01})
    add(thickness > 0.05 ? "triangle of thickness 1/10" : "triangle of thickness 1/100", false,
        [=](Scene& scene, Random& random) {
          const Eigen::Vector3d along = random.direction();
          const Eigen::Vector3d origin = scene.points[0];
          for (std::size_t i = 1; i < 3; ++i) {
            const Eigen::Vector3d d = scene.points[i] - origin;
            scene.points[i] = origin + thickness * d + (1 - thickness) * along * along.dot(d);
          }
        });
  add("coplanar points", false, [](Scene& scene, Random&) {
    if (scene.points.size() < 4) return;
    const Eigen::Vector3d n = planeNormal(scene);
    scene.points[3] -= n * n.dot(scene.points[3] - scene.points[0]);
  });
  add("ray parallel to the plane", true,
      [](Scene& scene, Random& random) { aimRay(scene, planeNormal(scene).cross(random.direction()).normalized(), 0, random); });
  for (const char* angle : {"1e-2", "1e-4", "0"})
    add(std::string("ray normal to the plane, up to ") + angle, true,
        [=](Scene& scene, Random& random) { aimRay(scene, planeNormal(scene), std::atof(angle), random); });
  for (const char* offset : {"1e-3", "0"})
    add(std::string("ray in the plane, up to ") + offset, true, [=](Scene& scene, Random& random) {
      const Eigen::Vector3d n = planeNormal(scene);
      scene.rayPoints[0] -= n * n.dot(scene.rayPoints[0] - scene.points[0]);
      scene.rayPoints[0] += std::atof(offset) * n;
      aimRay(scene, n.cross(random.direction()).normalized(), 0, random);
    });
  add("ray near X1", true,
      [](Scene& scene, Random& random) { scene.rayPoints[0] = scene.points[0] + 0.01 * random.direction(); });
  return cases;
}

// The problem of a query at distance 15 .. 25 from a 10 x 10 x 10 cube, changed by the case, with everything in front of the
// query and inside a 2000 x 2000 px image.
inline MinimalProblem makeAwkwardProblem(Random& random, const AwkwardCase& awkward, const std::vector<int>& raysPerCamera,
                                         int points) {
  for (;;) {
    Scene scene;
    scene.query = cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000));
    const auto visiblePoint = [&] {
      Eigen::Vector3d point = random.vector(-5, 5);
      while (!isVisible(scene.query, point)) point = random.vector(-5, 5);
      return point;
    };
    for (std::size_t camera = 0; camera < raysPerCamera.size(); ++camera) {
      scene.rayPoints.push_back(visiblePoint());
      scene.centres.push_back(random.uniform(15, 25) * random.direction());
    }
    for (int i = 0; i < points; ++i) scene.points.push_back(visiblePoint());
    awkward.apply(scene, random);
    MinimalProblem problem;
    problem.truth = scene.query;
    bool visible = true;
    for (std::size_t i = 0; i < scene.rayPoints.size(); ++i) {
      visible = visible && isVisible(scene.query, scene.rayPoints[i], 1000);
      problem.rays.push_back(makeRayMatch(scene.query, scene.rayPoints[i], scene.centres[i], static_cast<int>(i)));
    }
    for (const Eigen::Vector3d& point : scene.points) {
      visible = visible && isVisible(scene.query, point, 1000);
      problem.points.push_back(makePointMatch(scene.query, point));
    }
    if (visible) return problem;
  }
}

}  // namespace test
}  // namespace hybridgv

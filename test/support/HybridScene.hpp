// Random query cameras with many hybrid correspondences, noise and outliers, and known truth.
#pragma once

#include <vector>

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace test {

struct SceneOptions {
  int rays = 60, points = 60, cameras = 5;
  double imageNoise = 0;                             // [px] standard deviation per coordinate, query and map images
  double pointNoise = 0;                             // standard deviation of the 3D points per coordinate
  double outlierShareRays = 0;                       // these get a random image point
  double outlierSharePoints = 0;                     // these get a random image point, too
  bool coplanar = false;                             // all scene points in one plane
  double halfSize = 5;                               // of the box they are in, 15 to 25 away from the query
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // moves the whole scene
  double scale = 1;                                  // scales the whole scene
};

struct HybridScene {
  std::vector<Eigen::Vector3d> image2d2d, bearings, offsets, image2d3d, points;
  std::vector<Eigen::Matrix3d> rotations;
  std::vector<int> cameras;
  std::vector<char> inliers2d2d, inliers2d3d;
  FocalPose truth;

  NoncentralHybridAdapter adapter() const { return {image2d2d, bearings, cameras, offsets, rotations, image2d3d, points}; }

  void removeRays() {
    image2d2d.clear();
    bearings.clear();
    cameras.clear();
    inliers2d2d.clear();
  }
  void removePoints() {
    image2d3d.clear();
    points.clear();
    inliers2d3d.clear();
  }
};

constexpr double kRigFocalLength = 1000;

inline Eigen::Vector3d noisyImagePoint(Random& random, const Eigen::Vector2d& exact, double noise) {
  const double du = noise * random.normal(), dv = noise * random.normal();
  return {exact[0] + du, exact[1] + dv, 1};
}
inline Eigen::Vector3d randomImagePoint(Random& random) {
  const double u = random.uniform(-500, 500), v = random.uniform(-500, 500);
  return {u, v, 1};
}

inline HybridScene makeHybridScene(Random& random, const SceneOptions& options) {
  HybridScene scene;
  FocalPose query = cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000));
  std::vector<FocalPose> rig;
  for (int k = 0; k < options.cameras; ++k) rig.push_back(cameraLookingAtOrigin(random, random.uniform(15, 25), kRigFocalLength));
  const Eigen::Vector3d planeNormal = random.direction();
  const auto visiblePoint = [&](const FocalPose& other) {
    for (;;) {
      Eigen::Vector3d point = random.vector(-options.halfSize, options.halfSize);
      if (options.coplanar) point -= planeNormal.dot(point) * planeNormal;
      if (isVisible(query, point) && isVisible(other, point)) return point;
    }
  };
  const auto toWorld = [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(options.origin + options.scale * x); };

  for (int i = 0; i < options.rays; ++i) {
    const int k = i % options.cameras;
    const FocalPose& camera = rig[static_cast<std::size_t>(k)];
    const Eigen::Vector3d point = visiblePoint(camera);
    const bool inlier = random.uniform() >= options.outlierShareRays;
    scene.image2d2d.push_back(inlier ? noisyImagePoint(random, project(query, point), options.imageNoise)
                                     : randomImagePoint(random));
    const Eigen::Vector3d inMap = noisyImagePoint(random, project(camera, point), options.imageNoise);
    scene.bearings.push_back(Eigen::Vector3d(inMap[0], inMap[1], kRigFocalLength).normalized());
    scene.cameras.push_back(k);
    scene.inliers2d2d.push_back(inlier);
  }
  for (int i = 0; i < options.points; ++i) {
    const Eigen::Vector3d point = visiblePoint(query);
    const bool inlier = random.uniform() >= options.outlierSharePoints;
    scene.image2d3d.push_back(inlier ? noisyImagePoint(random, project(query, point), options.imageNoise)
                                     : randomImagePoint(random));
    const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
    scene.points.push_back(toWorld(point + options.pointNoise * error));
    scene.inliers2d3d.push_back(inlier);
  }
  for (const FocalPose& camera : rig) {
    scene.offsets.push_back(toWorld(camera.position));
    scene.rotations.push_back(camera.rotation);
  }
  scene.truth = query;
  scene.truth.position = toWorld(query.position);
  return scene;
}

// A pose near another one: rotated by up to `angle` [rad], moved by up to `distance`, focal length times up to exp(logFocal).
inline FocalPose perturbed(Random& random, const FocalPose& pose, double angle, double distance, double logFocal) {
  FocalPose result = pose;
  const double turn = random.uniform(0, angle), step = random.uniform(0, distance);
  const Eigen::Vector3d axis = random.direction(), direction = random.direction();
  result.rotation = pose.rotation * Eigen::AngleAxisd(turn, axis).toRotationMatrix();
  result.position += step * direction;
  result.focalLength *= std::exp(random.uniform(-logFocal, logFocal));
  return result;
}

}  // namespace test
}  // namespace hybridgv

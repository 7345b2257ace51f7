// Random minimal problems with known truth, and the residuals of their equations.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "Random.hpp"
#include "hybridgv/adapters/NoncentralHybridAdapter.hpp"
#include "hybridgv/types.hpp"
#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace test {

struct MinimalProblem {
  std::vector<solvers::RayMatch> rays;
  std::vector<solvers::PointMatch> points;
  FocalPose truth;
};

// A camera at `distance` from the origin that looks at it, with random roll; focal length as given.
inline FocalPose cameraLookingAtOrigin(Random& random, double distance, double focalLength) {
  FocalPose camera;
  camera.position = distance * random.direction();
  const Eigen::Vector3d z = -camera.position.normalized();
  const Eigen::Vector3d x = z.cross(random.direction()).normalized();
  camera.rotation << x, z.cross(x), z;
  camera.focalLength = focalLength;
  return camera;
}

// The rig point in the camera's frame.
inline Eigen::Vector3d toCamera(const FocalPose& camera, const Eigen::Vector3d& point) {
  return camera.rotation.transpose() * (point - camera.position);
}

inline Eigen::Vector2d project(const FocalPose& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector3d y = toCamera(camera, point);
  return camera.focalLength / y[2] * y.head<2>();
}

inline bool isVisible(const FocalPose& camera, const Eigen::Vector3d& point, double halfSize = 500) {
  return toCamera(camera, point)[2] > 0 && project(camera, point).cwiseAbs().maxCoeff() <= halfSize;
}

inline solvers::PointMatch makePointMatch(const FocalPose& query, const Eigen::Vector3d& point) {
  const Eigen::Vector2d image = project(query, point);
  return {image[0], image[1], point};
}

inline solvers::RayMatch makeRayMatch(const FocalPose& query, const Eigen::Vector3d& point, const Eigen::Vector3d& centre,
                                      int camera) {
  const Eigen::Vector2d image = project(query, point);
  return {image[0], image[1], centre, (point - centre).normalized(), camera};
}

// The paper's geometry: points in a 10 x 10 x 10 cube, the query (f in 500 .. 2000 px, 1000 x 1000 px) and the rig cameras at
// distance 15 .. 25, all looking at the origin. `raysPerCamera` lists how many rays each rig camera has, so {1,1,1,1,1} is H51f
// [1], {5} is H51f [5], {3} is H32f [3].
inline MinimalProblem makeMinimalProblem(Random& random, const std::vector<int>& raysPerCamera, int points) {
  MinimalProblem problem;
  const double focalLength = random.uniform(500, 2000);
  problem.truth = cameraLookingAtOrigin(random, random.uniform(15, 25), focalLength);
  const auto visiblePoint = [&] {
    Eigen::Vector3d point = random.vector(-5, 5);
    while (!isVisible(problem.truth, point)) point = random.vector(-5, 5);
    return point;
  };
  int camera = 0;
  for (int count : raysPerCamera) {
    const Eigen::Vector3d centre = random.uniform(15, 25) * random.direction();
    for (int i = 0; i < count; ++i) problem.rays.push_back(makeRayMatch(problem.truth, visiblePoint(), centre, camera));
    ++camera;
  }
  for (int i = 0; i < points; ++i) problem.points.push_back(makePointMatch(problem.truth, visiblePoint()));
  return problem;
}

inline NoncentralHybridAdapter makeAdapter(const MinimalProblem& problem) {
  std::vector<Eigen::Vector3d> image2d2d, bearings, image2d3d, points, offsets;
  std::vector<int> cameras;
  for (const solvers::RayMatch& ray : problem.rays) {
    image2d2d.emplace_back(ray.u, ray.v, 1);
    bearings.push_back(ray.direction);
    cameras.push_back(ray.camera);
    offsets.resize(std::max(offsets.size(), static_cast<std::size_t>(ray.camera) + 1), Eigen::Vector3d::Zero());
    offsets[static_cast<std::size_t>(ray.camera)] = ray.centre;
  }
  for (const solvers::PointMatch& match : problem.points) {
    image2d3d.emplace_back(match.u, match.v, 1);
    points.push_back(match.point);
  }
  const std::vector<Eigen::Matrix3d> rotations(offsets.size(), Eigen::Matrix3d::Identity());
  return {image2d2d, bearings, cameras, offsets, rotations, image2d3d, points};
}

// Larger of the rotation difference [rad, for small ones] and the relative difference of the focal lengths.
inline double poseDistance(const FocalPose& a, const FocalPose& b) {
  return std::max((a.rotation - b.rotation).norm(), std::abs(a.focalLength / b.focalLength - 1));
}

inline double distanceToNearest(const FocalPoses& poses, const FocalPose& truth) {
  double best = std::numeric_limits<double>::infinity();
  for (const FocalPose& pose : poses) best = std::min(best, poseDistance(pose, truth));
  return best;
}

constexpr double kViolated = 1e9;

// Distance of an image point from the image of a viewing ray, in pixels; kViolated unless the rays meet at positive depths.
inline double rayResidual(const FocalPose& pose, const solvers::RayMatch& ray) {
  const Eigen::Vector3d b = toCamera(pose, ray.centre), a = pose.rotation.transpose() * ray.direction;
  const Eigen::Vector3d p(ray.u, ray.v, pose.focalLength);
  const Eigen::Vector3d n = p.cross(a);
  const double beta = -p.cross(b).dot(n) / n.squaredNorm();
  if (n.squaredNorm() > 0 && (!(beta > 0) || !((b + beta * a)[2] > 0))) return kViolated;
  Eigen::Vector3d first = b, second = a;
  first.head<2>() *= pose.focalLength;
  second.head<2>() *= pose.focalLength;
  const Eigen::Vector3d line = first.cross(second);
  return std::abs(line.dot(Eigen::Vector3d(ray.u, ray.v, 1))) / line.head<2>().norm();
}

inline double pointResidual(const FocalPose& pose, const solvers::PointMatch& match) {
  if (!(toCamera(pose, match.point)[2] > 0)) return kViolated;
  return (project(pose, match.point) - Eigen::Vector2d(match.u, match.v)).norm();
}

// Largest violation, in pixels, of the equations of rays and the first `exactPoints` points; kViolated for what is no pose.
inline double largestResidual(const MinimalProblem& problem, const FocalPose& pose, std::size_t exactPoints) {
  double worst = (pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).norm();
  worst = std::max(worst, std::abs(pose.rotation.determinant() - 1));
  for (const solvers::RayMatch& ray : problem.rays) worst = std::max(worst, rayResidual(pose, ray));
  for (std::size_t i = 0; i < exactPoints; ++i) worst = std::max(worst, pointResidual(pose, problem.points[i]));
  return std::isfinite(worst) && pose.focalLength > 0 && pose.position.allFinite() ? worst : kViolated;
}

}  // namespace test
}  // namespace hybridgv

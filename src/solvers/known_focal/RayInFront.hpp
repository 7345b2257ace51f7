// The last test of a pose that a solver of this folder returns.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "solvers/MinimalSolver.hpp"
#include "solvers/meetInFront.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

// Whether the image point of a ray, with its centre and direction in the frame of a query of focal length 1, is on the ray's epipolar
// line, up to 1e-7 of `imageScale`, the largest image coordinate. `centre` is in a unit in which the scene is about 1.
inline bool isOnLine(const RayMatch& ray, const Eigen::Vector3d& centre, const Eigen::Vector3d& direction, double imageScale) {
  constexpr double kTolerance = 1e-7;
  const Eigen::Vector3d line = centre.cross(direction);
  const double allowed = kTolerance * imageScale * std::sqrt(line[0] * line[0] + line[1] * line[1]);
  return std::abs(line[0] * ray.u + line[1] * ray.v + line[2]) <= allowed;
}

// And the ray meets the line of sight in front of both cameras.
inline bool isMetInFront(const RayMatch& ray, const Eigen::Vector3d& centre, const Eigen::Vector3d& direction,
                         double imageScale) {
  constexpr double kLeastBaseline = 1e-9;
  const double baseline = centre.norm();
  return baseline > kLeastBaseline && isOnLine(ray, centre, direction, imageScale) &&
         meetInFront(ray.u, ray.v, 1, direction, centre / baseline);
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

// The pose of a query that sees three points, in the frame and units of ThreePointFrame.hpp.
#pragma once

#include "solvers/three_points/ThreePointFrame.hpp"

namespace hybridgv {
namespace solvers {
namespace three_points {

// Largest error, in the image unit, that a returned pose may have in its equations.
constexpr double kMaxImageError = 1e-9;
// A smaller focal length, in the image unit, is that of a false solution: where a point is seen at the principal point, all
// equations hold for f = 0.
constexpr double kMinFocalLength = 1e-6;
// With a longer one the pose is at infinity, and rounding alone moves image points by more than kMaxImageError.
constexpr double kMaxFocalLength = 1e6;

struct FramePose {
  Eigen::Vector3d r1, r2, r3;  // the query's axes (rows of the rotation)
  Eigen::Vector3d x3;          // X3 in query coordinates
  double f;

  Eigen::Vector3d rotate(const Eigen::Vector3d& v) const { return {r1.dot(v), r2.dot(v), r3.dot(v)}; }
  // Query coordinates of X3 + y.
  Eigen::Vector3d transform(const Eigen::Vector3d& y) const { return x3 + rotate(y); }

  FocalPose inRig(const ThreePointFrame& frame) const;
};

// f > 0, and all three points are in front of the query, where they are seen. (X3 is seen right by construction.)
bool seesThreePoints(const FramePose& pose, const ThreePointFrame& frame);

// The distance from p at which the pose sees a point given in query coordinates; negative if the point is not in front of it.
double imageError(const FramePose& pose, const Eigen::Vector3d& point, const ImagePoint& p);

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv

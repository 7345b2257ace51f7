#include "solvers/three_points/ThreePointPose.hpp"

#include <cmath>

namespace hybridgv {
namespace solvers {
namespace three_points {

FocalPose FramePose::inRig(const ThreePointFrame& frame) const {
  const auto toRig = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return frame.e1 * v[0] + frame.e2 * v[1] + frame.e3 * v[2];
  };
  FocalPose pose;
  pose.rotation.col(0) = toRig(r1);
  pose.rotation.col(1) = toRig(r2);
  pose.rotation.col(2) = toRig(r3);
  pose.position = frame.x3 - frame.lengthUnit * (pose.rotation * x3);
  pose.focalLength = f * frame.imageUnit;
  return pose;
}

double imageError(const FramePose& pose, const Eigen::Vector3d& point, const ImagePoint& p) {
  if (!(point[2] > 0)) return -1;
  const double scale = pose.f / point[2];
  return std::max(std::abs(scale * point[0] - p.x), std::abs(scale * point[1] - p.y));
}

bool seesThreePoints(const FramePose& pose, const ThreePointFrame& frame) {
  if (!(pose.f > kMinFocalLength && pose.f < kMaxFocalLength) || !(pose.x3[2] > 0)) return false;
  const double error1 = imageError(pose, pose.transform({frame.a1, frame.h, 0}), frame.p1);
  const double error2 = imageError(pose, pose.transform({frame.b1, frame.h, 0}), frame.p2);
  return error1 >= 0 && error1 < kMaxImageError && error2 >= 0 && error2 < kMaxImageError;
}

}  // namespace three_points
}  // namespace solvers
}  // namespace hybridgv

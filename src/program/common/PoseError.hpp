// How far an estimated pose with focal length is from the true one.
#pragma once

#include <hybridgv/types.hpp>

#include <algorithm>
#include <cmath>

struct PoseError {
  double focalPercent;  // signed
  double rotationDeg;
  double position;  // in the unit of the scene
};

inline PoseError poseError(const hybridgv::FocalPose& pose, const hybridgv::FocalPose& truth) {
  // |R - R'| = sqrt(8) sin(angle / 2), which keeps its digits for small angles.
  const double sine = std::min(1.0, (pose.rotation - truth.rotation).norm() / std::sqrt(8.0));
  return {100 * (pose.focalLength / truth.focalLength - 1), 2 * std::asin(sine) * 180 / M_PI,
          (pose.position - truth.position).norm()};
}

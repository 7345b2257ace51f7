// Small steps of single parameters, for differences of what the kernels derive.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "robust/QueryPose.hpp"

namespace hybridgv {
namespace test {

// The distortion is measured in units in which a step is as large as the others'.
constexpr double kDistortionUnit = 1e-6;

inline double unitOf(int parameter) { return parameter == 7 ? kDistortionUnit : 1; }

// In the order of the kernels' parameters.
inline robust::QueryPose moved(const robust::QueryPose& pose, int parameter, double step) {
  robust::QueryPose result = pose;
  if (parameter < 3) result.rotation = pose.rotation * Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(parameter));
  if (parameter >= 3 && parameter < 6) result.position[parameter - 3] += step;
  if (parameter == 6) result.focalLength *= std::exp(step);
  if (parameter == 7) result.distortion += kDistortionUnit * step;
  return result;
}

}  // namespace test
}  // namespace hybridgv

// A pose as COLMAP and the benchmarks of visual localization write it.
#pragma once

#include <hybridgv/types.hpp>

#include <Eigen/Geometry>
#include <array>

namespace program {

// qw qx qy qz tx ty tz of x_camera = R(q) X + t, qw >= 0
inline std::array<double, 7> poseNumbers(const hybridgv::FocalPose& pose) {
  const hybridgv::CamFromWorld camera = pose.camFromWorld();
  Eigen::Quaterniond q(camera.rotation);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Eigen::Vector3d& t = camera.translation;
  return {q.w(), q.x(), q.y(), q.z(), t[0], t[1], t[2]};
}

}  // namespace program

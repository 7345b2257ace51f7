// COLMAP's way to write a pose.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// qw qx qy qz tx ty tz of x_camera = R(q) X + t
inline std::array<double, 7> colmapPose(const Image& image) {
  Eigen::Quaterniond q(Eigen::Matrix3d(image.rotation.transpose()));
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Eigen::Vector3d t = -(image.rotation.transpose() * image.position);
  return {q.w(), q.x(), q.y(), q.z(), t[0], t[1], t[2]};
}

}  // namespace sfm
}  // namespace hybridgv

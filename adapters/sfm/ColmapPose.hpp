// COLMAP's way to write a pose.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "ModelLinks.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

// Does the stored pose still say where the image is?
inline bool isStoredPoseValid(const Image& image) {
  const std::array<double, 7>& p = image.storedPose;
  Image stored;
  return setPoseFromQuaternion(p.data(), {p[4], p[5], p[6]}, stored).empty() && stored.rotation == image.rotation &&
         stored.position == image.position;
}

// qw qx qy qz tx ty tz of x_camera = R(q) X + t
inline std::array<double, 7> colmapPose(const Image& image) {
  if (isStoredPoseValid(image)) return image.storedPose;
  Eigen::Quaterniond q(Eigen::Matrix3d(image.rotation.transpose()));
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Eigen::Vector3d t = -(image.rotation.transpose() * image.position);
  return {q.w(), q.x(), q.y(), q.z(), t[0], t[1], t[2]};
}

// rig_from_world = sensor_from_rig^-1 * cam_from_world
inline std::array<double, 7> poseOfRig(const Image& image, const std::vector<double>& sensorFromRig) {
  const std::vector<double>& s = sensorFromRig;
  Image mounted, rig;
  if (!setPoseFromQuaternion(s.data(), {s[4], s[5], s[6]}, mounted).empty()) return colmapPose(image);
  rig.rotation = image.rotation * mounted.rotation.transpose();
  rig.position = image.position - rig.rotation * mounted.position;
  return colmapPose(rig);
}

}  // namespace sfm
}  // namespace hybridgv

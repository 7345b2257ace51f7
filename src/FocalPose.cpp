#include "CheckArguments.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {

FocalPose FocalPose::fromCamFromWorld(const Eigen::Matrix3d& worldToCamera, const Eigen::Vector3d& translation,
                                      double focalLength) {
  checkRotation("worldToCamera", worldToCamera);
  checkFinite("translation", translation);
  checkPositive("focalLength", focalLength);
  FocalPose pose;
  pose.rotation = worldToCamera.transpose();
  pose.position = -(worldToCamera.transpose() * translation);
  pose.focalLength = focalLength;
  return pose;
}

}  // namespace hybridgv

// The camera model without distortion.
#pragma once

#include "robust/kernels/Epipolar.hpp"
#include "robust/kernels/PinholePointSums.hpp"
#include "robust/kernels/Reprojection.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// What the kernels, templates on the camera model, need of one: its pose, how it sees a point and a ray, the sums of the points' normal
// equations, and the number of parameters by which it derives. So every model has the instructions that it needs and no others.
struct Pinhole {
  using Pose = robust::HYBRIDGV_INSTRUCTION_SET::Pose;
  using Point = Reprojection;
  using Ray = Epipolar;
  using PointSums = PinholePointSums;
  static constexpr int kParameters = correspondences::kFocalPoseParameters;
};

// The same where the focal length is known: without the derivatives of rays by it.
struct CalibratedPinhole : Pinhole {
  static constexpr int kParameters = correspondences::kPoseParameters;
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

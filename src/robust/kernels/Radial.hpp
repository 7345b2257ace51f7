// The camera model with one parameter of radial distortion (QueryPose).
#pragma once

#include "robust/kernels/RadialEpipolar.hpp"
#include "robust/kernels/RadialPointSums.hpp"
#include "robust/kernels/RadialReprojection.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

struct Radial {
  using Pose = RadialPose;
  using Point = RadialReprojection;
  using Ray = RadialEpipolar;
  using PointSums = RadialPointSums;
  static constexpr int kParameters = correspondences::kMostParameters;
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

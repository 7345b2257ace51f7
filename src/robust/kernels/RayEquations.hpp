// The normal equations of 2D-2D correspondences, for any camera model (Pinhole.hpp).
#pragma once

#include "robust/kernels/Epipolar.hpp"
#include "robust/kernels/Losses.hpp"
#include "robust/kernels/NormalEquationsSum.hpp"
#include "robust/kernels/Ranges.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

template <class Camera>
static void addRays(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (rays.size == 0) return;
  const typename Camera::Pose pose(plainPose);
  const Doubles unknownPixel = broadcast<Doubles>(squaredPixelOfUnknown(plainPose));
  CostSum cost(loss);
  NormalEquationsSum<Camera::kParameters> sums;
  forRangeOfLongBody(0, rays.size, [&](std::size_t i, DoubleMask inRange) {
    const typename Camera::Ray ray(rays, i, pose, unknownPixel);
    const Doubles squaredError = ray.squaredError();
    const DoubleMask valid = isValid(ray, squaredError, loss);
    const Doubles weight = cost.weigh(inRange, valid, squaredError, rays.narrowing ? rays.narrowing + i : nullptr);
    if (!any(weight > 0)) return;
    const Doubles variance = select<Doubles>(valid, ray.variance, broadcast<Doubles>(1));
    Row<Camera::kParameters> derivatives;
    differentiate(ray, variance, pose, derivatives);
    sums.add(derivatives, ray.constraint, weight / variance);
  });
  total.cost += cost.total();
  sums.addTo(total);
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

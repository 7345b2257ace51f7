// The normal equations of 2D-2D correspondences, for any camera model (Pinhole.hpp).
#pragma once

#include "robust/kernels/Epipolar.hpp"
#include "robust/kernels/Losses.hpp"
#include "robust/kernels/NormalEquationsSum.hpp"
#include "robust/kernels/Ranges.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// Calls body(i, ray, variance, derivatives, weight) for all rays from the i-th on, kWidth at a time, of which some have a weight.
template <class Camera, class Body>
HYBRIDGV_INLINE void forWeightedRays(const RayArrays& rays, const PlainPose& plainPose, const typename Camera::Pose& pose,
                                     const KindLoss& loss, CostSum& cost, Body body) {
  const Doubles unknownPixel = broadcast<Doubles>(squaredPixelOfUnknown(plainPose));
  forRangeOfLongBody(0, rays.size, [&](std::size_t i, DoubleMask inRange) {
    const typename Camera::Ray ray(rays, i, pose, unknownPixel);
    const Doubles squaredError = ray.squaredError();
    const DoubleMask valid = isValid(ray, squaredError, loss);
    const Doubles weight = cost.weigh(inRange, valid, squaredError, rays.narrowing ? rays.narrowing + i : nullptr);
    if (!any(weight > 0)) return;
    const Doubles variance = select<Doubles>(valid, ray.variance, broadcast<Doubles>(1));
    Row<Camera::kParameters> derivatives;
    differentiate(ray, variance, pose, derivatives);
    body(i, ray, variance, derivatives, weight / variance);
  });
}

template <class Camera>
static void addRays(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (rays.size == 0) return;
  const typename Camera::Pose pose(plainPose);
  CostSum cost(loss);
  NormalEquationsSum<Camera::kParameters> sums;
  forWeightedRays<Camera>(rays, plainPose, pose, loss, cost,
                          [&](std::size_t, const typename Camera::Ray& ray, Doubles, const Row<Camera::kParameters>& derivatives,
                              Doubles weight) { sums.add(derivatives, ray.constraint, weight); });
  total.cost += cost.total();
  sums.addTo(total);
}

template <class Camera>
static void addRayShifts(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, ImageShiftSums& total) {
  if (rays.size == 0) return;
  const typename Camera::Pose pose(plainPose);
  CostSum cost(loss);
  Doubles alongU[Camera::kParameters] = {}, alongV[Camera::kParameters] = {};
  forWeightedRays<Camera>(rays, plainPose, pose, loss, cost,
                          [&](std::size_t, const typename Camera::Ray& ray, Doubles variance,
                              const Row<Camera::kParameters>& derivatives, Doubles weight) {
                            const ImageDerivatives change = differentiateByImage(ray, variance, pose);
                            for (int row = 0; row < Camera::kParameters; ++row) {
                              alongU[row] += weight * derivatives[row] * change.byU;
                              alongV[row] += weight * derivatives[row] * change.byV;
                            }
                          });
  for (int row = 0; row < Camera::kParameters; ++row) {
    total.alongU[row] += sum(alongU[row]);
    total.alongV[row] += sum(alongV[row]);
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

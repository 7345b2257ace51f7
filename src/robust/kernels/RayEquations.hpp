// The normal equations of 2D-2D correspondences, for any camera model (Pinhole.hpp).
#pragma once

#include "robust/kernels/BeyondInfinity.hpp"
#include "robust/kernels/Losses.hpp"
#include "robust/kernels/NormalEquationsSum.hpp"
#include "robust/kernels/Ranges.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// Calls body(i, ray, variance, derivatives, weight) for the rays from the begin-th on, kWidth at a time, of which some have a weight; but for
// those for which leaveOut(i, inRange, valid, squaredError).
template <class Camera, class LeaveOut, class Body>
HYBRIDGV_INLINE void forWeightedRays(std::size_t begin, std::size_t end, const RayArrays& rays, const PlainPose& plainPose,
                                     const typename Camera::Pose& pose, const KindLoss& loss, CostSum& cost, LeaveOut leaveOut,
                                     Body body) {
  const Doubles unknownPixel = broadcast<Doubles>(squaredPixelOfUnknown(plainPose));
  forRangeOfLongBody(begin, end, [&](std::size_t i, DoubleMask inRange) {
    const typename Camera::Ray ray(rays, i, pose, unknownPixel);
    const Doubles squaredError = ray.squaredError();
    const DoubleMask valid = isValid(ray, squaredError, loss);
    if (leaveOut(i, inRange, valid, squaredError)) return;
    const Doubles weight = cost.weigh(inRange, valid, squaredError, rays.narrowing ? rays.narrowing + i : nullptr);
    if (!any(weight > 0)) return;
    const Doubles variance = select<Doubles>(valid, ray.variance, broadcast<Doubles>(1));
    Row<Camera::kParameters> derivatives;
    differentiate(ray, variance, pose, derivatives);
    body(i, ray, variance, derivatives, weight / variance);
  });
}

// For all rays.
template <class Camera, class Body>
HYBRIDGV_INLINE void forWeightedRays(const RayArrays& rays, const PlainPose& plainPose, const typename Camera::Pose& pose,
                                     const KindLoss& loss, CostSum& cost, Body body) {
  const auto none = [](std::size_t, DoubleMask, DoubleMask, Doubles) { return false; };
  forWeightedRays<Camera>(0, rays.size, rays, plainPose, pose, loss, cost, none, body);
}

// With larger squared errors across the epipolar line rays have as good as no weight, and need not be looked at beyond infinity.
static inline double farAcross(const KindLoss& loss) {
  constexpr double kNothing = 1e4;
  const double x = loss.loss == Loss::Mixture ? __builtin_sqrt(__builtin_sqrt(__builtin_sqrt(kNothing * loss.odds))) : 1;
  return x * loss.scale * loss.scale;
}

// The normal equations of rays from some places on, kWidth from each, some of which may be beyond infinity. As a rule there are none.
template <class Camera>
__attribute__((noinline)) static void addRaysBeyondInfinity(const RayArrays& rays, const std::size_t* places, std::size_t count,
                                                            const PlainPose& plainPose, const KindLoss& loss,
                                                            NormalEquations& total) {
  const typename Camera::Pose pose(plainPose);
  const Doubles unknownPixel = broadcast<Doubles>(squaredPixelOfUnknown(plainPose));
  const double far = farAcross(loss);
  CostSum cost(loss);
  NormalEquationsSum<Camera::kParameters> sums;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = places[k];
    const DoubleMask inRange = i + kWidth <= rays.size ? allLanes() : lanesBelow(rays.size - i);
    const typename Camera::Ray ray(rays, i, pose, unknownPixel);
    const Doubles squaredError = ray.squaredError();
    const DoubleMask inFront = isValid(ray, squaredError, loss);
    const BeyondInfinity beyond(ray, pose);
    const DoubleMask isBeyond = beyond.applies & ~inFront & (squaredError < far), valid = inFront | isBeyond;
    const Doubles together = squaredError + select<Doubles>(isBeyond, beyond.squared(), Doubles{});
    const Doubles weight = cost.weigh(inRange, valid, together, rays.narrowing ? rays.narrowing + i : nullptr);
    if (!any(weight > 0)) continue;
    const Doubles variance = select<Doubles>(valid, ray.variance, broadcast<Doubles>(1));
    Row<Camera::kParameters> derivatives;
    differentiate(ray, variance, pose, derivatives);
    sums.add(derivatives, ray.constraint, weight / variance);
    differentiate(beyond, ray, pose, derivatives);
    const Doubles precision = select<Doubles>(isBeyond, beyond.precision, Doubles{});
    sums.add(derivatives, select<Doubles>(isBeyond, beyond.error, Doubles{}), weight * precision);
  }
  total.cost += cost.total();
  sums.addTo(total);
}

template <class Camera>
__attribute__((noinline)) static void addRaysToInfinity(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss,
                                                        NormalEquations& total) {
  const typename Camera::Pose pose(plainPose);
  CostSum cost(loss);
  NormalEquationsSum<Camera::kParameters> sums;
  forWeightedRays<Camera>(rays, plainPose, pose, loss, cost,
                          [&](std::size_t, const typename Camera::Ray& ray, Doubles, const Row<Camera::kParameters>& derivatives,
                              Doubles weight) { sums.add(derivatives, ray.constraint, weight); });
  total.cost += cost.total();
  sums.addTo(total);
}

// What may be beyond infinity is left out of the loop, one block after the other, and added apart.
template <class Camera>
static void addRays(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (rays.size == 0) return;
  if (!loss.reachesBeyondInfinity) return addRaysToInfinity<Camera>(rays, plainPose, loss, total);
  constexpr std::size_t kBlock = 512;
  const typename Camera::Pose pose(plainPose);
  const double far = farAcross(loss);
  CostSum cost(loss);
  NormalEquationsSum<Camera::kParameters> sums;
  for (std::size_t begin = 0; begin < rays.size; begin += kBlock) {
    std::size_t places[kBlock / kWidth], count = 0;
    const auto leaveOut = [&](std::size_t i, DoubleMask inRange, DoubleMask valid, Doubles squaredError) {
      const bool some = any(~valid & (squaredError < far) & inRange);
      places[count] = i;
      count += some;
      return some;
    };
    const std::size_t end = begin + kBlock < rays.size ? begin + kBlock : rays.size;
    forWeightedRays<Camera>(
        begin, end, rays, plainPose, pose, loss, cost, leaveOut,
        [&](std::size_t, const typename Camera::Ray& ray, Doubles, const Row<Camera::kParameters>& derivatives, Doubles weight) {
          sums.add(derivatives, ray.constraint, weight);
        });
    if (count > 0) addRaysBeyondInfinity<Camera>(rays, places, count, plainPose, loss, total);
  }
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

// The normal equations of 2D-2D correspondences, for any camera model (Pinhole.hpp).
#pragma once

#include "robust/kernels/BeyondInfinity.hpp"
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

// The normal equations of all rays.
template <class Camera>
class RaySums {
 public:
  RaySums(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss)
      : rays_(rays),
        pose_(plainPose),
        unknownPixel_(broadcast<Doubles>(squaredPixelOfUnknown(plainPose))),
        loss_(loss),
        cost_(loss) {}

  // From the i-th on, kWidth of them.
  HYBRIDGV_INLINE void add(std::size_t i, DoubleMask inRange) {
    const Ray ray(rays_, i, pose_, unknownPixel_);
    const Doubles squaredError = ray.squaredError();
    const DoubleMask valid = isValid(ray, squaredError, loss_);
    if (loss_.reachesBeyondInfinity && any(mayBeBeyond(valid, squaredError) & inRange))
      addBeyondInfinity(i, inRange, ray, squaredError, valid);
    else
      addFirst(ray, valid, weigh(i, inRange, valid, squaredError));
  }
  void addTo(NormalEquations& total) {
    total.cost += cost_.total();
    sums_.addTo(total);
  }

 private:
  using Ray = typename Camera::Ray;
  using Derivatives = Row<Camera::kParameters>;

  // With larger errors across the epipolar line a ray counts as no inlier anyway.
  HYBRIDGV_INLINE DoubleMask mayBeBeyond(DoubleMask valid, Doubles squaredError) const {
    constexpr double kFar = 64;  // of the squared scale
    return ~valid & (squaredError < kFar * loss_.scale * loss_.scale);
  }
  HYBRIDGV_INLINE Doubles weigh(std::size_t i, DoubleMask inRange, DoubleMask valid, Doubles squaredError) {
    return cost_.weigh(inRange, valid, squaredError, rays_.narrowing ? rays_.narrowing + i : nullptr);
  }
  HYBRIDGV_INLINE void addFirst(const Ray& ray, DoubleMask valid, Doubles weight) {
    if (!any(weight > 0)) return;
    const Doubles variance = select<Doubles>(valid, ray.variance, broadcast<Doubles>(1));
    Derivatives derivatives;
    differentiate(ray, variance, pose_, derivatives);
    sums_.add(derivatives, ray.constraint, weight / variance);
  }
  // As a rule none of them: not part of the loop.
  __attribute__((noinline)) void addBeyondInfinity(std::size_t i, const DoubleMask& inRange, const Ray& ray,
                                                   const Doubles& squaredError, const DoubleMask& valid) {
    const BeyondInfinity beyond(ray, pose_);
    const DoubleMask isBeyond = beyond.applies & mayBeBeyond(valid, squaredError), all = valid | isBeyond;
    const Doubles together = squaredError + select<Doubles>(isBeyond, beyond.squared(), Doubles{});
    const Doubles weight = weigh(i, inRange, all, together);
    addFirst(ray, all, weight);
    const Doubles second = select<Doubles>(isBeyond, weight * beyond.precision, Doubles{});
    if (!any(second > 0)) return;
    Derivatives derivatives;
    differentiate(beyond, ray, pose_, derivatives);
    sums_.add(derivatives, select<Doubles>(isBeyond, beyond.error, Doubles{}), second);
  }

  const RayArrays& rays_;
  typename Camera::Pose pose_;
  Doubles unknownPixel_;
  KindLoss loss_;
  CostSum cost_;
  NormalEquationsSum<Camera::kParameters> sums_;
};

template <class Camera>
static void addRays(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (rays.size == 0) return;
  RaySums<Camera> sums(rays, plainPose, loss);
  forRangeOfLongBody(0, rays.size, [&](std::size_t i, DoubleMask inRange) { sums.add(i, inRange); });
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

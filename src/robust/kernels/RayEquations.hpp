// The normal equations of 2D-2D correspondences, for any camera model (Pinhole.hpp).
#pragma once

#include "robust/kernels/Epipolar.hpp"
#include "robust/kernels/Losses.hpp"
#include "robust/kernels/Ranges.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// J^T W J and J^T W e of errors with any derivatives.
template <int N>
class NormalEquationsSum {
 public:
  void add(const Doubles (&derivatives)[N], Doubles error, Doubles weight) {
    for (int row = 0, k = 0; row < N; ++row) {
      const Doubles weighted = weight * derivatives[row];
      gradient_[row] += weighted * error;
      for (int column = row; column < N; ++column, ++k) hessian_[k] += weighted * derivatives[column];
    }
  }
  void addTo(NormalEquations& total) const {
    for (int row = 0, k = 0; row < N; ++row) {
      total.gradient[row] += sum(gradient_[row]);
      for (int column = row; column < N; ++column, ++k) total.hessian[row][column] += sum(hessian_[k]);
    }
  }

 private:
  Doubles gradient_[N] = {}, hessian_[N * (N + 1) / 2] = {};
};

template <class Camera>
static void addRays(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, NormalEquations& total) {
  if (rays.size == 0) return;
  const Pose pose(plainPose);
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

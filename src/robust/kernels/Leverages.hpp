// How much every 2D-2D correspondence decides about the pose.
#pragma once

#include "robust/kernels/Epipolar.hpp"
#include "robust/kernels/Losses.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

template <class Camera>
static void rayLeverages(const RayArrays& rays, const PlainPose& plainPose, const KindLoss& loss, const double* covariance,
                         double* leverages) {
  const typename Camera::Pose pose(plainPose);
  const Doubles unknownPixel = broadcast<Doubles>(squaredPixelOfUnknown(plainPose));
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const typename Camera::Ray ray(rays, i, pose, unknownPixel);
    const Doubles squaredError = ray.squaredError();
    const Doubles narrowing = rays.narrowing ? load<Doubles>(rays.narrowing + i) : broadcast<Doubles>(1);
    const DoubleMask valid = isValid(ray, squaredError, loss) & (narrowing < kInfinity);
    const Doubles weight = loss.precision * slope(loss, relativeSquare(loss, valid, squaredError, narrowing));
    const Doubles variance = select<Doubles>(valid, ray.variance, broadcast<Doubles>(1));
    Row<Camera::kParameters> derivatives;
    differentiate(ray, variance, pose, derivatives);
    Doubles quadraticForm{};
    for (int row = 0; row < Camera::kParameters; ++row)
      for (int column = 0; column < Camera::kParameters; ++column)
        quadraticForm += covariance[row * kMostParameters + column] * derivatives[row] * derivatives[column];
    const Doubles leverage = select<Doubles>(valid, weight / variance * quadraticForm, Doubles{});
    store(leverages + i, leverage);
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

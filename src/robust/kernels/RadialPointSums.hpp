// The sums of the normal equations of 2D-3D correspondences in an image with radial distortion.
#pragma once

#include "robust/kernels/NormalEquationsSum.hpp"
#include "robust/kernels/RadialReprojection.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// The pinhole image (U, V) has the derivatives of PinholePointSums, dU and dV. Where it is seen, at (u, v) with r^2 = u^2 + v^2,
//
//     du = (1 + c r^2) (dU + u q),   dv = (1 + c r^2) (dV + v q),   q = 2c / (1 - c r^2) (u dU + v dV),
//
// and the derivative by c is (u, v) r^2 / (1 - c r^2).
HYBRIDGV_INLINE void differentiate(const RadialReprojection& point, Doubles inverseFocal, const RadialPose& pose, Doubles* byU,
                                   Doubles* byV) {
  constexpr int kByDistortion = correspondences::kMostParameters - 1;
  const Doubles U = point.pinholeU, V = point.pinholeV, u = point.projectedU, v = point.projectedV, s = point.scale;
  const Doubles mu = U * inverseFocal, mv = V * inverseFocal, none{};
  const Doubles pinholeU[] = {U * mv, -pose.f - U * mu, V, -s, none, s * mu, U};
  const Doubles pinholeV[] = {pose.f + V * mv, -U * mv, -U, none, -s, s * mv, V};
  const Doubles squaredRadius = u * u + v * v, cr = pose.distortion * squaredRadius, perRest = 1 / (1.0 - cr);
  const Doubles a = 1.0 + cr, b = 2 * pose.distortion * perRest;
  for (int k = 0; k < kByDistortion; ++k) {
    const Doubles q = b * (u * pinholeU[k] + v * pinholeV[k]);
    byU[k] = a * (pinholeU[k] + u * q);
    byV[k] = a * (pinholeV[k] + v * q);
  }
  byU[kByDistortion] = u * squaredRadius * perRest;
  byV[kByDistortion] = v * squaredRadius * perRest;
}

class RadialPointSums {
 public:
  HYBRIDGV_INLINE void add(const RadialReprojection& point, Doubles inverseFocal, const RadialPose& pose, Doubles w) {
    Doubles byU[kParameters], byV[kParameters];
    differentiate(point, inverseFocal, pose, byU, byV);
    sums_.add(byU, point.errorU, w);
    sums_.add(byV, point.errorV, w);
  }
  void addTo(const PlainPose& pose, NormalEquations& total) const {
    NormalEquations inQuery;
    sums_.addTo(inQuery);
    addTurned(pose, inQuery.gradient, inQuery.hessian, total);
  }

 private:
  static constexpr int kParameters = correspondences::kMostParameters;

  NormalEquationsSum<kParameters> sums_;
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

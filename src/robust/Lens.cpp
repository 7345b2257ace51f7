#include "robust/Lens.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {

Lens makeLens(const CorrespondenceArrays& arrays, const sac::HybridRansacOptions& options) {
  Lens lens;
  if (options.queryCamera == sac::QueryCamera::Pinhole) return lens;
  const double radius = std::max(arrays.imageRadius(), options.imageRadiusPx);
  const double unit = 1 / (radius * radius);
  if (!std::isnormal(unit)) return lens;
  lens.isUnknown = true;
  lens.prior.scale = options.distortionScale * unit;
  lens.least = kLeastDistortion * unit;
  lens.largest = kLargestDistortion * unit;
  for (const double hypothesis : options.distortionHypotheses) lens.hypotheses.push_back(hypothesis * unit);
  return lens;
}

double logEvidence(double distortion, double deviation, const DistortionPrior& prior) {
  constexpr double kPi = 3.14159265358979323846;
  const double z = distortion / deviation;
  // Data that say less than the prior are no evidence for anything.
  const double spread = std::min(deviation, prior.scale);
  return z * z / 2 + std::log(std::sqrt(2 * kPi) * spread / (kPi * prior.scale));
}

}  // namespace robust
}  // namespace hybridgv

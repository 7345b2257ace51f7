#include "robust/FocalLengthPrior.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {

constexpr double kFreedom = 3;
// The density of x is kMiddle (1 + x^2/3)^-2.
constexpr double kMiddle = 0.36755259694786137;  // 2 / (pi sqrt(3))
constexpr double kLeastOdds = 0.05, kRangeOfWrongPoses = 30;

double FocalLengthPrior::logDifference(double focalLengthOfPose) const {
  return isGiven() ? std::log(focalLengthOfPose / focalLength) : 0;
}

static double stretched(const FocalLengthPrior& prior, double logDifference) {
  const double x = logDifference / prior.logDeviation;
  return 1 + x * x / kFreedom;
}

double FocalLengthPrior::cost(double focalLengthOfPose) const {
  return isGiven() ? factor * (kFreedom + 1) * std::log(stretched(*this, logDifference(focalLengthOfPose))) : 0;
}

double FocalLengthPrior::weight(double focalLengthOfPose) const {
  if (!isGiven()) return 0;
  return factor * (kFreedom + 1) / kFreedom / stretched(*this, logDifference(focalLengthOfPose)) / (logDeviation * logDeviation);
}

double FocalLengthPrior::logOdds(double focalLengthOfPose) const {
  if (!isGiven()) return 0;
  const double s = stretched(*this, logDifference(focalLengthOfPose));
  return std::log10(std::max(kMiddle / (s * s) * std::log(kRangeOfWrongPoses) / logDeviation, kLeastOdds));
}

}  // namespace robust
}  // namespace hybridgv

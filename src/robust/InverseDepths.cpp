#include "robust/InverseDepths.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "robust/medians.hpp"

namespace hybridgv {
namespace robust {
namespace {

constexpr double kDeviationsPerMedian = 1.4826;  // of normal values
// A scene is not flatter than this, relative to its depth.
constexpr double kLeastDeviation = 1e-3;
constexpr double kDeviations = 3;

double square(double x) { return x * x; }

// One step of Fisher's scoring: the values' squared differences, less the variances of their errors, in the mean.
DepthDistribution nextGuess(const InverseDepths& depths, const DepthDistribution& guess) {
  double sum = 0, weights = 0, squares = 0, weightsOfSquares = 0;
  for (std::size_t i = 0; i < depths.values.size(); ++i) {
    const double total = guess.variance + depths.variances[i], squaredDifference = square(depths.values[i] - guess.mean);
    if (!(squaredDifference < square(kDeviations) * total)) continue;
    const double weight = 1 / total;
    sum += weight * depths.values[i];
    weights += weight;
    squares += square(weight) * (squaredDifference - depths.variances[i]);
    weightsOfSquares += square(weight);
  }
  if (!(weightsOfSquares > 0) || !std::isfinite(weightsOfSquares)) return guess;
  return {sum / weights, squares / weightsOfSquares};
}

}  // namespace

bool DepthDistribution::isOneOfFew(double value, double varianceOfError) const {
  return square(value - mean) > square(kDeviations) * (variance + varianceOfError);
}

double DepthDistribution::trust(double value, double varianceOfError) const {
  if (isOneOfFew(value, varianceOfError)) return 1 - varianceOfError / square(value - mean);
  return variance / (variance + varianceOfError);
}

DepthDistribution roughDepthDistribution(const InverseDepths& depths) {
  std::vector<double> values = depths.values;
  DepthDistribution result;
  result.mean = median(values);
  for (double& value : values) value = std::abs(value - result.mean);
  result.variance = square(kDeviationsPerMedian * median(values));
  return result;
}

DepthDistribution depthDistribution(const InverseDepths& depths) {
  constexpr int kRounds = 10;
  constexpr double kSame = 0.01;
  DepthDistribution result = roughDepthDistribution(depths);
  for (int round = 0; round < kRounds; ++round) {
    const double before = result.variance;
    result = nextGuess(depths, result);
    result.variance = std::max(result.variance, square(kLeastDeviation * result.mean));
    if (std::abs(result.variance - before) <= kSame * before) break;
  }
  return result;
}

}  // namespace robust
}  // namespace hybridgv

#include "robust/ErrorMixture.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {
namespace {

// (scale / deviation)^2: the density's median over that of the normal one. For points, whose errors e have the distribution
// function 1 - (1 + (e/scale)^2)^-7, it is 2 log 2 / (2^(1/7) - 1).
constexpr double kSquaredScaleOfRays = 14.28362, kSquaredScaleOfPoints = 13.31829;
// Density of an inlier's error at 0: Gamma(8) / (Gamma(7.5) sqrt(pi) scale) of rays, 7 / (pi scale^2) of points.
constexpr double kDensityOfRays = 1.519577, kDensityOfPoints = 7;
// For exact data the odds have no bound; beyond this one nothing changes.
constexpr double kMaxOdds = 1e9;
constexpr double kLeastBoundary = 2.5;

// `density`: of an inlier's error at 0 over that of an outlier's, times the chance share.
ErrorMixture makeMixture(double deviation, double scale, double density, const InlierCount& count) {
  const double all = static_cast<double>(std::max<std::size_t>(count.all, 1));
  const double inliers = static_cast<double>(count.inliers), outliers = std::max(all - inliers, 1.0);
  ErrorMixture result;
  result.deviation = deviation;
  result.scale = scale;
  result.odds = std::min(std::max(inliers, 0.5) / outliers * density / count.chanceShare, kMaxOdds);
  result.outlierShare = outliers / all;
  const double boundary = scale * std::sqrt(std::max(std::pow(result.odds, 1 / 8.) - 1, 0.0));
  result.boundary = std::min(std::max(boundary, kLeastBoundary * deviation), std::min(2 * count.threshold, count.bound));
  return result;
}

}  // namespace

KindLoss ErrorMixture::loss() const { return {Loss::Mixture, scale, 2 / (scale * scale), odds}; }

double ErrorMixture::oddsAt(double squaredError) const {
  const double q = 1 + squaredError / (scale * scale), q2 = q * q, q4 = q2 * q2;
  return odds / (q4 * q4);
}

double ErrorMixture::logLikelihood(const std::vector<double>& squaredErrors) const {
  // The sum of logs as the log of products, which are taken before they can overflow: every factor is from 1 to 1e9 + 1.
  constexpr std::size_t kFactors = 32;
  double sum = static_cast<double>(squaredErrors.size()) * std::log(outlierShare);
  for (std::size_t i = 0; i < squaredErrors.size();) {
    double product = 1;
    for (const std::size_t end = std::min(i + kFactors, squaredErrors.size()); i < end; ++i)
      product *= 1 + oddsAt(squaredErrors[i]);
    sum += std::log(product);
  }
  return sum;
}

ErrorMixture rayMixture(double deviation, const InlierCount& count) {
  const double scale = std::sqrt(kSquaredScaleOfRays) * deviation;
  return makeMixture(deviation, scale, kDensityOfRays * 2 * count.threshold / scale, count);
}

ErrorMixture pointMixture(double deviation, const InlierCount& count) {
  const double scale = std::sqrt(kSquaredScaleOfPoints) * deviation;
  return makeMixture(deviation, scale, kDensityOfPoints * std::pow(count.threshold / scale, 2), count);
}

}  // namespace robust
}  // namespace hybridgv

#include "robust/sampleLimit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "robust/Significance.hpp"

namespace hybridgv {
namespace robust {
namespace {

double choose(int n, int k) {
  double result = 1;
  for (int i = 0; i < k; ++i) result *= static_cast<double>(n - i) / (i + 1);
  return n >= k ? result : 0;
}

double numberOfRaySamples(const Sampler& sampler, const SampleSize& size) {
  if (size.rayDraw == RayDraw::Uniform || size.rayDraw == RayDraw::Spread) return choose(sampler.numberRays(), size.rays);
  double result = 0;
  for (int camera = 0; camera < sampler.numberCameras(); ++camera) {
    const int own = sampler.numberRays(static_cast<std::size_t>(camera));
    result +=
        size.rayDraw == RayDraw::OneCamera ? choose(own, size.rays) : choose(own, size.rays - 1) * (sampler.numberRays() - own);
  }
  return result;
}

}  // namespace

double numberOfSamples(const Sampler& sampler, const SampleSize& size) {
  return numberOfRaySamples(sampler, size) * choose(sampler.numberPoints(), size.points);
}

// Of N samples, k draws leave one undrawn with probability N (1 - 1/N)^k at most.
double drawsOfAllSamples(const Sampler& sampler, const std::vector<Strategy>& strategies, std::size_t variants) {
  constexpr double kUndrawn = 0.01, kGuesses = 64;
  double result = 0;
  for (const Strategy& strategy : strategies) {
    const double guesses = strategy.solver.intrinsics.focalLength ? 1 : kGuesses;
    const double count = numberOfSamples(sampler, strategy.size()) * static_cast<double>(variants) * guesses;
    result += count > 1 ? std::log(count / kUndrawn) / -std::log1p(-1 / count) : count;
  }
  return result;
}

static bool canBeReliedOn(const Support& exact, const ChanceModel& chance, int parameters, double logOdds) {
  const Shares shares = chance.levelShares();
  const bool hasPoints = chance.pointsAreMoreThanChance(exact.points, exact.allPoints, thresholdAt(1, kLevels - 1));
  const double bound = hasPoints ? kLogFalseAlarms : kLogFalseAlarmsOfRays;
  return ChanceModel::logProbability(exact, shares.rays.back(), shares.points.back(), parameters) + kLogChoices <=
         bound + logOdds;
}

bool isHopeless(const Sampler& sampler, const ChanceModel& chance, int parameters, double logOdds) {
  const Support all{sampler.numberPoints(), sampler.numberPoints(), sampler.numberRays(), sampler.numberRays()};
  return !canBeReliedOn(all, chance, parameters, logOdds);
}

// If cameras have different shares of the inliers, a sample of one camera finds a pose rather sooner than this says.
static double successProbability(const Strategy& strategy, const Support& inliers) {
  constexpr double kYield = 0.25;  // of samples with inliers only, those that lead to the pose
  const SampleSize size = strategy.size();
  const int rays = strategy.isStaged() ? size.rays - 1 : size.rays;
  const double ofRays = choose(inliers.rays, rays) / choose(inliers.allRays, rays);
  return kYield * ofRays * choose(inliers.points, size.points) / choose(inliers.allPoints, size.points);
}

LeastSupports::LeastSupports(const Sampler& sampler, const std::vector<Strategy>& strategies, std::size_t variants,
                             const ChanceModel& chance, int parameters, double logOdds)
    : strategies_(strategies.size()) {
  Support support{0, sampler.numberPoints(), sampler.numberRays(), sampler.numberRays()};
  for (; support.points <= support.allPoints; ++support.points) {
    if (!canBeReliedOn(support, chance, parameters, logOdds)) continue;
    // More points, not more rays.
    for (; support.rays > 0; --support.rays)
      if (!canBeReliedOn({support.points, support.allPoints, support.rays - 1, support.allRays}, chance, parameters, logOdds))
        break;
    for (const Strategy& strategy : strategies)
      logFailure_.push_back(std::log1p(-successProbability(strategy, support) / static_cast<double>(variants)));
    if (support.rays == 0) break;
  }
}

double LeastSupports::missProbability(const std::vector<int>& drawn) const {
  double largest = 0;
  for (auto support = logFailure_.begin(); support != logFailure_.end(); support += static_cast<std::ptrdiff_t>(strategies_))
    largest = std::max(largest, std::exp(std::inner_product(drawn.begin(), drawn.end(), support, 0.)));
  return largest;
}

}  // namespace robust
}  // namespace hybridgv

#include "robust/sampleLimit.hpp"

#include <algorithm>
#include <cmath>

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

bool isHopeless(const Sampler& sampler, const ChanceModel& chance, int parameters) {
  const Support all{sampler.numberPoints(), sampler.numberPoints(), sampler.numberRays(), sampler.numberRays()};
  const Shares shares = chance.levelShares();
  return ChanceModel::logProbability(all, shares.rays.back(), shares.points.back(), parameters) + kLogChoices > kLogFalseAlarms;
}

}  // namespace robust
}  // namespace hybridgv

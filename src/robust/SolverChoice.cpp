#include "robust/SolverChoice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "robust/StagedSampling.hpp"

namespace hybridgv {
namespace robust {

constexpr double kSurely = 1 - 1e-12;

// A sample gives about a third of the largest number of solutions, each of which is scored until it is hopeless.
static constexpr double kScoringCost = 0.2 / 3;

double Strategy::cost() const { return solver.cost + kScoringCost * solver.maxSolutions; }

SampleSize Strategy::size() const {
  return {solver.rays, solver.points, solver.draw, isStaged() ? StagedSampling::kSeventhRays : 1};
}

double Strategy::yield() const { return isStaged() ? StagedSampling::kYield : 1; }

// A single camera gives no spread rays.
static bool canDraw(const Sampler& sampler, const Strategy& strategy) {
  return sampler.canDraw(strategy.size()) && (strategy.solver.draw != RayDraw::Spread || sampler.numberCameras() > 1);
}

// Where a problem can be drawn in its easy way, the way behind that in the table, which takes much longer, gets a part of the weight.
static void addStrategies(const sac::SolverPrior& entry, const Sampler& sampler, std::vector<Strategy>& result) {
  constexpr double kOfTheHarderWay = 0.2;
  double prior = entry.prior;
  for (const solvers::MinimalSolver& solver : solvers::rowsOf(entry.solver)) {
    const Strategy strategy{solver, prior};
    if (!canDraw(sampler, strategy)) continue;
    result.push_back(strategy);
    prior = kOfTheHarderWay * entry.prior;
  }
}

static bool suits(const solvers::MinimalSolver& solver, FocalLengthKnowledge known) {
  switch (known) {
    case FocalLengthKnowledge::None:
      return solver.intrinsics.focalLength || solver.rays == 0;
    case FocalLengthKnowledge::Prior:
      return true;
    case FocalLengthKnowledge::Exact:
      return !solver.intrinsics.focalLength;
  }
  return false;
}

std::vector<Strategy> makeStrategies(const std::vector<sac::SolverPrior>& priors, const Sampler& sampler,
                                     FocalLengthKnowledge known) {
  std::vector<Strategy> result;
  for (const sac::SolverPrior& entry : priors)
    if (suits(*solvers::rowsOf(entry.solver).begin(), known)) addStrategies(entry, sampler, result);
  return result;
}

// Of samples with inliers only, half lead to a pose that is believed. In a staged one several seventh rays are tried.
static std::vector<InlierBelief::SampleKind> sampleKinds(const std::vector<Strategy>& strategies) {
  constexpr double kBelieved = 0.5;
  std::vector<InlierBelief::SampleKind> result;
  for (const Strategy& strategy : strategies) {
    const int rays = strategy.isStaged() ? strategy.solver.rays - 1 : strategy.solver.rays;
    result.push_back({rays, strategy.solver.points, kBelieved * strategy.yield()});
  }
  return result;
}

SolverChoice::SolverChoice(std::vector<Strategy> strategies)
    : strategies_(std::move(strategies)), drawn_(strategies_.size(), 0), cumulativeWeight_(strategies_.size(), 0) {
  setWeights();
}

std::size_t SolverChoice::choose(double uniform) const {
  const double target = uniform * cumulativeWeight_.back();
  const auto found = std::upper_bound(cumulativeWeight_.begin(), cumulativeWeight_.end(), target);
  return static_cast<std::size_t>(std::min(found, cumulativeWeight_.end() - 1) - cumulativeWeight_.begin());
}

void SolverChoice::setAllInlierProbabilities(const std::vector<double>& probabilities) {
  allInlier_ = probabilities;
  setWeights();
}

void SolverChoice::learnFromFailures() {
  // Before, they say little.
  constexpr int kFewSamples = 128;
  if (!allInlier_.empty() || std::accumulate(drawn_.begin(), drawn_.end(), 0) < kFewSamples) return;
  if (!belief_) belief_.emplace(sampleKinds(strategies_));
  // Probabilities per time, in proportion to which the time is shared out, not the samples: one that takes long must not use up the
  // time before it is known to be hopeless.
  std::vector<double> weights = belief_->successProbabilities(drawn_);
  for (std::size_t s = 0; s < weights.size(); ++s) weights[s] /= strategies_[s].cost();
  setWeights(weights, kHopelessIfBelieved);
}

void SolverChoice::setWeights() {
  const bool isKnown = !allInlier_.empty() && *std::max_element(allInlier_.begin(), allInlier_.end()) > 0;
  if (isKnown)
    setWeights(certainties(), kHopeless);
  else
    setWeights(std::vector<double>(strategies_.size(), 1), std::numeric_limits<double>::infinity());
}

std::vector<double> SolverChoice::certainties() const {
  std::vector<double> result(allInlier_.size());
  std::transform(allInlier_.begin(), allInlier_.end(), result.begin(),
                 [](double p) { return -std::log1p(-std::min(p, kSurely)); });
  return result;
}

void SolverChoice::setWeights(const std::vector<double>& probabilities, double hopeless) {
  std::vector<double> rates(strategies_.size());
  for (std::size_t s = 0; s < rates.size(); ++s) rates[s] = strategies_[s].prior * probabilities[s] / strategies_[s].cost();
  const double best = rates.empty() ? 0 : *std::max_element(rates.begin(), rates.end());
  for (double& rate : rates)
    if (rate * hopeless < best) rate = 0;
  std::partial_sum(rates.begin(), rates.end(), cumulativeWeight_.begin());
}

double SolverChoice::missProbability() const {
  double result = 1;
  for (std::size_t s = 0; s < allInlier_.size(); ++s) result *= std::pow(1 - allInlier_[s], drawn_[s]);
  return result;
}

double SolverChoice::samplesUntil(double targetMissProbability) const {
  double rate = 0, before = 0;  // of the logarithm, per sample
  for (std::size_t s = 0; s < allInlier_.size(); ++s) {
    const double share = (cumulativeWeight_[s] - before) / cumulativeWeight_.back();
    before = cumulativeWeight_[s];
    rate -= share * std::log1p(-std::min(allInlier_[s], kSurely));
  }
  return rate > 0 ? std::log(std::max(missProbability(), targetMissProbability) / targetMissProbability) / rate : 0;
}

}  // namespace robust
}  // namespace hybridgv

#include "robust/SolverChoice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace hybridgv {
namespace robust {
namespace {

// Five rays from one camera and a point: microseconds per call.
constexpr double kOneCameraCost = 14;
// A sample gives about a third of the largest number of solutions, each of which is scored until it is hopeless.
constexpr double kScoringCost = 0.2 / 3;

void addStrategy(const solvers::MinimalSolver& solver, RayDraw rayDraw, double solverCost, double prior, const Sampler& sampler,
                 std::vector<Strategy>& strategies) {
  const SampleSize size{solver.rays, solver.points, rayDraw};
  if (!sampler.canDraw(size)) return;
  strategies.push_back({solver.id, size, solver.solve, prior, solverCost + kScoringCost * solver.maxSolutions});
}

}  // namespace

std::vector<Strategy> makeStrategies(const std::vector<sac::SolverPrior>& priors, const Sampler& sampler) {
  std::vector<Strategy> result;
  for (const sac::SolverPrior& entry : priors) {
    const solvers::MinimalSolver& solver = solvers::minimalSolver(entry.solver);
    if (entry.solver != Solver::H51f) {
      addStrategy(solver, RayDraw::Uniform, solver.cost, entry.prior, sampler, result);
      continue;
    }
    addStrategy(solver, RayDraw::OneCamera, kOneCameraCost, entry.prior, sampler, result);
    if (sampler.numberCameras() > 1) addStrategy(solver, RayDraw::Spread, solver.cost, entry.prior, sampler, result);
  }
  return result;
}

SolverChoice::SolverChoice(std::vector<Strategy> strategies)
    : strategies_(std::move(strategies)), drawn_(strategies_.size(), 0), cumulativeWeight_(strategies_.size(), 0) {
  update();
}

std::size_t SolverChoice::choose(double uniform) const {
  const double target = uniform * cumulativeWeight_.back();
  const auto found = std::upper_bound(cumulativeWeight_.begin(), cumulativeWeight_.end(), target);
  return static_cast<std::size_t>(std::min(found, cumulativeWeight_.end() - 1) - cumulativeWeight_.begin());
}

void SolverChoice::setAllInlierProbabilities(const std::vector<double>& probabilities) {
  allInlier_ = probabilities;
  update();
}

void SolverChoice::update() {
  const bool isKnown = !allInlier_.empty() && *std::max_element(allInlier_.begin(), allInlier_.end()) > 0;
  std::vector<double> rates(strategies_.size());
  for (std::size_t s = 0; s < rates.size(); ++s)
    rates[s] = strategies_[s].prior * (isKnown ? allInlier_[s] : 1) / strategies_[s].cost;
  if (isKnown) discount(rates);
  std::partial_sum(rates.begin(), rates.end(), cumulativeWeight_.begin());
}

// Multiplies the rates by (1 - P_s)^k_s, over the largest of these, and drops the hopeless ones.
void SolverChoice::discount(std::vector<double>& rates) const {
  const double best = *std::max_element(rates.begin(), rates.end());
  double largest = -std::numeric_limits<double>::infinity();
  std::vector<double> logNotFound(rates.size());
  for (std::size_t s = 0; s < rates.size(); ++s) {
    if (rates[s] * kHopeless < best) rates[s] = 0;
    logNotFound[s] = drawn_[s] > 0 ? drawn_[s] * std::log1p(-allInlier_[s]) : 0;
    if (rates[s] > 0) largest = std::max(largest, logNotFound[s]);
  }
  if (std::isinf(largest)) return;  // every one of them has certainly found it
  for (std::size_t s = 0; s < rates.size(); ++s)
    if (rates[s] > 0) rates[s] *= std::exp(logNotFound[s] - largest);
}

double SolverChoice::missProbability() const {
  double result = 1;
  for (std::size_t s = 0; s < allInlier_.size(); ++s) result *= std::pow(1 - allInlier_[s], drawn_[s]);
  return result;
}

}  // namespace robust
}  // namespace hybridgv

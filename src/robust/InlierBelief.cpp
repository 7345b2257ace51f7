#include "robust/InlierBelief.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace robust {

// A grid of this number of shares of each kind.
static constexpr std::size_t kShares = 16, kCells = kShares * kShares;

// Of each share on the grid, the powers 0 .. kMaxSampleSize.
static std::vector<std::array<double, solvers::kMaxSampleSize + 1>> powersOfShares() {
  std::vector<std::array<double, solvers::kMaxSampleSize + 1>> result(kShares);
  for (std::size_t i = 0; i < kShares; ++i) {
    result[i][0] = 1;
    for (std::size_t k = 1; k < result[i].size(); ++k) result[i][k] = result[i][k - 1] * (static_cast<double>(i) + 0.5) / kShares;
  }
  return result;
}

InlierBelief::InlierBelief(const std::vector<SampleKind>& samples) : kinds_(samples.size()) {
  const auto powers = powersOfShares();
  success_.reserve(kCells * kinds_);
  logFailure_.reserve(kCells * kinds_);
  logPrior_.reserve(kCells);
  for (std::size_t rays = 0; rays < kShares; ++rays)
    for (std::size_t points = 0; points < kShares; ++points) {
      logPrior_.push_back(std::log(1. / kCells + (rays == points ? 1. / kShares : 0)));
      for (const SampleKind& sample : samples) {
        success_.push_back(sample.yield * powers[rays][static_cast<std::size_t>(sample.rays)] *
                           powers[points][static_cast<std::size_t>(sample.points)]);
        logFailure_.push_back(std::log1p(-success_.back()));
      }
    }
}

std::vector<double> InlierBelief::successProbabilities(const std::vector<int>& failures) const {
  std::vector<double> logWeights = logPrior_;
  for (std::size_t cell = 0; cell < kCells; ++cell)
    for (std::size_t s = 0; s < kinds_; ++s) logWeights[cell] += failures[s] * logFailure_[cell * kinds_ + s];
  const double largest = *std::max_element(logWeights.begin(), logWeights.end());
  std::vector<double> result(kinds_, 0);
  double all = 0;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double weight = std::exp(logWeights[cell] - largest);
    all += weight;
    for (std::size_t s = 0; s < kinds_; ++s) result[s] += weight * success_[cell * kinds_ + s];
  }
  for (double& probability : result) probability /= all;
  return result;
}

}  // namespace robust
}  // namespace hybridgv

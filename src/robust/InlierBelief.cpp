#include "robust/InlierBelief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridgv {
namespace robust {

// A grid of this number of shares of each kind.
static constexpr int kShares = 16;

InlierBelief::InlierBelief(const std::vector<SampleKind>& samples) {
  const auto share = [](int i) { return (i + 0.5) / kShares; };
  cells_.reserve(kShares * kShares);
  for (int rays = 0; rays < kShares; ++rays)
    for (int points = 0; points < kShares; ++points) {
      Cell cell{1. / (kShares * kShares) + (rays == points ? 1. / kShares : 0), {}, {}};
      for (const SampleKind& sample : samples) {
        cell.success.push_back(sample.yield * std::pow(share(rays), sample.rays) * std::pow(share(points), sample.points));
        cell.logFailure.push_back(std::log1p(-cell.success.back()));
      }
      cells_.push_back(std::move(cell));
    }
}

std::vector<double> InlierBelief::successProbabilities(const std::vector<int>& failures) const {
  std::vector<double> logWeights;
  logWeights.reserve(cells_.size());
  double largest = -std::numeric_limits<double>::infinity();
  for (const Cell& cell : cells_) {
    double sum = std::log(cell.prior);
    for (std::size_t s = 0; s < failures.size(); ++s) sum += failures[s] * cell.logFailure[s];
    logWeights.push_back(sum);
    largest = std::max(largest, sum);
  }
  std::vector<double> result(failures.size(), 0);
  double all = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double weight = std::exp(logWeights[i] - largest);
    all += weight;
    for (std::size_t s = 0; s < result.size(); ++s) result[s] += weight * cells_[i].success[s];
  }
  for (double& probability : result) probability /= all;
  return result;
}

}  // namespace robust
}  // namespace hybridgv

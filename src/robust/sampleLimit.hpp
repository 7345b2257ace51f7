// How many samples are worth drawing from few correspondences.
#pragma once

#include <vector>

#include "robust/ChanceModel.hpp"
#include "robust/Sampler.hpp"
#include "robust/SolverChoice.hpp"

namespace hybridgv {
namespace robust {

// How many different samples of this size there are.
double numberOfSamples(const Sampler& sampler, const SampleSize& size);

// As many draws as let nearly every sample be drawn once. `variants`: how many solutions of one sample differ by what is drawn
// beside it (a distortion).
double drawsOfAllSamples(const Sampler& sampler, const std::vector<Strategy>& strategies, std::size_t variants);

// Whether not even a pose with which all correspondences agree exactly could be relied on. `logOdds`: of the focal length's prior at its middle.
bool isHopeless(const Sampler& sampler, const ChanceModel& chance, int parameters, double logOdds);

// The smallest numbers of inliers with which a pose can be relied on: for each number of points the least one of rays, if all are exact.
// A search without result has missed every pose with more.
class LeastSupports {
 public:
  // A search in so many points that six right ones are hardly met is not worth the question.
  static constexpr int kMostPoints = 40;

  // `variants`: one of so many solutions of a sample is the right one (drawsOfAllSamples).
  LeastSupports(const Sampler& sampler, const std::vector<Strategy>& strategies, std::size_t variants, const ChanceModel& chance,
                int parameters, double logOdds);
  // The largest probability that so many draws of each strategy have missed one of them.
  double missProbability(const std::vector<int>& drawn) const;

 private:
  std::size_t strategies_;
  std::vector<double> logFailure_;  // of each support, and for it of a sample of each strategy
};

}  // namespace robust
}  // namespace hybridgv

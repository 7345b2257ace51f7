// Which solver to draw next, and when all of them together have tried enough.
#pragma once

#include <optional>
#include <vector>

#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/InlierBelief.hpp"
#include "robust/Sampler.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace robust {

// A row of the table of minimal problems, with the weight of its choice.
struct Strategy {
  solvers::MinimalSolver solver;
  double prior;

  // Six rays of one camera and a seventh (StagedSampling); not five and a sixth for a known focal length.
  bool isStaged() const { return solver.draw == RayDraw::AllButOne && solver.intrinsics.focalLength; }
  SampleSize size() const;
  // Of samples with inliers only, the share that leads to the right pose.
  double yield() const;
  double cost() const;  // microseconds per sample, scoring included
};

enum class FocalLengthKnowledge { None, Prior, Exact };

// The strategies for the given solvers that have enough data and suit what is known of the focal length: where that is exact, those
// that need it; where nothing is known, those that estimate it and P3P, at a guess (with rays in the sample, less is gained by a
// point less than is lost by the guess); with a prior all.
std::vector<Strategy> makeStrategies(const std::vector<sac::SolverPrior>& solvers, const Sampler& sampler,
                                     FocalLengthKnowledge known = FocalLengthKnowledge::None);

// A strategy s is drawn with probability proportional to prior x -log(1 - P_s) / cost, P_s the probability that its sample has inliers
// only: by so much a sample brings down the log of the probability to have missed one. There is no factor (1 - P_s)^k_s for its k_s
// samples so far, as in Camposeco et al. (CVPR 2018): samples are independent, a solver is as good after many as before, and with such
// a factor most of the time goes to slower solvers.
class SolverChoice {
 public:
  explicit SolverChoice(std::vector<Strategy> strategies);

  const std::vector<Strategy>& strategies() const { return strategies_; }
  const std::vector<int>& drawn() const { return drawn_; }
  // The strategy for a uniform random number in [0, 1).
  std::size_t choose(double uniform) const;

  void addDraws(std::size_t strategy, int count) { drawn_[strategy] += count; }
  // Tells the probabilities P_s, by the best pose so far. Until then every strategy gets the same share of the time, times its
  // prior, and after many samples what they say: learnFromFailures.
  void setAllInlierProbabilities(const std::vector<double>& probabilities);
  // No sample so far has led to a pose that is believed.
  void learnFromFailures();

  // Probability that no sample so far had inliers only: prod (1 - P_s)^k_s; 1 until the probabilities are known.
  double missProbability() const;
  // How many more samples bring that probability below a target; 0 until the probabilities are known.
  double samplesUntil(double targetMissProbability) const;

 private:
  // A strategy is not drawn if another finds an all-inlier sample this many times faster.
  static constexpr double kHopeless = 1.5;
  // The same where that is only believed.
  static constexpr double kHopelessIfBelieved = 10;

  std::vector<double> certainties() const;  // -log(1 - P_s)
  void setWeights();
  void setWeights(const std::vector<double>& probabilities, double hopeless);

  std::vector<Strategy> strategies_;
  std::vector<int> drawn_;
  std::vector<double> allInlier_, cumulativeWeight_;
  std::optional<InlierBelief> belief_;
};

}  // namespace robust
}  // namespace hybridgv

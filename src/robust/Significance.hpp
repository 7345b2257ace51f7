// Whether a pose can be trusted: its inliers are too many to be chance, and fix it.
#pragma once

#include <cstdint>
#include <optional>

#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/ChanceModel.hpp"
#include "robust/Evidence.hpp"
#include "robust/FocalLengthPrior.hpp"
#include "robust/OtherPairs.hpp"
#include "robust/PoseScorer.hpp"
#include "robust/Sampler.hpp"
#include "robust/WorkerPool.hpp"

namespace hybridgv {
namespace robust {

// log10 of the expected number of wrong poses that look like a result.
constexpr double kLogFalseAlarms = -6;
// The same without points. A part of the rays can agree with a pose near the right one much better than with one that is wrong in every way, and
// up to half of them are inliers there.
constexpr double kLogFalseAlarmsOfRays = -25;
// One of 49 choices of the two kinds' levels is the best by chance: log10 of their number.
constexpr double kLogChoices = 1.690196080028514;
static_assert(kLevels * kLevels == 49, "kLogChoices");

// Of many wrong poses some look good by chance. What counts is therefore the expected number of wrong poses, among those tried so
// far, that look as good as the pose in question: the probability that one does times their number.
//
// For a minimal solution that probability follows from its inliers and the extents of the images (ChanceModel), which is fast. For a
// pose that is to be believed it is the smallest one over the thresholds T, T/2, T/4, .. of both kinds, of its *different* inliers
// (Evidence), with the shares of inliers that other pairs of the same data have (OtherPairs) where these are larger.
class Significance {
 public:
  // What is given by reference must outlive the object. `parameters`: of a pose, as they are fitted to its inliers.
  Significance(const PoseScorer& scorer, const ChanceModel& chance, const Sampler& sampler, const QueryFeatures& features,
               WorkerPool& workers, int parameters, std::uint64_t seed);

  // As above, from now on.
  void setParameters(int parameters) { parameters_ = parameters; }
  // What is known of the focal length: a pose that agrees with it is less likely a wrong one.
  void setFocalLengthPrior(const FocalLengthPrior& prior) { focalLengthPrior_ = prior; }
  // Tells how many samples have been drawn so far.
  void setSamples(int samples);

  // log10 of the probability that a wrong pose looks as good as a pose with these inliers.
  double logChance(const Evaluation& evaluation) const;
  // The same if wrong poses have these shares of inliers; the evaluation's scales must be those of levels.
  double logChance(const Evaluation& evaluation, const Shares& shares) const;
  // Shares of inliers that other pairs have at a pose, after preparePairs().
  Shares sharesOfPairs(const QueryPose& pose) const;
  void preparePairs();
  // Whether less than one wrong pose is expected to look as good: the solution deserves a closer look.
  bool isPromising(double logChance) const;
  // The same by the shares of inliers that other pairs of the same data have, too: slower, but true of data that crowd.
  bool isPromising(const QueryPose& pose);
  // Whether chance is as good as excluded.
  bool isSignificant(const QueryPose& pose);
  // Whether the pose can be trusted at last, else why not. `isDetermined`: its inliers fix all parameters.
  sac::FailureReason verdict(const QueryPose& pose, const Evaluation& evaluation, const InlierCounts& inliers, bool isDetermined);

 private:
  // log10 of the expected number of wrong poses that look as good.
  double logAlarms(double logChance) const { return logChance + logSamples_; }
  Support supportOf(const Evaluation& evaluation) const;
  bool isLessLikelyThan(double logFalseAlarms, const QueryPose& pose);

  // The inliers at one choice of levels.
  struct Counted {
    PerKind<int> levels;
    Support all, different;
  };
  Counted countedAtClearestLevels(const PerKind<std::vector<double>>& squaredErrors, const Shares& shares) const;
  // Whether the probability that a wrong pose looks as good is below the bound (log10), for the shares of inliers that wrong poses have.
  bool isLessLikely(const Counted& counted, const Shares& shares, double logBound) const;
  bool isLessLikelyAtAnyLevels(const PerKind<std::vector<double>>& squaredErrors, const Shares& shares, double logBound) const;
  InlierMasks inliersAt(const PerKind<std::vector<double>>& squaredErrors, const PerKind<int>& levels) const;
  bool hasFixedScale(const QueryPose& pose, const InlierCounts& inliers) const;

  const PoseScorer& scorer_;
  const ChanceModel& chance_;
  const Sampler& sampler_;
  const QueryFeatures& features_;
  WorkerPool& workers_;
  int parameters_;
  std::uint64_t seed_;
  double logSamples_ = 0;
  FocalLengthPrior focalLengthPrior_;
  Evidence evidence_;
  // Made when they are first needed.
  std::optional<OtherPairs> fewPairs_, randomPairs_, neighboursOfRays_, neighboursOfPoints_;
};

}  // namespace robust
}  // namespace hybridgv

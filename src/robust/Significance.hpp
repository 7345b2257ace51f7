// Whether a pose can be trusted: its inliers are too many to be chance, and fix it.
#pragma once

#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/ChanceModel.hpp"
#include "robust/PoseScorer.hpp"

namespace hybridgv {
namespace robust {

// Of many wrong poses some look good by chance. What counts is therefore the expected number of wrong poses, among those tried so
// far, that look as good as the pose in question: the probability that one does times their number.
class Significance {
 public:
  // The chance model and the sampler must outlive the object. `parameters`: of a pose, as they are fitted to its inliers.
  Significance(const ChanceModel& chance, const Sampler& sampler, int parameters);

  // Tells how many samples have been drawn so far.
  void setSamples(int samples);

  // log10 of the probability that a wrong pose looks as good as one with these inliers and this focal length.
  double logChance(const Evaluation& evaluation, double focalLength) const;
  // Whether less than one wrong pose is expected to look as good: the pose deserves a closer look.
  bool isPromising(double logChance) const;
  // Whether chance is as good as excluded.
  bool isSignificant(double logChance) const;
  // Whether the pose can be trusted at last, else why not. `isRegular`: its information matrix is.
  sac::FailureReason verdict(const Evaluation& evaluation, double focalLength, const InlierCounts& inliers, bool isRegular) const;

 private:
  Support support(const Evaluation& evaluation) const;
  // log10 of the expected number of wrong poses that look as good.
  double logAlarms(double logChance) const { return logChance + logSamples_; }
  bool isMoreThanChance(const Evaluation& evaluation, double focalLength) const;
  bool hasFixedScale(const Evaluation& evaluation, double focalLength, const InlierCounts& inliers) const;

  const ChanceModel& chance_;
  const Sampler& sampler_;
  int parameters_;
  double logSamples_ = 0;
};

}  // namespace robust
}  // namespace hybridgv

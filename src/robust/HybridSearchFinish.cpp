// From the best model of a search to its result.
#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/HybridSearch.hpp"
#include "robust/LikelierPose.hpp"
#include "robust/TurnAboutLine.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Gain of the log-likelihood for which an optimization is repeated.
constexpr double kLeastGain = 1;
constexpr std::initializer_list<double> kDistanceFactors = {1.25, 1.6, 0.8, 0.6};
// A standard deviation of log f below which the linear theory behind it can be relied on.
constexpr double kSmallDeviation = 0.05;

}  // namespace

// Distance and focal length have almost the same effect on the images, so that the likelihood has local optima along both. The
// right one is found from nearer or farther away, the focal length keeping the images' size. A known focal length has no such optima.
void HybridSearch::escapeLocalOptimum(Model& model, std::initializer_list<double> distanceFactors) const {
  if (!estimated_.focalLength) return;
  model.logLikelihood = optimizer_.logLikelihood(model.pose);
  for (const double factor : distanceFactors)
    for (double before = -std::numeric_limits<double>::infinity(); model.logLikelihood > before + kLeastGain;) {
      before = model.logLikelihood;
      const Kinds kinds = optimizer_.moreThanChance(model.pose);
      replaceIfLikelier(optimizer_.settle(optimizer_.atDistance(model.pose, factor), kinds), model);
    }
}

// The best model to full precision.
FinalPose HybridSearch::polishBest() { return bestBeside(optimizer_.finish(optimumOfBest())); }

// Keeps the distortion only if the data speak for it.
Optimum HybridSearch::optimumOfBest() {
  Optimum result = polished();
  if (!estimated_.radial || optimizer_.logEvidenceForDistortion(result) > options_.distortionEvidence) return result;
  best_.pose = result.pose;
  takeOutDistortion();
  return polished();
}

// The thresholds at the optimum may be others than those at the pose from which it was found. The noise depends on them where there are
// few matches, and so would the result depend on where the search came from.
Optimum HybridSearch::polished() {
  constexpr int kMostRounds = 4;
  constexpr double kSame = 0.1;
  Optimum result = optimizer_.polish(best_.pose);
  for (int round = 1; round < kMostRounds; ++round) {
    const Thresholds before = scorer_.thresholds(), there = thresholdsAt(result.pose);
    const double change =
        std::max(std::abs(std::log(there.rays / before.rays)), std::abs(std::log(there.points / before.points)));
    if (!(change > kSame)) break;
    scorer_.setThresholds(there);
    best_.pose = result.pose;
    result = optimizer_.polish(best_.pose);
  }
  return result;
}

void HybridSearch::takeOutDistortion() {
  estimated_.radial = false;
  optimizer_.forgetDistortion();
  significance_.setParameters(estimated_.parameters());
  best_.pose.distortion = 0;
  if (optimizer_.focalLengthIsSure(best_.pose)) return;
  escapeLocalOptimum(best_, kDistanceFactors);
  findThresholds(best_);
}

// Where groups of correspondences (the rays of a camera) disagree by much more than their noise, and a lens of which little is known can give
// way, the likelihood has optima near each other, one for each part of them that is believed. From each side, the best of these
// within the deviation is looked for.
FinalPose HybridSearch::bestBeside(FinalPose best) const {
  if (!lens_.isUnknown || !estimated_.focalLength) return best;
  constexpr int kRounds = 3;
  constexpr double kDisagreement = 2, kDeviations = 2;
  bool isBest = false;
  for (int round = 0; round < kRounds && !isBest; ++round) {
    isBest = true;
    const double deviation = deviationOf(best);
    if (!(deviation < kSmallDeviation) || !(best.effectiveParameters > kDisagreement * estimated_.parameters())) break;
    const double step = kDeviations * deviation;
    const FinalPose others[] = {polishedAtDistance(best, std::exp(step)), polishedAtDistance(best, std::exp(-step))};
    for (const FinalPose& other : others) {
      if (!isBetterDetermined(other, best)) continue;
      best = other;
      isBest = false;
    }
  }
  return best;
}

FinalPose HybridSearch::likelierOfMirrored(const FinalPose& pose, const LookAlikes& others, const LocalOptimizer& optimizer,
                                           const PoseScorer& scorer) {
  const LikelierPose likelier = likelierPose(pose, others, optimizer, scorer, estimated_);
  mirrored_ = likelier.nearlyAsLikely;
  return likelier.pose;
}

FinalPose HybridSearch::polishedAtDistance(const FinalPose& pose, double factor) const {
  const QueryPose start = optimizer_.atDistance(pose.pose, factor);
  return optimizer_.finish(optimizer_.polish(optimizer_.settle(start, optimizer_.moreThanChance(start))));
}

// Better determined, and likelier: for these correspondences, or for other groups of the same kind, which do not share the errors to
// which a pose has been fitted (Takeuchi's criterion, by groups).
bool HybridSearch::isBetterDetermined(const FinalPose& pose, const FinalPose& than) const {
  if (!(deviationOf(pose) <= deviationOf(than))) return false;
  const double gain = optimizer_.logLikelihood(pose.pose) - optimizer_.logLikelihood(than.pose);
  return gain > kLeastGain || gain - (pose.effectiveParameters - than.effectiveParameters) > kLeastGain;
}

double HybridSearch::deviationOf(const FinalPose& pose) const {
  return pose.isRegular ? std::sqrt(varianceOfLogFocalLength(pose.covariance, estimated_))
                        : std::numeric_limits<double>::infinity();
}

// The noise that is found at a pose depends on what counts as an inlier. So wrong rays, where there are many, can hold a pose near the
// right one by a noise that is too large; a narrower threshold leads on from there.
void HybridSearch::tryNarrowerThreshold(Model& model) {
  constexpr double kNarrower = 0.25, kMany = 1 / 3.;
  const int all = data_.sampler.numberRays();
  if (all - model.evaluation.rays < kMany * all) return;
  setThresholds(model);
  model.logLikelihood = optimizer_.logLikelihood(model.pose);
  const Thresholds wide = scorer_.thresholds();
  scorer_.setThresholds({kNarrower * wide.rays, wide.points});
  Model narrower = model;
  narrower.pose = optimizer_.settle(model.pose, optimizer_.moreThanChance(model.pose));
  findThresholds(narrower);
  if (narrower.logLikelihood > model.logLikelihood + kLeastGain)
    model = narrower;
  else
    scorer_.setThresholds(wide);
}

FinalPose HybridSearch::finish(bool optimize) {
  if (optimize) tryNarrowerThreshold(best_);
  if (optimize && !optimizer_.focalLengthIsSure(best_.pose)) {
    escapeLocalOptimum(best_, kDistanceFactors);
    findThresholds(best_);
  }
  FinalPose result = optimize ? polishBest() : optimizer_.finish(optimizer_.keep(best_.pose));
  if (optimize && roughlyKnownFocalLength(options_) > 0)
    result = likelierOfMirrored(result, lookAlikes(scorer_, result.pose), optimizer_, scorer_);
  if (part_)
    result = fitToAll(result, optimize);
  else
    optimizer_.allowForPrincipalPoint(options_.principalPointDeviationPx, result);
  best_.pose = result.pose;
  scorer_.setThresholds({result.noise.rays.boundary, result.noise.points.boundary});
  best_.evaluation = scorer_.evaluate(best_.pose);
  if (!part_) judgeAll(scorer_);
  return result;
}

FinalPose HybridSearch::fitToAll(const FinalPose& ofPart, bool optimize) {
  PoseScorer scorer(all_.arrays, scorer_.bounds(), options_.scoring);
  scorer.setWorkers(workers_);
  scorer.setThresholds(scorer_.thresholds());
  workers_.finishTask();
  LocalOptimizer optimizer = makeOptimizer(scorer, chance_, *featuresOfAll_);
  optimizer.setWorkers(workers_);
  FinalPose result =
      optimizer.finish(optimize ? optimizer.polishNear(ofPart.pose, ofPart.rayWeight) : optimizer.keep(ofPart.pose));
  if (mirrored_) result = likelierOfMirrored(result, {{*mirrored_}, {}}, optimizer, scorer);
  optimizer.allowForPrincipalPoint(options_.principalPointDeviationPx, result);
  best_.pose = result.pose;
  scorer.setThresholds({result.noise.rays.boundary, result.noise.points.boundary});
  judgeAll(scorer);
  return result;
}

void HybridSearch::judgeAll(const PoseScorer& scorer) {
  inliers_ = scorer.inliers(best_.pose);
  score_ = scorer.evaluate(best_.pose).score;
}

sac::FailureReason HybridSearch::verdict(const FinalPose& final) {
  return significance_.verdict(best_.pose, best_.evaluation, inlierCounts(best_.pose), isDetermined(final));
}

// A large standard deviation is not exact: then the likelihood itself must fall on both sides.
bool HybridSearch::isDetermined(const FinalPose& final) const {
  constexpr double kLargestTurn = 0.15;  // a standard deviation [rad]
  constexpr double kAtLeast = 1.001;
  if (!final.isRegular) return false;
  if (options_.minFocalLength < leastFocalLength_ && !(final.pose.focalLength > kAtLeast * leastFocalLength_)) return false;
  if (!(deviationOfTurn(scorer_, final.pose, final.noise.points.deviation, optimizer_.rayNoise(final)) < kLargestTurn))
    return false;
  const double deviation =
      std::max(std::sqrt(varianceOfLogFocalLength(final.covariance, estimated())), final.deviationWithoutLevers);
  if (!(deviation < options_.maxFocalLengthDeviation)) return false;
  return deviation < kSmallDeviation || optimizer_.focalLengthIsDetermined(final);
}

}  // namespace robust
}  // namespace hybridgv

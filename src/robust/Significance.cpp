#include "robust/Significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "correspondences/Intrinsics.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

using SquaredErrors = PerKind<std::vector<double>>;

// If wrong poses had the larger shares of inliers that pairs of neighbours have, which most of them have not.
constexpr double kLogFalseAlarmsOfNeighbours = -2;

// Random pairs that are counted first, and the number of correspondences from which on that saves something.
constexpr std::size_t kFewPairs = OtherPairs::kPairs / 4;
constexpr int kMany = 64;

int mostFittedPoints(int parameters) { return (parameters + 1) / 2; }
int fittedRays(int parameters, int fittedPoints) { return std::max(parameters - 2 * fittedPoints, 0); }

// ChanceModel::logProbability at every two levels, if every correspondence counts. The tails of the binomial distributions, of which
// it is made up, are computed once: for each number of fitted points, and of the rays that are fitted besides.
class LevelTails {
 public:
  static LevelTails ofRays(const std::vector<double>& squaredErrors, double threshold, const LevelShares& shares,
                           int parameters) {
    return {squaredErrors, threshold, shares, parameters, [=](int fittedPoints) { return fittedRays(parameters, fittedPoints); }};
  }
  static LevelTails ofPoints(const std::vector<double>& squaredErrors, double threshold, const LevelShares& shares,
                             int parameters) {
    return {squaredErrors, threshold, shares, parameters, [](int fittedPoints) { return fittedPoints; }};
  }
  int inliers(int level) const { return inliers_[static_cast<std::size_t>(level)]; }
  double tail(int level, int fittedPoints) const {
    return tails_[static_cast<std::size_t>(level)][static_cast<std::size_t>(fittedPoints)];
  }

 private:
  template <class Fitted>
  LevelTails(const std::vector<double>& squaredErrors, double threshold, const LevelShares& shares, int parameters,
             const Fitted& fitted)
      : inliers_(countLevels(squaredErrors.data(), squaredErrors.size(), threshold * threshold)) {
    const int all = static_cast<int>(squaredErrors.size());
    for (std::size_t level = 0; level < kLevels; ++level)
      for (int points = 0; points <= mostFittedPoints(parameters); ++points)
        tails_[level][static_cast<std::size_t>(points)] =
            logTail(all - fitted(points), inliers_[level] - fitted(points), shares[level]);
  }

  LevelCounts inliers_;
  std::array<std::array<double, (correspondences::kMostParameters + 1) / 2 + 1>, kLevels> tails_{};
};

double logProbability(const LevelTails& rays, const LevelTails& points, const PerKind<int>& levels, int parameters) {
  double worst = -std::numeric_limits<double>::infinity();
  const int mostPoints = std::min(mostFittedPoints(parameters), points.inliers(levels.points));
  for (int fittedPoints = 0; fittedPoints <= mostPoints; ++fittedPoints) {
    if (fittedRays(parameters, fittedPoints) > rays.inliers(levels.rays) && fittedPoints < mostPoints) continue;
    worst = std::max(worst, points.tail(levels.points, fittedPoints) + rays.tail(levels.rays, fittedPoints));
  }
  return worst / std::log(10.);
}

std::vector<char> below(const std::vector<double>& squaredErrors, double threshold) {
  std::vector<char> mask(squaredErrors.size());
  std::transform(squaredErrors.begin(), squaredErrors.end(), mask.begin(),
                 [=](double error) { return static_cast<char>(error < threshold * threshold); });
  return mask;
}

}  // namespace

Significance::Significance(const PoseScorer& scorer, const ChanceModel& chance, const Sampler& sampler,
                           const QueryFeatures& features, WorkerPool& workers, int parameters, std::uint64_t seed)
    : scorer_(scorer),
      chance_(chance),
      sampler_(sampler),
      features_(features),
      workers_(workers),
      parameters_(parameters),
      seed_(seed),
      evidence_(scorer.arrays(), features) {}

void Significance::setSamples(int samples) { logSamples_ = std::log10(samples + 1.); }

Support Significance::supportOf(const Evaluation& evaluation) const {
  return {evaluation.points, sampler_.numberPoints(), evaluation.rays, sampler_.numberRays()};
}

double Significance::logChance(const Evaluation& evaluation) const {
  const double rayShare = chance_.rayShare(evaluation.scale.rays), pointShare = chance_.pointShare(evaluation.scale.points);
  return ChanceModel::logProbability(supportOf(evaluation), rayShare, pointShare, parameters_) + kLogChoices;
}

double Significance::logChance(const Evaluation& evaluation, const Shares& shares) const {
  const double rayShare = shares.rays[levelOf(evaluation.scale.rays)],
               pointShare = shares.points[levelOf(evaluation.scale.points)];
  return ChanceModel::logProbability(supportOf(evaluation), rayShare, pointShare, parameters_) + kLogChoices;
}

void Significance::preparePairs() {
  if (!fewPairs_) fewPairs_ = OtherPairs::random(scorer_.arrays(), features_, seed_, kFewPairs);
}

Shares Significance::sharesOfPairs(const QueryPose& pose) const {
  return fewPairs_->shares(toPlain(pose), scorer_.bounds().rays, scorer_.bounds().points);
}

bool Significance::isPromising(double logChance) const { return logAlarms(logChance) < 0; }

bool Significance::isPromising(const QueryPose& pose) {
  const SquaredErrors errors{scorer_.squaredRayErrors(pose), scorer_.squaredPointErrors(pose)};
  preparePairs();
  return isLessLikelyAtAnyLevels(errors, largest(chance_.levelShares(), sharesOfPairs(pose)), -logSamples_ - kLogChoices);
}

bool Significance::isSignificant(const QueryPose& pose) { return isLessLikelyThan(kLogFalseAlarms, pose); }

bool Significance::isLessLikelyThan(double logFalseAlarms, const QueryPose& pose) {
  const double logOdds = focalLengthPrior_.logOdds(pose.focalLength);
  const SquaredErrors errors{scorer_.squaredRayErrors(pose), scorer_.squaredPointErrors(pose)};
  const PlainPose plain = toPlain(pose);
  const auto sharesOf = [&](const OtherPairs& pairs) {
    return pairs.shares(plain, scorer_.bounds().rays, scorer_.bounds().points);
  };
  Shares shares = chance_.levelShares();
  const Counted clearest = countedAtClearestLevels(errors, shares);
  const auto areLessLikelyThan = [&](double logFalseAlarmsOfShares) {
    const double logBound = logFalseAlarmsOfShares + logOdds - logSamples_ - kLogChoices;
    return isLessLikely(clearest, shares, logBound) || isLessLikelyAtAnyLevels(errors, shares, logBound);
  };
  if (!areLessLikelyThan(logFalseAlarms)) return false;
  const Shares ofEvenPoints = shares;
  const auto sharesOfNeighbours = [&](std::optional<OtherPairs>& neighbours, const Kinds& kinds) {
    if (!neighbours) neighbours = OtherPairs::ofNeighbours(scorer_.arrays(), evidence_, &workers_, kinds);
    return sharesOf(*neighbours);
  };
  const auto areWithPairs = [&](const Shares& ofRandomPairs) {
    shares = largest(ofEvenPoints, ofRandomPairs);
    if (!areLessLikelyThan(logFalseAlarms)) return false;
    shares = largest(shares, sharesOfNeighbours(neighboursOfPoints_, {false, true}));
    // As a rule the points are enough, even if all rays were accidents.
    const LevelShares ofRays = shares.rays;
    shares.rays.fill(1);
    if (areLessLikelyThan(kLogFalseAlarmsOfNeighbours)) return true;
    shares.rays = ofRays;
    shares = largest(shares, sharesOfNeighbours(neighboursOfRays_, {true, false}));
    return areLessLikelyThan(kLogFalseAlarmsOfNeighbours);
  };
  // Of many correspondences, mostly a few pairs tell.
  if (sampler_.numberRays() + sampler_.numberPoints() >= kMany) {
    preparePairs();
    if (areWithPairs(fewPairs_->mostOf(sharesOf(*fewPairs_)))) return true;
  }
  if (!randomPairs_) randomPairs_ = OtherPairs::random(scorer_.arrays(), features_, seed_);
  return areWithPairs(sharesOf(*randomPairs_));
}

// A pose that is right is so at many choices of levels, as a rule also at this one.
Significance::Counted Significance::countedAtClearestLevels(const SquaredErrors& errors, const Shares& shares) const {
  const PerKind<double>& bounds = scorer_.bounds();
  const LevelCounts rays = countLevels(errors.rays.data(), errors.rays.size(), bounds.rays * bounds.rays);
  const LevelCounts points = countLevels(errors.points.data(), errors.points.size(), bounds.points * bounds.points);
  const PerKind<int> levels{clearestLevel(rays, errors.rays.size(), shares.rays, 0),
                            clearestLevel(points, errors.points.size(), shares.points, 0)};
  const Support all{points[static_cast<std::size_t>(levels.points)], sampler_.numberPoints(),
                    rays[static_cast<std::size_t>(levels.rays)], sampler_.numberRays()};
  return {levels, all, evidence_.support(inliersAt(errors, levels))};
}

bool Significance::isLessLikely(const Counted& counted, const Shares& shares, double logBound) const {
  const double rayShare = shares.rays[static_cast<std::size_t>(counted.levels.rays)];
  const double pointShare = shares.points[static_cast<std::size_t>(counted.levels.points)];
  return ChanceModel::logProbability(counted.all, rayShare, pointShare, parameters_) < logBound &&
         ChanceModel::logProbability(counted.different, rayShare, pointShare, parameters_) < logBound;
}

bool Significance::isLessLikelyAtAnyLevels(const SquaredErrors& errors, const Shares& shares, double logBound) const {
  struct Choice {
    double logProbability;
    PerKind<int> levels;
  };
  const LevelTails rays = LevelTails::ofRays(errors.rays, scorer_.bounds().rays, shares.rays, parameters_);
  const LevelTails points = LevelTails::ofPoints(errors.points, scorer_.bounds().points, shares.points, parameters_);
  std::vector<Choice> choices;
  for (int a = 0; a < kLevels; ++a)
    for (int b = 0; b < kLevels; ++b) {
      const PerKind<int> levels{a, b};
      const double probability = logProbability(rays, points, levels, parameters_);
      if (probability < logBound) choices.push_back({probability, levels});
    }
  std::sort(choices.begin(), choices.end(), [](const Choice& x, const Choice& y) { return x.logProbability < y.logProbability; });
  return std::any_of(choices.begin(), choices.end(), [&](const Choice& choice) {
    const Support different = evidence_.support(inliersAt(errors, choice.levels));
    const double rayShare = shares.rays[static_cast<std::size_t>(choice.levels.rays)];
    const double pointShare = shares.points[static_cast<std::size_t>(choice.levels.points)];
    return ChanceModel::logProbability(different, rayShare, pointShare, parameters_) < logBound;
  });
}

InlierMasks Significance::inliersAt(const SquaredErrors& errors, const PerKind<int>& levels) const {
  return {below(errors.rays, thresholdAt(scorer_.bounds().rays, levels.rays)),
          below(errors.points, thresholdAt(scorer_.bounds().points, levels.points))};
}

// One rig camera's rays do not fix the scale: without those of the camera with most inliers, the rest must still be more than
// chance, with one parameter left to fit. At a distance at which the map is as small as the place where points' image points crowd, most of
// these agree whether they are right or wrong.
bool Significance::hasFixedScale(const QueryPose& pose, const InlierCounts& inliers) const {
  const std::vector<int>& perCamera = inliers.raysPerCamera;
  const auto mostRays = std::max_element(perCamera.begin(), perCamera.end());
  if (mostRays == perCamera.end() || *mostRays < parameters_ - 1) return true;
  const Support rest = evidence_.supportWithoutCamera(scorer_.inliers(pose), static_cast<int>(mostRays - perCamera.begin()));
  const auto isMoreThanChance = [&](double rayShare, double pointShare) {
    return logAlarms(ChanceModel::logProbability(rest, rayShare, pointShare, 1)) < kLogFalseAlarms;
  };
  constexpr double kLargestShare = 0.5;  // no need to ask then
  if (isMoreThanChance(kLargestShare, kLargestShare)) return true;
  const OtherPairs pairs = OtherPairs::random(scorer_.arrays(), features_, seed_, kFewPairs, OtherPairs::PartnersOf::OwnKind);
  const Shares ofPairs = pairs.shares(toPlain(pose), scorer_.thresholds().rays, scorer_.thresholds().points);
  const PerKind<double> scale = scorer_.scale();
  return isMoreThanChance(std::max(chance_.rayShare(scale.rays), ofPairs.rays[0]),
                          std::max(chance_.pointShare(scale.points), ofPairs.points[0]));
}

sac::FailureReason Significance::verdict(const QueryPose& pose, const Evaluation& evaluation, const InlierCounts& inliers,
                                         bool isDetermined) {
  const bool hasPoints = chance_.pointsAreMoreThanChance(evaluation.points, sampler_.numberPoints(), evaluation.scale.points);
  if (!isLessLikelyThan(hasPoints ? kLogFalseAlarms : kLogFalseAlarmsOfRays, pose)) return sac::FailureReason::InliersMayBeChance;
  if (!isDetermined || !hasFixedScale(pose, inliers)) return sac::FailureReason::UndeterminedPose;
  return sac::FailureReason::None;
}

}  // namespace robust
}  // namespace hybridgv

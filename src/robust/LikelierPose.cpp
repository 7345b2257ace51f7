#include "robust/LikelierPose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "robust/Overlap.hpp"

namespace hybridgv {
namespace robust {
namespace {

bool areDistinct(const FinalPose& pose, const QueryPose& other, Intrinsics estimated) {
  constexpr double kSame = 4;  // standard deviations
  if (!pose.isRegular) return true;
  const ParameterVector change = changeOf(pose.pose, other, estimated);
  return change.dot(pose.covariance.ldlt().solve(change)) > kSame * kSame;
}

double turnBetween(const QueryPose& a, const QueryPose& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.rotation.transpose() * b.rotation)).angle();
}

// To the optima, those that the starts lead to, if they are new and turned against all by at least so much.
void addOptimaFrom(const std::vector<QueryPose>& starts, double leastTurn, const LocalOptimizer& optimizer, Intrinsics estimated,
                   std::vector<FinalPose>& optima) {
  const auto isNew = [&](const QueryPose& pose) {
    return std::all_of(optima.begin(), optima.end(), [&](const FinalPose& optimum) {
      return areDistinct(optimum, pose, estimated) && turnBetween(optimum.pose, pose) >= leastTurn;
    });
  };
  for (const QueryPose& start : starts) {
    const QueryPose refined = optimizer.refine(start);
    if (!isNew(refined)) continue;
    const FinalPose optimum = optimizer.finish(optimizer.polish(refined));
    if (isNew(optimum.pose)) optima.push_back(optimum);
  }
}

const FinalPose& likeliestOf(const std::vector<FinalPose>& optima, const LocalOptimizer& optimizer) {
  const FinalPose* best = &optima[0];
  for (const FinalPose& optimum : optima)
    if (&optimum != best && optimum.isRegular && optimizer.likelihoodRatio(optimum, *best).log > 0) best = &optimum;
  return *best;
}

// It agrees with most of the same correspondences.
bool looksTheSame(const FinalPose& best, const FinalPose& other, const PoseScorer& scorer) {
  constexpr double kMostMissing = 0.5;  // of the inliers
  const Overlap inliers = overlap(scorer.inliers(best.pose), scorer.inliers(other.pose));
  return inliers.onlyFirst < kMostMissing * (inliers.onlyFirst + inliers.both);
}

}  // namespace

LikelierPose likelierPose(const FinalPose& pose, const LookAlikes& others, const LocalOptimizer& optimizer,
                          const PoseScorer& scorer, Intrinsics estimated) {
  constexpr double kClear = 6, kClearDeviations = 1.5;  // log-likelihood, and that by what it scatters
  // Nearer ones [rad] lie in the same valley of the likelihood, which is as long as the turn about a line is uncertain.
  constexpr double kLeastTurn = 0.35;
  if (!pose.isRegular) return {pose, std::nullopt};
  std::vector<FinalPose> optima{pose};
  addOptimaFrom(others.mirrored, 0, optimizer, estimated, optima);
  addOptimaFrom(others.turned, kLeastTurn, optimizer, estimated, optima);
  const FinalPose& best = likeliestOf(optima, optimizer);
  LikelierPose result{best, std::nullopt};
  double least = std::numeric_limits<double>::infinity();
  for (const FinalPose& optimum : optima) {
    if (&optimum == &best) continue;
    const LikelihoodRatio ratio = optimizer.likelihoodRatio(best, optimum);
    const double loss = std::abs(ratio.log), clear = std::max(kClear, kClearDeviations * ratio.deviation);
    if (!(loss < std::min(least, clear)) || !looksTheSame(best, optimum, scorer)) continue;
    result.nearlyAsLikely = optimum.pose;
    least = loss;
  }
  return result;
}

}  // namespace robust
}  // namespace hybridgv

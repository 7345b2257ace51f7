// LocalOptimizer's optimization to full precision, in which single rays are kept from deciding alone.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "robust/DepthPrior.hpp"
#include "robust/Leverage.hpp"
#include "robust/LocalOptimizer.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::PaddedValues;

// In the final optimization, the odds that a ray is an inlier count so many times. Those that follow from the data are 2 to 4 times too
// small, because the share of wrong rays is a bound (ChanceModel). And real rays, which share the errors of their camera's pose, are
// beyond three standard deviations 6 times in 100 on two of three models; without them the points' errors move the pose. Found on real
// models; where errors are normal and there are as many points, it makes no difference.
constexpr double kBenefitOfDoubt = 10;

}  // namespace

Optimum LocalOptimizer::polish(const QueryPose& start) const {
  const Kinds kinds = moreThanChance(start);
  const QueryPose likely = estimated_.focalLength ? likeliest(start, kinds, 1, kCoarse) : start;
  const Optimum optimum = withoutLevers(likely, kinds, LeverTest::WithDepths);
  return withBalancedRays(optimum.treatment.refused().empty() ? optimum : likeliestBeside(optimum, likely));
}

// Where the depths of rays are hardly known, they bring more noise than they tell, and count less beside points.
Optimum LocalOptimizer::withBalancedRays(Optimum optimum) const {
  if (!optimum.kinds.points) return optimum;
  const PaddedValues narrowing = optimum.treatment.narrowing();
  const LeastSquaresProblem inliers = narrowed(inliersOf(optimum), narrowing);
  const std::optional<RaySlope> rays = raySlope(inliers, scorer_.arrays(), optimum.pose, rayNoise(optimum));
  optimum.depthsAreKnown = !rays;
  if (!rays) return optimum;
  const double weight = bestWeight(information(withoutRays(inliers), optimum.pose), *rays, estimated_);
  return weight < 1 ? withoutLevers(optimum.pose, optimum.kinds, LeverTest::WithDepths, weight) : optimum;
}

// Where rays had to be refused, the likelihood has optima near each other, one for each part of such rays that is believed. So it is
// optimized from where the points alone lead, and from where the rays count less, too; and, because several rays at depths that are
// each implausible can be right if they agree, from the first start without a look at the depths.
Optimum LocalOptimizer::likeliestBeside(const Optimum& first, const QueryPose& firstStart) const {
  const Kinds& kinds = first.kinds;
  Optimum best = first;
  double evidence = logEvidenceOf(first);
  const auto consider = [&](const QueryPose& start, LeverTest test) {
    const Optimum other = withoutLevers(start, kinds, test);
    const double ofOther = logEvidenceOf(other);
    if (!(ofOther > evidence)) return;
    best = other;
    evidence = ofOther;
  };
  consider(withFaintRays(first.pose, kinds), LeverTest::WithDepths);
  if (kinds.points) consider(likeliest(first.pose, {false, true}, 2, kCoarse), LeverTest::WithDepths);
  consider(firstStart, LeverTest::WithoutDepths);
  return best;
}

QueryPose LocalOptimizer::withFaintRays(const QueryPose& start, const Kinds& kinds) const {
  constexpr double kLarger = 4;  // deviation
  const Noise at = noise(squaredErrors(start, kinds, Reach::BeyondInfinity));
  LeastSquaresProblem faint = mixtureProblem(at, kinds, 1 / (kLarger * kLarger));
  faint.rayLoss.scale *= kLarger;
  return minimize(faint, start, limits(kCoarse)).pose;
}

// The losses of the rays are narrowed, and some are refused; only the last round goes to full precision.
Optimum LocalOptimizer::withoutLevers(const QueryPose& start, const Kinds& kinds, LeverTest test, double rayWeight) const {
  // A focal length that is not free gives the levers less to move. With unknown distortion this is done twice, with and without it.
  int rounds = !estimated_.focalLength ? 1 : lens_.isUnknown ? 2 : 3;
  RayTreatment treatment(scorer_.arrays().rays().size());
  QueryPose pose = start;
  for (int round = 0; round < rounds; ++round) {
    const Steps& steps = round + 1 < rounds ? kCoarse : kPrecise;
    SquaredErrors errors = squaredErrors(pose, kinds, Reach::BeyondInfinity);
    treatment.leaveOut(errors.rays);
    const Noise at = noise(errors, kBenefitOfDoubt);
    const LeastSquaresProblem robust = mixtureProblem(at, kinds, rayWeight);
    Levers levers = leversOf(robust, pose, treatment);
    if (refuse(levers.rays, {robust, at, steps, test, rayWeight}, pose, treatment)) {
      const PaddedValues before = treatment.narrowing();
      levers.leverages = rayLeverages(narrowed(robust, before), pose);
      rounds = std::max(rounds, 2);
    }
    treatment.setNarrowing(narrowingByLeverage(std::move(levers.leverages)));
    const PaddedValues narrowing = treatment.narrowing();
    pose = minimize(narrowed(robust, narrowing), pose, limits(steps)).pose;
  }
  return optimumAt(pose, kinds, treatment, rayWeight);
}

// A lever must be predicted by the other correspondences. By the pose without it, its error has a variance v, in units of the noise's;
// the odds that it is an inlier are then those of an error 1 / sqrt(v) as large, in a range that is sqrt(v) times as wide. A ray that
// is predicted to +- 30 standard deviations agrees by chance 30 times more easily than one predicted to +- 1. And a lever is mostly one
// because it is said to meet its viewing ray close to the cameras, where the scene as a rule is not.
bool LocalOptimizer::refuse(const std::vector<std::size_t>& levers, const Round& round, QueryPose& pose,
                            RayTreatment& treatment) const {
  const auto& [robust, noise, steps, test, rayWeight] = round;
  if (levers.empty()) return false;
  RayTreatment without = treatment;
  without.refuse(levers);
  const PaddedValues narrowing = without.narrowing();
  const QueryPose others = minimize(narrowed(robust, narrowing), pose, limits(steps)).pose;
  ParameterMatrix covariance;
  if (!invertInformation(information(narrowed(likelierInliers(noise, robust.kinds, rayWeight), narrowing), others), covariance))
    return false;

  LeastSquaresProblem inUnitsOfNoise = robust;
  inUnitsOfNoise.rayLoss = {Loss::Quadratic, 1, 1 / (noise.rays.deviation * noise.rays.deviation)};
  const std::vector<double> predicted = predictedVariances(inUnitsOfNoise, others, covariance);
  SquaredErrors errors = squaredErrors(others, robust.kinds, Reach::BeyondInfinity);
  const std::vector<double> ofRays = errors.rays;
  without.leaveOut(errors.rays);
  const DepthPrior depths(scorer_.arrays(), others, errors, noise);
  std::vector<std::size_t> refused;
  for (const std::size_t i : levers) {
    const double v = 1 + predicted[i], plausibility = test == LeverTest::WithDepths ? depths.plausibility(i) : 1;
    if (!(plausibility * noise.rays.oddsAt(ofRays[i] / v) / std::sqrt(v) > 1)) refused.push_back(i);
  }
  if (refused.empty()) return false;
  treatment.refuse(refused);
  pose = others;
  return true;
}

// Without the levers. If they are right, the pose changes by about as much as the others leave open; if they hold it at a wrong place,
// by much more than the covariance says. So the change counts as one more error of the pose.
void LocalOptimizer::leaveOutLevers(const LeastSquaresProblem& inliers, RayTreatment treatment,
                                    const ParameterMatrix& information, FinalPose& result) const {
  const Levers levers = leversOf(inliers, result.pose, treatment, information);
  ParameterMatrix covariance;
  const bool isRegular = invertInformation(levers.others, covariance);
  result.deviationWithoutLevers =
      isRegular ? std::sqrt(varianceOfLogFocalLength(covariance, estimated_)) : std::numeric_limits<double>::infinity();
  if (levers.rays.empty() || !isRegular || !result.isRegular) return;
  treatment.refuse(levers.rays);
  const PaddedValues narrowing = treatment.narrowing();
  const LeastSquaresProblem others = narrowed(inliers, narrowing);
  const ParameterVector change = changeOf(result.pose, minimize(others, result.pose, limits(kCoarse)).pose, estimated_);
  result.covariance += change * change.transpose();
}

// Where the depth of a ray is counted, its odds to be an inlier are g times as large.
double LocalOptimizer::logLikelihoodOfDepths(const QueryPose& pose, const SquaredErrors& errors) const {
  const Noise at = noise(errors);
  const DepthPrior depths(scorer_.arrays(), pose, errors, at);
  double result = 0;
  for (std::size_t i = 0; i < errors.rays.size(); ++i) {
    const double odds = at.rays.oddsAt(errors.rays[i]);
    if (odds > 0) result += std::log((1 + depths.plausibility(i) * odds) / (1 + odds));
  }
  return result;
}

// The likelihood, with the depths of the rays, times the extent of the parameters that the inliers leave open: the integral over the
// parameters, but for a factor. Refused rays are outliers.
double LocalOptimizer::logEvidenceOf(const Optimum& optimum) const {
  const PaddedValues narrowing = optimum.treatment.narrowing();
  const LeastSquaresProblem inliers = narrowed(inliersOf(optimum), narrowing);
  const Eigen::LLT<FullParameterMatrix> cholesky(extendedByIdentity(information(inliers, optimum.pose)));
  if (cholesky.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const double halfLogDeterminant = FullParameterMatrix(cholesky.matrixL()).diagonal().array().log().sum();
  SquaredErrors errors = squaredErrors(optimum.pose, kBothKinds, Reach::BeyondInfinity);
  optimum.treatment.leaveOut(errors.rays);
  return logLikelihood(optimum.pose, errors) + logLikelihoodOfDepths(optimum.pose, errors) - halfLogDeterminant;
}

}  // namespace robust
}  // namespace hybridgv

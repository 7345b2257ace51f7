#include "robust/LocalOptimizer.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "correspondences/PaddedValues.hpp"
#include "robust/ApparentDepth.hpp"
#include "robust/medians.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::PaddedValues;

// Errors of exact data are rounding: a deviation below this share of the largest threshold is not measured.
constexpr double kLeastDeviation = 1e-6;
// A few errors do not tell their deviation. With less than this number, part of its square is that of what is expected: that of
// the other kind, twice as much for points as for rays; or the working threshold's, if there are few of both.
constexpr double kEnough = 60, kPointsPerRays = 2;
// The same at the final pose, where the number of parameters that were fitted is known.
constexpr double kEnoughAtEnd = 20;
constexpr double kDeviationsInThreshold = 2.5;
// The thresholds from which noise and share of the inliers are measured, in standard deviations: real errors have tails.
constexpr double kDeviationsOfAll = 7;
// Loss of the log of the likelihood: 2.8 standard deviations.
constexpr double kClearLoss = 4;
// A standard deviation of log f for which a pose at another distance is out of reach.
constexpr double kSureDeviation = 0.05;
// The errors of truncated least squares count as if their deviation were the truncation, which is several times too much. The prior of
// the distortion must count less in the same way.
constexpr double kPriorOfTruncated = 0.05;
// Ratios of deviations, see allowForHiddenErrors. The second one was found on real models.
constexpr double kClearlyLarger = 2.5, kHiddenShare = 1.5;

// The variance of one kind's errors, of which `count` are known.
struct Measured {
  double variance = 0;
  std::size_t count = 0;
  double threshold = 0, bound = 0;

  double known() const { return std::min(static_cast<double>(count) / kEnough, 1.0); }
};

// `ratio`: of the deviation to the other kind's, where nothing is known.
double deviation(const Measured& kind, const Measured& other, double ratio) {
  const double ofThreshold = kind.threshold / kDeviationsInThreshold;
  const double ofOther = std::min(ratio * std::sqrt(other.variance), kind.bound / kDeviationsInThreshold);
  const double expected = other.known() * ofOther + (1 - other.known()) * ofThreshold;
  const double variance = kind.known() * kind.variance + (1 - kind.known()) * expected * expected;
  return std::max(std::sqrt(variance), kLeastDeviation * kind.bound);
}

Measured measured(const std::vector<double>& squaredErrors, double threshold, double bound, double medianOfSquares) {
  constexpr double kWide = kDeviationsOfAll / kDeviationsInThreshold;
  std::vector<double> inliers = below(squaredErrors, std::min(kWide * threshold, bound));
  return {median(inliers) / medianOfSquares, inliers.size(), threshold, bound};
}

// Squared errors of inliers.
struct InlierSum {
  std::size_t count = 0;
  double sum = 0;
};

// In four sums, because one addition waits for the other.
InlierSum sumBelow(const std::vector<double>& squaredErrors, double threshold) {
  const double squared = threshold * threshold;
  const double* const errors = squaredErrors.data();
  const auto term = [=](std::size_t i) { return errors[i] < squared ? errors[i] : 0; };
  double sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= squaredErrors.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) sums[k] += term(i + k);
  for (; i < squaredErrors.size(); ++i) sums[0] += term(i);
  return {countBelow(squaredErrors, threshold), sums[0] + sums[1] + sums[2] + sums[3]};
}

// Standard deviations of the inliers' errors at a fitted pose, which has taken up as many equations as it has parameters: their mean
// square is too small by that. A kind of which there are few is measured together with the other one.
PerKind<double> fittedDeviations(const PerKind<InlierSum>& inliers, int parameters) {
  const PerKind<double> equations{static_cast<double>(inliers.rays.count), 2 * static_cast<double>(inliers.points.count)};
  const double all = equations.rays + equations.points, excess = all / std::max(all - parameters, 1.0);
  const PerKind<double> sums{inliers.rays.sum, inliers.points.sum};
  const double common = all > 0 ? (sums.rays + sums.points) / all : 0;
  const auto deviation = [&](double sumOfKind, double ofKind) {
    const double known = std::min(ofKind / kEnoughAtEnd, 1.0), own = ofKind > 0 ? sumOfKind / ofKind : 0;
    return std::sqrt(excess * (known * own + (1 - known) * common));
  };
  return {deviation(sums.rays, equations.rays), deviation(sums.points, equations.points)};
}

// Of logs of the likelihood, error by error, of one pose over another.
struct Gains {
  std::size_t count = 0;
  double sum = 0, squares = 0;

  // Of the sum, whatever its mean is.
  double variance() const { return count > 0 ? std::max(squares - sum * sum / static_cast<double>(count), 0.) : 0; }
};

Gains gains(const ErrorMixture& kind, const std::vector<double>& squaredErrors, const std::vector<double>& ofOther,
            double weight) {
  Gains result{squaredErrors.size()};
  for (std::size_t i = 0; i < squaredErrors.size(); ++i) {
    const double gain = weight * std::log((1 + kind.oddsAt(squaredErrors[i])) / (1 + kind.oddsAt(ofOther[i])));
    result.sum += gain;
    result.squares += gain * gain;
  }
  return result;
}

KindLoss truncatedLoss(double truncation) { return {Loss::Truncated, truncation, 1 / (truncation * truncation)}; }

// Of those that are more likely inliers.
KindLoss likelierInlier(const ErrorMixture& kind) {
  return {Loss::Truncated, kind.boundary, 1 / (kind.deviation * kind.deviation)};
}

// Of rays at the end.
KindLoss beyondInfinity(KindLoss loss, double weight) {
  loss.precision *= weight;
  loss.reachesBeyondInfinity = true;
  return loss;
}

// What is common to many correspondences (errors of the poses and focal lengths of the rig) shows in their errors only in part,
// least in those of rays, which give way across one line. So neither kind counts as better than the other, and rays as somewhat
// worse, unless one is clearly the noisier.
void allowForHiddenErrors(double& ray, double& point) {
  const double larger = std::max(ray, point);
  if (larger > kClearlyLarger * std::min(ray, point)) return;
  ray = kHiddenShare * larger;
  point = larger;
}

}  // namespace

LocalOptimizer::LocalOptimizer(const PoseScorer& scorer, const ChanceModel& chance, const QueryFeatures& features,
                               double minFocalLength, double maxFocalLength, Intrinsics estimated, Lens lens,
                               FocalLengthPrior focalLengthPrior)
    : scorer_(scorer),
      chance_(chance),
      features_(features),
      groups_(jackknifeGroups(scorer.arrays(), features)),
      minFocalLength_(minFocalLength),
      maxFocalLength_(maxFocalLength),
      estimated_(estimated),
      lens_(std::move(lens)),
      focalLengthPrior_(focalLengthPrior) {}

void LocalOptimizer::setWorkers(WorkerPool& workers) {
  constexpr std::size_t kMany = 1000;
  const CorrespondenceArrays& arrays = scorer_.arrays();
  workers_ = workers.size() > 1 && arrays.rays().size() + arrays.points().size() > kMany ? &workers : nullptr;
}

QueryPose LocalOptimizer::refine(const QueryPose& start) const {
  struct Stage {
    double rays, points;  // in thresholds
    Steps steps;
  };
  constexpr Stage stages[] = {{16, 2, {2, 1e-2}}, {8, 2, {2, 1e-2}}, {4, 1.5, {2, 1e-2}}, {2, 1, {2, 1e-2}}};
  const double ray = scorer_.thresholds().rays, point = scorer_.thresholds().points;
  QueryPose pose = start;
  // The solution of a sample at the true focal length is near enough for the narrower ones.
  const Stage* const first = estimated_.focalLength ? std::begin(stages) : std::begin(stages) + 2;
  std::for_each(first, std::end(stages), [&](const Stage& stage) {
    pose = leastTruncated(stage.rays * ray, stage.points * point, pose, kBothKinds, stage.steps);
  });
  pose = leastTruncated(ray, point, pose, moreThanChance(pose), kCoarse);
  return settle(pose, moreThanChance(pose));
}

QueryPose LocalOptimizer::settle(const QueryPose& start, const Kinds& kinds) const { return likeliest(start, kinds, 2, kCoarse); }

QueryPose LocalOptimizer::likeliest(const QueryPose& start, const Kinds& kinds, int rounds, const Steps& steps) const {
  QueryPose pose = start;
  for (int round = 0; round < rounds; ++round) {
    const Noise at = noise(squaredErrors(pose, kinds, Reach::Infinity));
    pose = minimize(problem(at.rays.loss(), at.points.loss(), kinds), pose, limits(steps)).pose;
  }
  return pose;
}

LeastSquaresProblem LocalOptimizer::mixtureProblem(const Noise& noise, const Kinds& kinds, double rayWeight) const {
  return problem(beyondInfinity(noise.rays.loss(), rayWeight), noise.points.loss(), kinds);
}

bool LocalOptimizer::focalLengthIsSure(const QueryPose& pose) const {
  if (!estimated_.focalLength) return true;
  const Kinds kinds = moreThanChance(pose);
  const Noise at = noise(squaredErrors(pose, kinds, Reach::Infinity));
  ParameterMatrix covariance;
  return invertInformation(information(likelierInliers(at, kinds, 1), pose), covariance) &&
         varianceOfLogFocalLength(covariance, estimated_) < kSureDeviation * kSureDeviation;
}

bool LocalOptimizer::focalLengthIsDetermined(const FinalPose& final) const {
  const Kinds kinds = moreThanChance(final.pose);
  LeastSquaresProblem atFixedFocalLength = mixtureProblem(final.noise, kinds, final.rayWeight);
  atFixedFocalLength.estimated.focalLength = false;
  const double best = logLikelihood(final.pose, kinds, final);
  const auto fallsAt = [&](double factor) {
    const QueryPose start = atDistance(final.pose, factor);
    return best - logLikelihood(minimize(atFixedFocalLength, start, limits({20, 1e-4})).pose, kinds, final) >= kClearLoss;
  };
  return fallsAt(0.5) && fallsAt(2);
}

double LocalOptimizer::logLikelihood(const QueryPose& pose, const Kinds& kinds, const Optimum& noiseOf) const {
  const SquaredErrors errors = squaredErrors(pose, kinds, Reach::BeyondInfinity);
  return noiseOf.rayWeight * noiseOf.noise.rays.logLikelihood(errors.rays) + noiseOf.noise.points.logLikelihood(errors.points) -
         priorCost(pose) / 2;
}

LikelihoodRatio LocalOptimizer::likelihoodRatio(const Optimum& a, const Optimum& b) const {
  const SquaredErrors ofA = squaredErrors(a.pose, kBothKinds, Reach::BeyondInfinity);
  const SquaredErrors ofB = squaredErrors(b.pose, kBothKinds, Reach::BeyondInfinity);
  const double ofPrior = (priorCost(b.pose) - priorCost(a.pose)) / 2;
  const auto byNoiseOf = [&](const Optimum& optimum) {
    const Gains rays = gains(optimum.noise.rays, ofA.rays, ofB.rays, optimum.rayWeight);
    const Gains points = gains(optimum.noise.points, ofA.points, ofB.points, 1);
    return LikelihoodRatio{rays.sum + points.sum + ofPrior, std::sqrt(rays.variance())};
  };
  const LikelihoodRatio byA = byNoiseOf(a), byB = byNoiseOf(b);
  if (!(byA.log * byB.log > 0)) return {0, std::max(byA.deviation, byB.deviation)};
  return std::abs(byA.log) < std::abs(byB.log) ? byA : byB;
}

// Of the inlier points; without them, of where the inlier rays seem to meet the query's viewing rays.
double LocalOptimizer::depthOfScene(const QueryPose& pose) const {
  const CorrespondenceArrays& arrays = scorer_.arrays();
  const Eigen::Vector3d axis = pose.rotation.col(2);
  const InlierMasks inliers = scorer_.inliers(pose);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < inliers.points.size(); ++i) {
    if (!inliers.points[i]) continue;
    sum += axis.dot(arrays.points()[i].point - pose.position);
    ++count;
  }
  if (count > 0) return sum / count;
  std::vector<double> depths;
  for (std::size_t i = 0; i < inliers.rays.size(); ++i) {
    if (!inliers.rays[i]) continue;
    if (const std::optional<ApparentPlace> place = apparentPlace(arrays.rays()[i], pose))
      depths.push_back(axis.dot(place->position - pose.position));
  }
  return depths.empty() ? -axis.dot(pose.position) : median(depths);
}

QueryPose LocalOptimizer::atDistance(const QueryPose& pose, double factor) const {
  QueryPose result = pose;
  result.position -= (factor - 1) * depthOfScene(pose) * pose.rotation.col(2);
  result.focalLength = std::clamp(factor * pose.focalLength, minFocalLength_, maxFocalLength_);
  return result;
}

QueryPose LocalOptimizer::leastTruncated(double rayLimit, double pointLimit, const QueryPose& start, const Kinds& kinds,
                                         const Steps& steps) const {
  LeastSquaresProblem truncated = problem(truncatedLoss(rayLimit), truncatedLoss(pointLimit), kinds);
  truncated.distortionPrior.factor = kPriorOfTruncated;
  truncated.focalLengthPrior.factor = kPriorOfTruncated;
  return minimize(truncated, start, limits(steps)).pose;
}

LeastSquaresOptions LocalOptimizer::limits(const Steps& steps) const {
  LeastSquaresOptions options;
  options.maxIterations = steps.iterations;
  options.minRelativeDecrease = steps.minDecrease;
  options.minFocalLength = minFocalLength_;
  options.maxFocalLength = maxFocalLength_;
  options.minDistortion = lens_.least;
  options.maxDistortion = lens_.largest;
  return options;
}

LeastSquaresProblem LocalOptimizer::problem(const KindLoss& rayLoss, const KindLoss& pointLoss, const Kinds& kinds) const {
  LeastSquaresProblem result = makeProblem(scorer_.arrays(), pointLoss, rayLoss, estimated_);
  result.kinds = kinds;
  result.distortionPrior = lens_.prior;
  result.focalLengthPrior = focalLengthPrior_;
  result.workers = workers_;
  return result;
}

Kinds LocalOptimizer::moreThanChance(const QueryPose& pose) const {
  const Evaluation evaluation = scorer_.evaluate(pose);
  const auto size = [](const auto& list) { return static_cast<int>(list.size()); };
  const PerKind<double> scale = scorer_.scale();
  const Kinds kinds{chance_.raysAreMoreThanChance(evaluation.rays, size(scorer_.arrays().rays()), scale.rays),
                    chance_.pointsAreMoreThanChance(evaluation.points, size(scorer_.arrays().points()), scale.points)};
  return kinds.rays || kinds.points ? kinds : kBothKinds;
}

SquaredErrors LocalOptimizer::squaredErrors(const QueryPose& pose, const Kinds& kinds, Reach reach) const {
  SquaredErrors result;
  const auto ofRays = [&] {
    if (kinds.rays)
      result.rays = reach == Reach::Infinity ? scorer_.squaredRayErrors(pose) : scorer_.squaredRayErrorsBeyondInfinity(pose);
  };
  both(workers_, ofRays, [&] {
    if (kinds.points) result.points = scorer_.squaredPointErrors(pose);
  });
  return result;
}

Noise LocalOptimizer::noise(const SquaredErrors& errors, double benefitOfDoubt) const {
  const PerKind<double>& threshold = scorer_.thresholds();
  const PerKind<double>& bound = scorer_.bounds();
  Measured rays, points;
  both(
      workers_, [&] { rays = measured(errors.rays, threshold.rays, bound.rays, kMedianOfOneSquare); },
      [&] { points = measured(errors.points, threshold.points, bound.points, kMedianOfTwoSquares); });
  // As far as there are points to hold the pose: without them a wrong ray that is believed does more harm than a right one that is not.
  const double held = std::min(static_cast<double>(points.count) / std::max(static_cast<double>(rays.count), 1.), 1.);
  return mixtures({deviation(rays, points, 1 / kPointsPerRays), deviation(points, rays, kPointsPerRays)}, errors,
                  std::pow(benefitOfDoubt, held));
}

Noise LocalOptimizer::mixtures(PerKind<double> deviations, const SquaredErrors& errors, double benefitOfDoubt) const {
  if (!errors.rays.empty() && !errors.points.empty()) allowForHiddenErrors(deviations.rays, deviations.points);
  const PerKind<double>& bound = scorer_.bounds();
  const double ray = std::min(kDeviationsOfAll * deviations.rays, bound.rays);
  const double point = std::min(kDeviationsOfAll * deviations.points, bound.points);
  const CorrespondenceArrays& arrays = scorer_.arrays();
  return {rayMixture(deviations.rays, {countBelow(errors.rays, ray), arrays.rays().size(), ray, bound.rays,
                                       chance_.rayShare(ray / bound.rays) / benefitOfDoubt}),
          pointMixture(deviations.points, {countBelow(errors.points, point), arrays.points().size(), point, bound.points,
                                           chance_.pointShare(point / bound.points)})};
}

// The deviations follow from all errors that are more likely an inlier's, not from the median error; which these are depends on the
// deviations.
Noise LocalOptimizer::finalNoise(const SquaredErrors& errors) const {
  constexpr int kRounds = 3;
  Noise result = noise(errors);
  for (int round = 0; round < kRounds; ++round) {
    const PerKind<InlierSum> likelier{sumBelow(errors.rays, result.rays.boundary),
                                      sumBelow(errors.points, result.points.boundary)};
    PerKind<double> deviations = fittedDeviations(likelier, estimated_.parameters());
    deviations.rays = std::max(deviations.rays, kLeastDeviation * scorer_.bounds().rays);
    deviations.points = std::max(deviations.points, kLeastDeviation * scorer_.bounds().points);
    result = mixtures(deviations, errors);
    result.rays.deviation = deviations.rays;
    result.points.deviation = deviations.points;
  }
  return result;
}

LeastSquaresProblem LocalOptimizer::narrowed(LeastSquaresProblem problem, const PaddedValues& narrowing) {
  problem.rays.narrowing = narrowing.pointer();
  return problem;
}

LeastSquaresProblem LocalOptimizer::likelierInliers(const Noise& noise, const Kinds& kinds, double rayWeight) const {
  return problem(beyondInfinity(likelierInlier(noise.rays), rayWeight), likelierInlier(noise.points), kinds);
}

LeastSquaresProblem LocalOptimizer::inliersOf(const Optimum& optimum) const {
  return likelierInliers(optimum.noise, optimum.kinds, optimum.rayWeight);
}

double LocalOptimizer::logLikelihood(const QueryPose& pose) const {
  return logLikelihood(pose, squaredErrors(pose, kBothKinds, Reach::Infinity));
}

double LocalOptimizer::logLikelihood(const QueryPose& pose, const SquaredErrors& errors) const {
  const Noise at = noise(errors);
  return at.rays.logLikelihood(errors.rays) + at.points.logLikelihood(errors.points) - priorCost(pose) / 2;
}

double LocalOptimizer::priorCost(const QueryPose& pose) const {
  return lens_.prior.cost(pose.distortion) + focalLengthPrior_.cost(pose.focalLength);
}

double LocalOptimizer::logEvidenceForDistortion(const Optimum& optimum) const {
  const PaddedValues narrowing = optimum.treatment.narrowing();
  const LeastSquaresProblem inliers = narrowed(inliersOf(optimum), narrowing);
  ParameterMatrix covariance;
  if (!invertInformation(information(inliers, optimum.pose), covariance)) return -std::numeric_limits<double>::infinity();
  return logEvidence(optimum.pose.distortion, std::sqrt(varianceOfDistortion(covariance)), lens_.prior);
}

Optimum LocalOptimizer::optimumAt(const QueryPose& pose, const Kinds& kinds, const RayTreatment& treatment,
                                  double rayWeight) const {
  SquaredErrors errors = squaredErrors(pose, kBothKinds, Reach::BeyondInfinity);
  treatment.leaveOut(errors.rays);
  return {pose, kinds, treatment, finalNoise(errors), rayWeight};
}

Optimum LocalOptimizer::keep(const QueryPose& pose) const { return keep(pose, 1); }

Optimum LocalOptimizer::keep(const QueryPose& pose, double rayWeight) const {
  return optimumAt(pose, moreThanChance(pose), RayTreatment(scorer_.arrays().rays().size()), rayWeight);
}

Optimum LocalOptimizer::polishNear(const QueryPose& start, double rayWeight) const {
  const Kinds kinds = moreThanChance(start);
  const Noise at = noise(squaredErrors(start, kinds, Reach::BeyondInfinity));
  return keep(minimize(mixtureProblem(at, kinds, rayWeight), start, limits({4, 1e-8})).pose, rayWeight);
}

FinalPose LocalOptimizer::finish(const Optimum& optimum) const {
  FinalPose result{optimum};
  const PaddedValues narrowing = optimum.treatment.narrowing();
  const LeastSquaresProblem inliers = inliersOf(optimum);
  const Derivatives at = derivatives(narrowed(inliers, narrowing), result.pose);
  findCovariance(narrowed(inliers, narrowing), at, result);
  leaveOutLevers(inliers, optimum.treatment, at.information, result);
  return result;
}

// All image points are shifted by the error of the principal point, and the pose follows: by -C dg for a change dg of the gradient.
void LocalOptimizer::allowForPrincipalPoint(double deviation, FinalPose& result) const {
  if (!result.isRegular || !(deviation > 0)) return;
  const PaddedValues narrowing = result.treatment.narrowing();
  const LeastSquaresProblem inliers = narrowed(inliersOf(result), narrowing);
  ParameterMatrix byNoise;
  result.isRegular = invertInformation(information(inliers, result.pose), byNoise);
  if (!result.isRegular) return;
  const ParameterPair changes = deviation * (byNoise * gradientByImageShift(inliers, result.pose));
  result.covariance += changes * changes.transpose();
  result.isRegular = result.covariance.allFinite();
}

void LocalOptimizer::findCovariance(const LeastSquaresProblem& inliers, const Derivatives& at, FinalPose& result) const {
  std::optional<SharedInformation> shared = sharedInformation(inliers, result.pose, features_, groups_);
  if (shared) correctNoise(at.information, *shared, result);
  result.isRegular = jackknifeCovariance(inliers, result.pose, groups_, at, shared, result.covariance);
  if (!result.isRegular) return;
  result.effectiveParameters = (at.information * result.covariance).trace();
  allowForDepths(inliers, at.information, result);
}

RayNoise LocalOptimizer::rayNoise(const Optimum& optimum) const {
  const ErrorMixture& rays = optimum.noise.rays;
  const double outliers = rays.outlierShare * static_cast<double>(scorer_.arrays().rays().size());
  return {rays.deviation, outliers * chance_.rayShare(rays.boundary / scorer_.bounds().rays)};
}

// The covariance is for derivatives that are known. What it lacks where those of the rays are not is added.
void LocalOptimizer::allowForDepths(const LeastSquaresProblem& inliers, const ParameterMatrix& information,
                                    FinalPose& result) const {
  if (result.depthsAreKnown) return;
  const std::optional<RaySlope> rays = raySlope(inliers, scorer_.arrays(), result.pose, rayNoise(result));
  ParameterMatrix byInformation, bySlope;
  if (!rays || !invertInformation(information, byInformation)) return;
  // The weight is in the problem.
  if (!covarianceBySlope(robust::information(withoutRays(inliers), result.pose), *rays, 1, bySlope)) return;
  const Eigen::LLT<FullParameterMatrix> cholesky(extendedByIdentity(byInformation));
  if (cholesky.info() != Eigen::Success) return;
  const Eigen::Index size = information.rows();
  const FullParameterMatrix larger = enlarged(cholesky.matrixL(), extendedByIdentity(bySlope));
  result.covariance += larger.topLeftCorner(size, size) - byInformation;
  result.isRegular = result.covariance.allFinite();
}

// The noise was found for independent errors, where the inliers' squared errors, n of them, are n less the number of parameters. Of
// errors that are shared the pose takes up more, by tr(C X).
void LocalOptimizer::correctNoise(const ParameterMatrix& information, SharedInformation& shared, FinalPose& result) const {
  ParameterMatrix covariance;
  if (!invertInformation(information, covariance)) return;
  SquaredErrors errors = squaredErrors(result.pose, kBothKinds, Reach::BeyondInfinity);
  result.treatment.leaveOut(errors.rays);
  const double rays = static_cast<double>(countBelow(errors.rays, result.noise.rays.boundary));
  const double points = static_cast<double>(countBelow(errors.points, result.noise.points.boundary));
  const double left = rays + 2 * points - estimated_.parameters();
  const double excess = std::max(left, 1.) / std::max(left - (covariance * shared.all).trace(), 1.);
  if (!std::isfinite(excess)) return;
  result.noise.rays.deviation *= std::sqrt(excess);
  result.noise.points.deviation *= std::sqrt(excess);
  shared.all = excess * shared.all + (excess - 1) * information;
  shared.betweenGroups *= excess;
}

}  // namespace robust
}  // namespace hybridgv

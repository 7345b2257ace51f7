#include "robust/LocalOptimizer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "robust/Leverage.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::PaddedValues;

// Median of the square of one and of the sum of the squares of two standard normal variables.
constexpr double kMedianOne = 0.4549364231195728, kMedianTwo = 1.3862943611198906;
// Errors of exact data are rounding: a deviation below this share of the threshold is not measured.
constexpr double kLeastDeviation = 1e-6;
// A few errors do not tell their deviation. With less than this number, part of its square is that of what is expected: that of
// the other kind, in the ratio of the thresholds; or the threshold over 2.5, if there are few of both.
constexpr double kEnough = 20;
constexpr double kExpectedPerThreshold = 1 / 2.5;
// Ratios of deviations, see allowForHiddenErrors. The second one was found on real models.
constexpr double kClearlyLarger = 2.5, kHiddenShare = 1.5;

std::vector<double> below(const std::vector<double>& squared, double threshold) {
  std::vector<double> result;
  result.reserve(squared.size());
  const auto isInlier = [&](double e) { return e < threshold * threshold; };
  std::copy_if(squared.begin(), squared.end(), std::back_inserter(result), isInlier);
  return result;
}

// Reorders the values.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

// The variance of one kind's errors, of which `count` are known.
struct Measured {
  double variance, threshold;
  std::size_t count;

  double known() const { return std::min(static_cast<double>(count) / kEnough, 1.0); }
  double perThreshold() const { return std::sqrt(variance) / threshold; }
};

double deviation(const Measured& kind, const Measured& other) {
  const double expectedPerThreshold = other.known() * other.perThreshold() + (1 - other.known()) * kExpectedPerThreshold;
  const double expected = kind.threshold * std::min(expectedPerThreshold, kExpectedPerThreshold);
  const double variance = kind.known() * kind.variance + (1 - kind.known()) * expected * expected;
  return std::max(std::sqrt(variance), kLeastDeviation * kind.threshold);
}

KindLoss truncatedLoss(double truncation, double deviation) { return {Loss::Truncated, truncation, 1 / (deviation * deviation)}; }
KindLoss truncatedLoss(double truncation) { return truncatedLoss(truncation, truncation); }

// The narrowing must outlive the problem.
LeastSquaresProblem narrowed(LeastSquaresProblem problem, const PaddedValues& narrowing) {
  problem.rays.narrowing = narrowing.pointer();
  return problem;
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

LocalOptimizer::LocalOptimizer(const PoseScorer& scorer, const ChanceModel& chance, double minFocalLength, double maxFocalLength,
                               Intrinsics estimated)
    : scorer_(scorer), chance_(chance), minFocalLength_(minFocalLength), maxFocalLength_(maxFocalLength), estimated_(estimated) {}

QueryPose LocalOptimizer::refine(const QueryPose& start) const {
  struct Stage {
    double rays, points;  // in thresholds
    Steps steps;
  };
  constexpr Stage stages[] = {{16, 2, {2, 1e-2}}, {8, 2, {2, 1e-2}}, {4, 1.5, {2, 1e-2}}, {2, 1, {2, 1e-2}}};
  const double ray = scorer_.maxEpipolarError(), point = scorer_.maxReprojectionError();
  QueryPose pose = start;
  for (const Stage& stage : stages)
    pose = minimized(truncatedLoss(stage.rays * ray), truncatedLoss(stage.points * point), pose, kBothKinds, stage.steps);
  pose = minimized(truncatedLoss(ray), truncatedLoss(point), pose, moreThanChance(pose), {10, 1e-4});
  return settle(pose, moreThanChance(pose));
}

QueryPose LocalOptimizer::settle(const QueryPose& start, const Kinds& kinds) const {
  return likeliest(start, kinds, 2, {10, 1e-4});
}

QueryPose LocalOptimizer::likeliest(const QueryPose& start, const Kinds& kinds, int rounds, const Steps& steps) const {
  QueryPose pose = start;
  for (int round = 0; round < rounds; ++round) {
    const Noise at = noise(squaredErrors(pose, kinds), pose.focalLength);
    pose = minimized(at.rays.loss(), at.points.loss(), pose, kinds, steps);
  }
  return pose;
}

QueryPose LocalOptimizer::withoutLevers(const QueryPose& start, const Kinds& kinds, int rounds, const Steps& steps,
                                        PaddedValues& narrowing) const {
  QueryPose pose = start;
  narrowing = PaddedValues();
  for (int round = 0; round < rounds; ++round) {
    const Noise at = noise(squaredErrors(pose, kinds), pose.focalLength);
    const LeastSquaresProblem robust = problem(at.rays.loss(), at.points.loss(), kinds);
    narrowing = narrowingByLeverage(narrowed(robust, narrowing), pose);
    pose = minimize(narrowed(robust, narrowing), pose, limits(steps)).pose;
  }
  return pose;
}

QueryPose LocalOptimizer::atDistance(const QueryPose& pose, double factor) const {
  const std::vector<double> squaredErrors = scorer_.squaredPointErrors(pose);
  const double squaredThreshold = scorer_.maxReprojectionError() * scorer_.maxReprojectionError();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < squaredErrors.size(); ++i)
    if (squaredErrors[i] < squaredThreshold) {
      sum += scorer_.arrays().points()[i].point;
      ++count;
    }
  const Eigen::Vector3d middle = sum / std::max(count, 1);
  const Eigen::Vector3d axis = pose.rotation.col(2);
  QueryPose result = pose;
  result.position -= (factor - 1) * axis.dot(middle - pose.position) * axis;
  result.focalLength = std::clamp(factor * pose.focalLength, minFocalLength_, maxFocalLength_);
  return result;
}

QueryPose LocalOptimizer::minimized(const KindLoss& rayLoss, const KindLoss& pointLoss, const QueryPose& start,
                                    const Kinds& kinds, const Steps& steps) const {
  return minimize(problem(rayLoss, pointLoss, kinds), start, limits(steps)).pose;
}

LeastSquaresOptions LocalOptimizer::limits(const Steps& steps) const {
  LeastSquaresOptions options;
  options.maxIterations = steps.iterations;
  options.minRelativeDecrease = steps.minDecrease;
  options.minFocalLength = minFocalLength_;
  options.maxFocalLength = maxFocalLength_;
  return options;
}

LeastSquaresProblem LocalOptimizer::problem(const KindLoss& rayLoss, const KindLoss& pointLoss, const Kinds& kinds) const {
  LeastSquaresProblem result = makeProblem(scorer_.arrays(), pointLoss, rayLoss, estimated_);
  result.kinds = kinds;
  return result;
}

Kinds LocalOptimizer::moreThanChance(const QueryPose& pose) const {
  const Evaluation evaluation = scorer_.evaluate(pose);
  const auto size = [](const auto& list) { return static_cast<int>(list.size()); };
  const Kinds kinds{chance_.raysAreMoreThanChance(evaluation.rays, size(scorer_.arrays().rays()), pose.focalLength),
                    chance_.pointsAreMoreThanChance(evaluation.points, size(scorer_.arrays().points()))};
  return kinds.rays || kinds.points ? kinds : kBothKinds;
}

SquaredErrors LocalOptimizer::squaredErrors(const QueryPose& pose, const Kinds& kinds) const {
  SquaredErrors result;
  if (kinds.rays) result.rays = scorer_.squaredRayErrors(pose);
  if (kinds.points) result.points = scorer_.squaredPointErrors(pose);
  return result;
}

Noise LocalOptimizer::noise(const SquaredErrors& errors, double focalLength) const {
  const double maxRay = scorer_.maxEpipolarError(), maxPoint = scorer_.maxReprojectionError();
  std::vector<double> rays = below(errors.rays, maxRay), points = below(errors.points, maxPoint);
  const Measured measuredRays{median(rays) / kMedianOne, maxRay, rays.size()};
  const Measured measuredPoints{median(points) / kMedianTwo, maxPoint, points.size()};
  double ray = deviation(measuredRays, measuredPoints), point = deviation(measuredPoints, measuredRays);
  if (!rays.empty() && !points.empty()) allowForHiddenErrors(ray, point);
  const CorrespondenceArrays& arrays = scorer_.arrays();
  return {rayMixture(ray, {rays.size(), arrays.rays().size(), maxRay, chance_.rayShare(focalLength)}),
          pointMixture(point, {points.size(), arrays.points().size(), maxPoint, chance_.pointShare()})};
}

double LocalOptimizer::logLikelihood(const QueryPose& pose) const {
  const SquaredErrors errors = squaredErrors(pose, kBothKinds);
  const Noise at = noise(errors, pose.focalLength);
  return at.rays.logLikelihood(errors.rays) + at.points.logLikelihood(errors.points);
}

FinalPose LocalOptimizer::polish(const QueryPose& start, bool optimize) const {
  FinalPose result;
  const Kinds kinds = moreThanChance(start);
  PaddedValues narrowing;
  constexpr Steps kFine{20, 1e-8};
  result.pose = optimize ? withoutLevers(likeliest(start, kinds, 1, kFine), kinds, 3, kFine, narrowing) : start;
  // The uncertainty of the pose follows from all errors that are more likely an inlier's, not from the median error.
  const SquaredErrors errors = squaredErrors(result.pose, kBothKinds);
  result.noise = noise(errors, result.pose.focalLength);
  ErrorMixture &ray = result.noise.rays, &point = result.noise.points;
  const std::vector<double> rays = below(errors.rays, ray.boundary);
  const std::vector<double> points = below(errors.points, point.boundary);
  const Measured measuredRays{mean(rays), scorer_.maxEpipolarError(), rays.size()};
  const Measured measuredPoints{mean(points) / 2, scorer_.maxReprojectionError(), points.size()};
  ray.deviation = deviation(measuredRays, measuredPoints);
  point.deviation = deviation(measuredPoints, measuredRays);
  const LeastSquaresProblem inliers =
      problem(truncatedLoss(ray.boundary, ray.deviation), truncatedLoss(point.boundary, point.deviation), kinds);
  result.information = information(narrowed(inliers, narrowing), result.pose);
  return result;
}

}  // namespace robust
}  // namespace hybridgv

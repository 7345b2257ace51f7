#include "robust/LocalOptimizer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hybridgv {
namespace robust {
namespace {

// Median of the square of one and of the sum of the squares of two standard normal variables.
constexpr double kMedianOne = 0.4549364231195728, kMedianTwo = 1.3862943611198906;
constexpr double kPi = 3.14159265358979323846;
// Errors of exact data are rounding: a deviation below this share of the threshold is not measured.
constexpr double kLeastDeviation = 1e-6;
// A few errors do not tell their deviation. With less than this number, part of its square is that of what is expected: that of
// the other type, in the ratio of the thresholds; or the threshold over 2.5, if there are few of both.
constexpr double kEnough = 20;
constexpr double kExpectedPerThreshold = 1 / 2.5;
// No truncation below this number of standard deviations.
constexpr double kLeastTruncation = 2.5;
constexpr int kPolishRounds = 4;

std::vector<double> below(std::vector<double> squared, double threshold) {
  const auto isOutlier = [&](double e) { return !(e < threshold * threshold); };
  squared.erase(std::remove_if(squared.begin(), squared.end(), isOutlier), squared.end());
  return squared;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

// The variance of one type's errors, of which `count` are known.
struct Measured {
  double variance, threshold;
  std::size_t count;

  double known() const { return std::min(static_cast<double>(count) / kEnough, 1.0); }
  double perThreshold() const { return std::sqrt(variance) / threshold; }
};

double deviation(const Measured& type, const Measured& other) {
  const double expectedPerThreshold = other.known() * other.perThreshold() + (1 - other.known()) * kExpectedPerThreshold;
  const double expected = type.threshold * std::min(expectedPerThreshold, kExpectedPerThreshold);
  const double variance = type.known() * type.variance + (1 - type.known()) * expected * expected;
  return std::max(std::sqrt(variance), kLeastDeviation * type.threshold);
}

// Inliers with standard deviation sigma and outliers of even density are equally likely at the error c sigma,
//
//     c^2 = 2 log(inliers / outliers x density of an inlier's error at 0 / density of outliers).
double truncation(std::size_t inliers, std::size_t all, double densityRatio, double sigma, double threshold) {
  const double outliers = std::max(static_cast<double>(all - inliers), 1.0);
  const double c2 = 2 * std::log(std::max(static_cast<double>(inliers) / outliers * densityRatio, 1.0));
  return std::min(std::max(std::sqrt(c2), kLeastTruncation) * sigma, threshold);
}

}  // namespace

LocalOptimizer::LocalOptimizer(const PoseScorer& scorer, const ChanceModel& chance, double minFocalLength, double maxFocalLength)
    : scorer_(scorer), chance_(chance), minFocalLength_(minFocalLength), maxFocalLength_(maxFocalLength) {}

FocalPose LocalOptimizer::refine(const FocalPose& start, const Types& types) const {
  struct Stage {
    double rays, points;  // in thresholds
    int iterations;
    double minDecrease;
  };
  constexpr Stage stages[] = {{16, 2, 2, 1e-2}, {8, 2, 2, 1e-2}, {4, 1.5, 2, 1e-2}, {2, 1, 2, 1e-2}, {1, 1, 10, 1e-4}};
  FocalPose pose = start;
  for (const Stage& stage : stages) {
    const double rays = stage.rays * scorer_.maxEpipolarError(), points = stage.points * scorer_.maxReprojectionError();
    pose = truncated(pose, {{rays, rays}, {points, points}}, types, stage.iterations, stage.minDecrease);
  }
  return pose;
}

FocalPose LocalOptimizer::atDistance(const FocalPose& pose, double factor) const {
  std::vector<char> rays, points;
  scorer_.inliers(pose, rays, points);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i]) sum += scorer_.arrays().points()[i].point, ++count;
  const Eigen::Vector3d middle = sum / std::max(count, 1);
  const Eigen::Vector3d axis = pose.rotation.col(2);
  FocalPose result = pose;
  result.position -= (factor - 1) * axis.dot(middle - pose.position) * axis;
  result.focalLength = std::clamp(factor * pose.focalLength, minFocalLength_, maxFocalLength_);
  return result;
}

FocalPose LocalOptimizer::truncated(const FocalPose& start, const Noise& noise, const Types& types, int iterations,
                                    double minDecrease) const {
  LeastSquaresOptions options;
  options.maxIterations = iterations;
  options.minRelativeDecrease = minDecrease;
  options.minFocalLength = minFocalLength_, options.maxFocalLength = maxFocalLength_;
  return minimize(problem(noise, types), start, options).pose;
}

LeastSquaresProblem LocalOptimizer::problem(const Noise& noise, const Types& types) const {
  const auto loss = [](const Spread& spread) {
    return TypeLoss{Loss::Truncated, spread.truncation, 1 / (spread.deviation * spread.deviation)};
  };
  LeastSquaresProblem result = makeProblem(scorer_.arrays(), loss(noise.points), loss(noise.rays));
  if (!types.rays) result.rays.size = 0;
  if (!types.points) result.points.size = 0;
  return result;
}

Types LocalOptimizer::moreThanChance(const FocalPose& pose) const {
  const Evaluation evaluation = scorer_.evaluate(pose);
  const auto size = [](const auto& list) { return static_cast<int>(list.size()); };
  const Types types{chance_.raysAreMoreThanChance(evaluation.rays, size(scorer_.arrays().rays()), pose.focalLength),
                    chance_.pointsAreMoreThanChance(evaluation.points, size(scorer_.arrays().points()))};
  return types.rays || types.points ? types : Types{};
}

Noise LocalOptimizer::noise(const FocalPose& pose) const {
  const double maxRay = scorer_.maxEpipolarError(), maxPoint = scorer_.maxReprojectionError();
  const std::vector<double> rays = scorer_.squaredRayErrors(pose), points = scorer_.squaredPointErrors(pose);
  const std::vector<double> inlierRays = below(rays, maxRay), inlierPoints = below(points, maxPoint);
  Noise result;
  const Measured measuredRays{median(inlierRays) / kMedianOne, maxRay, inlierRays.size()};
  const Measured measuredPoints{median(inlierPoints) / kMedianTwo, maxPoint, inlierPoints.size()};
  const double ray = deviation(measuredRays, measuredPoints), point = deviation(measuredPoints, measuredRays);
  // Per pixel on a line, 1 / sqrt(2 pi sigma^2) and share / (2 threshold); per pixel of area, 1 / (2 pi sigma^2) and share / (pi
  // threshold^2).
  const double rayRatio = 2 * maxRay / (std::sqrt(2 * kPi) * ray * chance_.rayShare(pose.focalLength));
  const double pointRatio = maxPoint * maxPoint / (2 * point * point * chance_.pointShare());
  result.rays = {ray, truncation(inlierRays.size(), rays.size(), rayRatio, ray, maxRay)};
  result.points = {point, truncation(inlierPoints.size(), points.size(), pointRatio, point, maxPoint)};
  return result;
}

FinalPose LocalOptimizer::polish(const FocalPose& start, bool optimize) const {
  FinalPose result;
  result.pose = start;
  const Types types = moreThanChance(start);
  for (int round = 0; optimize && round < kPolishRounds; ++round)
    result.pose = truncated(result.pose, noise(result.pose), types, 20, 1e-8);
  // The uncertainty of the pose follows from all that was not truncated, not from the median error.
  result.noise = noise(result.pose);
  const std::vector<double> rays = below(scorer_.squaredRayErrors(result.pose), result.noise.rays.truncation);
  const std::vector<double> points = below(scorer_.squaredPointErrors(result.pose), result.noise.points.truncation);
  const Measured measuredRays{mean(rays), scorer_.maxEpipolarError(), rays.size()};
  const Measured measuredPoints{mean(points) / 2, scorer_.maxReprojectionError(), points.size()};
  result.noise.rays.deviation = deviation(measuredRays, measuredPoints);
  result.noise.points.deviation = deviation(measuredPoints, measuredRays);
  result.information = information(problem(result.noise, types), result.pose);
  return result;
}

}  // namespace robust
}  // namespace hybridgv

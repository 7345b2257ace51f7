#include "robust/LocalOptimizer.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {
namespace {

// Median of the square of one and of the sum of the squares of two standard normal variables.
constexpr double kMedianOne = 0.4549364231195728, kMedianTwo = 1.3862943611198906;
// Errors of exact data are rounding: a scale below this share of the threshold is not measured.
constexpr double kLeastNoise = 1e-6;
// A few errors do not tell their scale: with less than this number, part of its square is that of the threshold / 2.5.
constexpr double kEnough = 20;

// Robust standard deviation of errors, from the median of those squares that are below a threshold's.
double deviation(std::vector<double> squared, double threshold, double medianOfStandard) {
  const auto isOutlier = [&](double e) { return !(e < threshold * threshold); };
  squared.erase(std::remove_if(squared.begin(), squared.end(), isOutlier), squared.end());
  const double known = std::min(static_cast<double>(squared.size()) / kEnough, 1.0);
  double variance = (1 - known) * std::pow(threshold / 2.5, 2);
  if (!squared.empty()) {
    const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
    std::nth_element(squared.begin(), middle, squared.end());
    variance += known * *middle / medianOfStandard;
  }
  return std::max(std::sqrt(variance), kLeastNoise * threshold);
}

// Truncation where a normal error is exceeded in about one of 80 cases: |e| > 2.5 sigma, e1^2 + e2^2 > (2.97 sigma)^2.
constexpr double kTruncationRays = 2.5, kTruncationPoints = 2.97;
constexpr int kPolishRounds = 4;

}  // namespace

LocalOptimizer::LocalOptimizer(const PoseScorer& scorer, double minFocalLength, double maxFocalLength)
    : scorer_(scorer), minFocalLength_(minFocalLength), maxFocalLength_(maxFocalLength) {}

FocalPose LocalOptimizer::refine(const FocalPose& start) const {
  struct Stage {
    double rays, points;  // in thresholds
    int iterations;
    double minDecrease;
  };
  constexpr Stage stages[] = {{16, 2, 3, 1e-3}, {8, 2, 3, 1e-3}, {4, 1.5, 3, 1e-3}, {2, 1, 3, 1e-3}, {1, 1, 20, 1e-6}};
  FocalPose pose = start;
  for (const Stage& stage : stages) {
    const double rays = stage.rays * scorer_.maxEpipolarError(), points = stage.points * scorer_.maxReprojectionError();
    pose = truncated(pose, rays, points, {rays, points}, stage.iterations, stage.minDecrease);
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

FocalPose LocalOptimizer::truncated(const FocalPose& start, double rayScale, double pointScale, const Noise& noise,
                                    int iterations, double minDecrease) const {
  LeastSquaresOptions options;
  options.maxIterations = iterations;
  options.minRelativeDecrease = minDecrease;
  options.minFocalLength = minFocalLength_, options.maxFocalLength = maxFocalLength_;
  const LeastSquaresProblem problem =
      makeProblem(scorer_.arrays(), {Loss::Truncated, pointScale, 1 / (noise.points * noise.points)},
                  {Loss::Truncated, rayScale, 1 / (noise.rays * noise.rays)});
  return minimize(problem, start, options).pose;
}

Noise LocalOptimizer::noise(const FocalPose& pose) const {
  return {deviation(scorer_.squaredRayErrors(pose), scorer_.maxEpipolarError(), kMedianOne),
          deviation(scorer_.squaredPointErrors(pose), scorer_.maxReprojectionError(), kMedianTwo)};
}

FinalPose LocalOptimizer::polish(const FocalPose& start, bool optimize) const {
  FinalPose result;
  result.pose = start;
  for (int round = 0; optimize && round < kPolishRounds; ++round) {
    result.noise = noise(result.pose);
    const double rays = std::min(kTruncationRays * result.noise.rays, scorer_.maxEpipolarError());
    const double points = std::min(kTruncationPoints * result.noise.points, scorer_.maxReprojectionError());
    result.pose = truncated(result.pose, rays, points, result.noise, 20, 1e-8);
  }
  result.noise = noise(result.pose);
  const LeastSquaresProblem problem =
      makeProblem(scorer_.arrays(), {Loss::Truncated, scorer_.maxReprojectionError(), 1 / std::pow(result.noise.points, 2)},
                  {Loss::Truncated, scorer_.maxEpipolarError(), 1 / std::pow(result.noise.rays, 2)});
  result.information = information(problem, result.pose);
  return result;
}

}  // namespace robust
}  // namespace hybridgv

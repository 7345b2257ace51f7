#include "robust/DepthPrior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/ApparentDepth.hpp"
#include "robust/medians.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::CorrespondenceArrays;

// A narrower distribution would refuse honest foreground.
constexpr double kLeastWidth = 0.5;
constexpr double kDeviationsPerMedian = 1.4826;  // of normal values
// The depths of rays change with the pose that they are to test; points are better where there are some.
constexpr std::size_t kEnoughPoints = 5;

// A number also at the query itself.
double logOf(double depth) { return std::log(std::max(depth, std::numeric_limits<double>::min())); }

bool isInlier(double squaredError, const ErrorMixture& noise) { return squaredError < noise.boundary * noise.boundary; }

// Those of inliers, which are in front: behind the query errors are infinite.
std::vector<double> logDepthsOfPoints(const CorrespondenceArrays& arrays, const QueryPose& pose,
                                      const std::vector<double>& squaredErrors, const ErrorMixture& noise) {
  std::vector<double> result;
  for (std::size_t i = 0; i < squaredErrors.size(); ++i)
    if (isInlier(squaredErrors[i], noise))
      result.push_back(logOf(pose.rotation.col(2).dot(arrays.points()[i].point - pose.position)));
  return result;
}

}  // namespace

DepthPrior::DepthPrior(const CorrespondenceArrays& arrays, const QueryPose& pose,
                       const PerKind<std::vector<double>>& squaredErrors, const PerKind<ErrorMixture>& noise)
    : arrays_(arrays), pose_(pose), deviation_(noise.rays.deviation) {
  std::vector<double> ofPoints = logDepthsOfPoints(arrays, pose, squaredErrors.points, noise.points), all = ofPoints;
  for (std::size_t i = 0; i < squaredErrors.rays.size(); ++i)
    if (isInlier(squaredErrors.rays[i], noise.rays)) all.push_back(logDepth(i));
  if (all.empty()) return;
  logMode_ = ofPoints.size() >= kEnoughPoints ? median(ofPoints) : median(all);
  const double n = static_cast<double>(all.size());
  for (double& value : all) value = std::abs(value - logMode_);
  width_ = std::max(kLeastWidth, kDeviationsPerMedian * median(all)) * std::sqrt(1 + 5 / n);
}

double DepthPrior::plausibility(std::size_t ray) const {
  if (!(width_ > 0)) return 1;
  const double difference = logDepth(ray) - logMode_, t = difference / width_, q = 1 + t * t / 3;
  return std::min(1., std::exp(difference)) / (q * q);
}

// No ray is farther than where its disparity is two standard deviations.
double DepthPrior::logDepth(std::size_t ray) const {
  constexpr double kDeviations = 2;
  const ApparentDepth depth = apparentDepth(arrays_.rays()[ray], pose_);
  return logOf(1 / std::max(kDeviations * deviation_ * depth.perPixel, depth.inverse));
}

}  // namespace robust
}  // namespace hybridgv

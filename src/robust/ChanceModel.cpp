#include "robust/ChanceModel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/imageBox.hpp"

namespace hybridgv {
namespace robust {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMaxShare = 0.5;
// Natural log of the probability that a kind's inliers are chance, below which they are taken as more than that.
constexpr double kLogMoreThanChance = -7;

// Infinite if there is no whole.
double share(double part, double whole) { return whole > 0 ? part / whole : std::numeric_limits<double>::infinity(); }

double atMostHalf(double share) { return share < kMaxShare ? share : kMaxShare; }

}  // namespace

ChanceModel::ChanceModel(const CorrespondenceArrays& arrays, double maxEpipolarError, double maxReprojectionError)
    : ChanceModel(arrays, imageBox(arrays), maxEpipolarError, maxReprojectionError) {}

ChanceModel::ChanceModel(const CorrespondenceArrays& arrays, const RobustBox::Size& image, double maxEpipolarError,
                         double maxReprojectionError) {
  const double band = 2 * std::sqrt(2.) * maxEpipolarError;
  rayShare_ = share(band * image.diagonal(), image.area());
  pointShare_ = share(kPi * maxReprojectionError * maxReprojectionError, image.area());

  RobustBox map;
  for (const CorrespondenceArrays::MapImagePoint& point : arrays.mapImagePoints()) map.add(point.x, point.y);
  const RobustBox::Size mapSize = map.size();
  const double perPixel = band * mapSize.diagonal() / (mapSize.area() * static_cast<double>(arrays.rays().size()));
  for (const CorrespondenceArrays::MapImagePoint& point : arrays.mapImagePoints()) {
    rayShare_ += share(perPixel, point.focalLength);
  }
}

double ChanceModel::rayShare(double scale) const { return atMostHalf(scale * rayShare_); }

double ChanceModel::pointShare(double scale) const { return atMostHalf(scale * scale * pointShare_); }

Shares ChanceModel::levelShares() const {
  Shares result;
  for (int level = 0; level < kLevels; ++level) {
    result.rays[static_cast<std::size_t>(level)] = rayShare(thresholdAt(1, level));
    result.points[static_cast<std::size_t>(level)] = pointShare(thresholdAt(1, level));
  }
  return result;
}

double logTail(int n, int k, double p) {
  if (k <= n * p || n <= 0) return 0;
  const double q = static_cast<double>(k) / n;
  const double rest = q < 1 ? (1 - q) * std::log((1 - q) / (1 - p)) : 0;
  return -n * (q * std::log(q / p) + rest);
}

bool ChanceModel::raysAreMoreThanChance(int inliers, int all, double scale) const {
  return logTail(all, inliers, rayShare(scale)) < kLogMoreThanChance;
}

bool ChanceModel::pointsAreMoreThanChance(int inliers, int all, double scale) const {
  return logTail(all, inliers, pointShare(scale)) < kLogMoreThanChance;
}

double ChanceModel::logProbability(const Support& support, double rayShare, double pointShare, int parameters) {
  double worst = -std::numeric_limits<double>::infinity();
  const int mostPoints = std::min((parameters + 1) / 2, support.points);
  for (int points = 0; points <= mostPoints; ++points) {
    const int rays = std::max(parameters - 2 * points, 0);
    if (rays > support.rays && points < mostPoints) continue;
    worst = std::max(worst, logTail(support.allPoints - points, support.points - points, pointShare) +
                                logTail(support.allRays - rays, support.rays - rays, rayShare));
  }
  return worst / std::log(10.);
}

}  // namespace robust
}  // namespace hybridgv

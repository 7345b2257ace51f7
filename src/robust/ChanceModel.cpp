#include "robust/ChanceModel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridgv {
namespace robust {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMaxShare = 0.5;
// Natural log of the probability that a kind's inliers are chance, below which they are taken as more than that.
constexpr double kLogMoreThanChance = -7;

class BoundingBox {
 public:
  void add(double u, double v) {
    minU_ = std::min(minU_, u);
    maxU_ = std::max(maxU_, u);
    minV_ = std::min(minV_, v);
    maxV_ = std::max(maxV_, v);
  }
  double area() const { return (maxU_ - minU_) * (maxV_ - minV_); }
  double diagonal() const { return std::hypot(maxU_ - minU_, maxV_ - minV_); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double minU_ = kInfinity, maxU_ = -kInfinity, minV_ = kInfinity, maxV_ = -kInfinity;
};

double share(double part, double whole) { return whole > 0 ? std::min(part / whole, kMaxShare) : kMaxShare; }

}  // namespace

ChanceModel::ChanceModel(const CorrespondenceArrays& arrays, double maxEpipolarError, double maxReprojectionError)
    : leastFocalLength_(arrays.rayArrays().leastFocalLength) {
  BoundingBox query, map;
  for (const correspondences::RayMatch& match : arrays.rays()) query.add(match.u, match.v);
  for (const correspondences::PointMatch& match : arrays.points()) query.add(match.u, match.v);
  const double band = 2 * std::sqrt(2.) * maxEpipolarError;
  rayShareOfQuery_ = share(band * query.diagonal(), query.area());
  pointShare_ = share(kPi * maxReprojectionError * maxReprojectionError, query.area());

  for (const CorrespondenceArrays::MapImagePoint& point : arrays.mapImagePoints()) map.add(point.x, point.y);
  const double perPixel = band * map.diagonal() / (map.area() * static_cast<double>(arrays.rays().size()));
  for (const CorrespondenceArrays::MapImagePoint& point : arrays.mapImagePoints()) {
    if (point.focalLength > 0)
      knownMapShare_ += perPixel / point.focalLength;
    else
      unknownMapShare_ += perPixel;
  }
}

double ChanceModel::rayShare(double focalLength) const {
  const double sum = rayShareOfQuery_ + knownMapShare_ + unknownMapShare_ / std::max(focalLength, leastFocalLength_);
  return sum < kMaxShare ? sum : kMaxShare;
}

double logTail(int n, int k, double p) {
  if (k <= n * p || n <= 0) return 0;
  const double q = static_cast<double>(k) / n;
  const double rest = q < 1 ? (1 - q) * std::log((1 - q) / (1 - p)) : 0;
  return -n * (q * std::log(q / p) + rest);
}

bool ChanceModel::raysAreMoreThanChance(int inliers, int all, double focalLength) const {
  return logTail(all, inliers, rayShare(focalLength)) < kLogMoreThanChance;
}

bool ChanceModel::pointsAreMoreThanChance(int inliers, int all) const {
  return logTail(all, inliers, pointShare_) < kLogMoreThanChance;
}

double ChanceModel::logProbability(const Support& support, double focalLength, int parameters) const {
  double worst = -std::numeric_limits<double>::infinity();
  const int mostPoints = std::min((parameters + 1) / 2, support.points);
  for (int points = 0; points <= mostPoints; ++points) {
    const int rays = std::max(parameters - 2 * points, 0);
    if (rays > support.rays && points < mostPoints) continue;
    worst = std::max(worst, logTail(support.allPoints - points, support.points - points, pointShare_) +
                                logTail(support.allRays - rays, support.rays - rays, rayShare(focalLength)));
  }
  return worst / std::log(10.);
}

}  // namespace robust
}  // namespace hybridgv

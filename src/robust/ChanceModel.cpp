#include "robust/ChanceModel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridgv {
namespace robust {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMaxShare = 0.5;

class BoundingBox {
 public:
  void add(double u, double v) {
    minU_ = std::min(minU_, u), maxU_ = std::max(maxU_, u);
    minV_ = std::min(minV_, v), maxV_ = std::max(maxV_, v);
  }
  double area() const { return (maxU_ - minU_) * (maxV_ - minV_); }
  double diagonal() const { return std::hypot(maxU_ - minU_, maxV_ - minV_); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double minU_ = kInfinity, maxU_ = -kInfinity, minV_ = kInfinity, maxV_ = -kInfinity;
};

double shareOf(double part, double area) { return area > 0 ? std::min(part / area, kMaxShare) : kMaxShare; }

}  // namespace

ChanceModel::ChanceModel(const HybridArrays& arrays, double maxEpipolarError, double maxReprojectionError) {
  BoundingBox box;
  for (const solvers::RayMatch& match : arrays.rays()) box.add(match.u, match.v);
  for (const solvers::PointMatch& match : arrays.points()) box.add(match.u, match.v);
  rayShare_ = shareOf(2 * std::sqrt(2.) * maxEpipolarError * box.diagonal(), box.area());
  pointShare_ = shareOf(kPi * maxReprojectionError * maxReprojectionError, box.area());
}

double logTail(int n, int k, double p) {
  if (k <= n * p || n <= 0) return 0;
  const double q = static_cast<double>(k) / n;
  const double rest = q < 1 ? (1 - q) * std::log((1 - q) / (1 - p)) : 0;
  return -n * (q * std::log(q / p) + rest);
}

double ChanceModel::logFalseAlarms(const Support& support, int parameters, double tests) const {
  double worst = -std::numeric_limits<double>::infinity();
  const int mostPoints = std::min((parameters + 1) / 2, support.points);
  for (int points = 0; points <= mostPoints; ++points) {
    const int rays = std::max(parameters - 2 * points, 0);
    if (rays > support.rays && points < mostPoints) continue;
    worst = std::max(worst, logTail(support.allPoints - points, support.points - points, pointShare_) +
                                logTail(support.allRays - rays, support.rays - rays, rayShare_));
  }
  return (worst + std::log(tests)) / std::log(10.);
}

}  // namespace robust
}  // namespace hybridgv

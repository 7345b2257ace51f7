#include "robust/Thresholds.hpp"

#include <algorithm>
#include <cmath>

#include "robust/Levels.hpp"
#include "robust/medians.hpp"

namespace hybridgv {
namespace robust {
namespace {

constexpr double kBoundOfRays = 0.01, kBoundOfPoints = 0.05;  // of the image's diagonal
constexpr double kLeastBound = 0.004;                         // of the focal length
constexpr double kDeviations = 2.5, kMostOfExcess = 0.75;

double workingThreshold(const std::vector<double>& squaredErrors, double bound, const LevelShares& chance,
                        double medianOfSquares) {
  const LevelCounts counts = countLevels(squaredErrors.data(), squaredErrors.size(), bound * bound);
  std::array<double, kLevels> excess{};
  for (std::size_t level = 0; level < kLevels; ++level)
    excess[level] = counts[level] - static_cast<double>(squaredErrors.size()) * chance[level];
  const double enough = kMostOfExcess * *std::max_element(excess.begin(), excess.end());
  if (!(enough > 0)) return bound;
  int level = kLevels - 1;
  while (excess[static_cast<std::size_t>(level)] < enough) --level;
  double threshold = thresholdAt(bound, level);
  for (int round = 0; round < 2; ++round) {
    std::vector<double> inliers = below(squaredErrors, threshold);
    const double deviation = std::sqrt(median(inliers) / medianOfSquares);
    threshold = std::clamp(kDeviations * deviation, thresholdAt(bound, kLevels), bound);
  }
  return threshold;
}

}  // namespace

Thresholds thresholdBounds(const Thresholds& given, double focalLength, const RobustBox::Size& image) {
  // Image points that coincide have no size; then no threshold makes sense, and any will do.
  const double measured = image.diagonal(), diagonal = measured > 0 ? measured : 1;
  const auto bound = [&](double ofDiagonal) { return std::max(ofDiagonal * diagonal, kLeastBound * focalLength); };
  return {given.rays > 0 ? given.rays : bound(kBoundOfRays), given.points > 0 ? given.points : bound(kBoundOfPoints)};
}

Thresholds workingThresholds(const PerKind<std::vector<double>>& squaredErrors, const Thresholds& bounds,
                             const ChanceModel& chance) {
  const Shares shares = chance.levelShares();
  return {workingThreshold(squaredErrors.rays, bounds.rays, shares.rays, kMedianOfOneSquare),
          workingThreshold(squaredErrors.points, bounds.points, shares.points, kMedianOfTwoSquares)};
}

}  // namespace robust
}  // namespace hybridgv

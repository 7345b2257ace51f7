#include "robust/SecondPose.hpp"

#include <algorithm>
#include <cmath>

#include "robust/Overlap.hpp"

namespace hybridgv {
namespace robust {
namespace {

std::vector<int> placesOfOutliers(const std::vector<char>& inliers) {
  std::vector<int> places;
  for (std::size_t i = 0; i < inliers.size(); ++i)
    if (!inliers[i]) places.push_back(static_cast<int>(i));
  return places;
}

// A sample of three has inliers only (kAsGood / (1 - b))^3 times as often as in the search for the best pose, with which the share b of
// all agrees, and may be missed more often.
int samples(double shareOfBest, int ofBest, const sac::HybridRansacOptions& options) {
  constexpr double kMiss = 0.05, kLeast = 32;
  const double perSample = std::pow(kAsGood / (1 - shareOfBest), 3);
  const double needed = ofBest / perSample * std::log(kMiss) / std::log1p(-options.successProbability);
  return static_cast<int>(std::min(std::max(needed, kLeast), static_cast<double>(options.maxIterations)));
}

// The first of them, which are as good as any, because correspondences are in random order.
void keepShare(double share, std::vector<int>& places) {
  if (share < 1) places.resize(static_cast<std::size_t>(std::ceil(share * static_cast<double>(places.size()))));
}

}  // namespace

std::optional<SecondPose> findSecondPose(const HybridSearch& search, const hybrid_pose::HybridAdapterBase& adapter,
                                         const sac::HybridRansacOptions& options, Clock::time_point start) {
  constexpr double kEnough = 40;  // inliers of a second pose
  const InlierMasks inliers = search.inliersOf(search.best().pose);
  std::vector<int> rays = placesOfOutliers(inliers.rays), points = placesOfOutliers(inliers.points);
  const auto others = static_cast<double>(rays.size() + points.size());
  const double all = static_cast<double>(inliers.rays.size() + inliers.points.size()), found = all - others;
  if (others < kAsGood * found) return std::nullopt;
  for (std::vector<int>* places : {&rays, &points}) keepShare(kEnough / (kAsGood * found), *places);

  sac::HybridRansacOptions ofSecond = options;
  ofSecond.initialPose.reset();
  ofSecond.maxEpipolarErrorPx = search.bounds().rays;
  ofSecond.maxReprojectionErrorPx = search.bounds().points;
  ofSecond.maxIterations = samples(found / all, search.iterations(), options);
  ofSecond.minIterations = std::min(options.minIterations, ofSecond.maxIterations);
  HybridSearch second(partAt(rays, points, search.searchedData(), adapter, options), std::nullopt, ofSecond, search.workers(),
                      start);
  if (!second.canStart()) return std::nullopt;
  second.considerPromisingOnly();
  second.run();
  if (!second.hasModel()) return std::nullopt;
  const FinalPose final = second.finish(true);
  if (second.verdict(final) != sac::FailureReason::None) return std::nullopt;
  const QueryPose pose = search.optimized(final.pose);
  const Overlap overlap = robust::overlap(inliers, search.inliersOf(pose));
  if (!areDifferent(overlap)) return std::nullopt;
  return SecondPose{pose, relativeSupport(overlap)};
}

}  // namespace robust
}  // namespace hybridgv

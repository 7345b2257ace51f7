#include "robust/SearchData.hpp"

#include <algorithm>
#include <utility>

#include "correspondences/readCorrespondence.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::CorrespondenceArrays;

// Streams of random numbers apart from those of the hypotheses.
constexpr std::uint64_t kRayOrderStream = ~std::uint64_t{0}, kPointOrderStream = kRayOrderStream - 1;

// The indices 0 .. count-1 in random order.
std::vector<int> shuffled(std::size_t count, std::uint64_t seed, std::uint64_t stream) {
  std::vector<int> order = correspondences::allIndices(count);
  RandomStream random(seed, stream);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return order;
}

// Positions in the arrays in order of decreasing weight; equal weights stay in their random order.
std::vector<int> byQuality(const std::vector<double>& weights) {
  std::vector<int> order = correspondences::allIndices(weights.size());
  const auto weightOf = [&](int i) { return weights[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return weightOf(a) > weightOf(b); });
  return order;
}

Sampler makeSampler(const hybrid_pose::HybridAdapterBase& adapter, const CorrespondenceArrays& arrays,
                    const std::vector<int>& rayIndices, const std::vector<int>& pointIndices, sac::Sampling sampling) {
  std::vector<int> cameras;
  for (const correspondences::RayMatch& ray : arrays.rays()) cameras.push_back(ray.camera);
  if (sampling == sac::Sampling::Uniform)
    return {cameras, correspondences::allIndices(rayIndices.size()), correspondences::allIndices(pointIndices.size()), false};
  std::vector<int> rays = byQuality(correspondences::readRayWeights(adapter, rayIndices));
  std::vector<int> points = byQuality(correspondences::readPointWeights(adapter, pointIndices));
  const bool weightsDiffer = !std::is_sorted(rays.begin(), rays.end()) || !std::is_sorted(points.begin(), points.end());
  return {cameras, std::move(rays), std::move(points), weightsDiffer};
}

CorrespondenceArrays readArrays(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& rays,
                                const std::vector<int>& points) {
  CorrespondenceArrays arrays(adapter, rays, points);
  arrays.fixUnknownFocalLengths();
  return arrays;
}

}  // namespace

SearchData readSearchData(const hybrid_pose::HybridAdapterBase& adapter, const sac::HybridRansacOptions& options) {
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  std::vector<int> rays = shuffled(counts.rays, options.seed, kRayOrderStream);
  std::vector<int> points = shuffled(counts.points, options.seed, kPointOrderStream);
  CorrespondenceArrays arrays = readArrays(adapter, rays, points);
  Sampler sampler = makeSampler(adapter, arrays, rays, points, options.sampling);
  return {std::move(rays), std::move(points), std::move(arrays), std::move(sampler)};
}

// The correspondences are in random order, so the first ones are as good as any.
std::optional<SearchData> partOf(const SearchData& all, const hybrid_pose::HybridAdapterBase& adapter,
                                 const sac::HybridRansacOptions& options) {
  constexpr std::size_t kEnough = 1000;
  const std::size_t rays = std::min(all.rayIndices.size(), kEnough), points = std::min(all.pointIndices.size(), kEnough);
  if (rays == all.rayIndices.size() && points == all.pointIndices.size()) return std::nullopt;
  const auto first = [](const std::vector<int>& indices, std::size_t count) {
    return std::vector<int>(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(count));
  };
  std::vector<int> rayIndices = first(all.rayIndices, rays), pointIndices = first(all.pointIndices, points);
  CorrespondenceArrays arrays = all.arrays.subset(correspondences::allIndices(rays), correspondences::allIndices(points));
  Sampler sampler = makeSampler(adapter, arrays, rayIndices, pointIndices, options.sampling);
  return SearchData{std::move(rayIndices), std::move(pointIndices), std::move(arrays), std::move(sampler)};
}

}  // namespace robust
}  // namespace hybridgv

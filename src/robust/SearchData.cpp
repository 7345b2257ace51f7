#include "robust/SearchData.hpp"

#include <algorithm>
#include <iterator>
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

// Places of at most `count` rays, in increasing order. The arrays are in random order, so the first ones are as good as any; but the rays
// of one camera, which fix the scale, must not get lost among many of another. So half of them come from all cameras alike.
std::vector<int> someRays(const CorrespondenceArrays& arrays, std::size_t count) {
  const std::size_t all = arrays.rays().size();
  if (all <= count) return correspondences::allIndices(all);
  std::vector<int> chosen = correspondences::allIndices(count / 2), seen;
  std::vector<std::pair<int, int>> others;  // how many of the same camera come before, place
  for (std::size_t i = chosen.size(); i < all; ++i) {
    const auto camera = static_cast<std::size_t>(arrays.rays()[i].camera);
    if (camera >= seen.size()) seen.resize(camera + 1, 0);
    others.emplace_back(seen[camera]++, static_cast<int>(i));
  }
  const auto end = others.begin() + static_cast<std::ptrdiff_t>(count - chosen.size());
  std::nth_element(others.begin(), end, others.end());
  std::transform(others.begin(), end, std::back_inserter(chosen), [](const std::pair<int, int>& other) { return other.second; });
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<int> at(const std::vector<int>& values, const std::vector<int>& places) {
  std::vector<int> result;
  result.reserve(places.size());
  for (const int place : places) result.push_back(values[static_cast<std::size_t>(place)]);
  return result;
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

std::optional<SearchData> partOf(const SearchData& all, const hybrid_pose::HybridAdapterBase& adapter,
                                 const sac::HybridRansacOptions& options) {
  constexpr std::size_t kEnough = 1000;
  if (all.rayIndices.size() <= kEnough && all.pointIndices.size() <= kEnough) return std::nullopt;
  const std::vector<int> rays = someRays(all.arrays, kEnough);
  return partAt(rays, correspondences::allIndices(std::min(all.pointIndices.size(), kEnough)), all, adapter, options);
}

SearchData partAt(const std::vector<int>& rays, const std::vector<int>& points, const SearchData& all,
                  const hybrid_pose::HybridAdapterBase& adapter, const sac::HybridRansacOptions& options) {
  std::vector<int> rayIndices = at(all.rayIndices, rays), pointIndices = at(all.pointIndices, points);
  CorrespondenceArrays arrays = all.arrays.subset(rays, points);
  Sampler sampler = makeSampler(adapter, arrays, rayIndices, pointIndices, options.sampling);
  return {std::move(rayIndices), std::move(pointIndices), std::move(arrays), std::move(sampler)};
}

}  // namespace robust
}  // namespace hybridgv

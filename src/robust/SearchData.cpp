#include "robust/SearchData.hpp"

#include <algorithm>
#include <functional>
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
  const bool areEqual = std::adjacent_find(weights.begin(), weights.end(), std::not_equal_to<double>()) == weights.end();
  if (areEqual) return order;
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

// A thousand of each kind are searched in.
constexpr std::size_t kEnough = 1000;

bool areMany(std::size_t rays, std::size_t points) { return rays > kEnough || points > kEnough; }

// Places of at most `count` rays, in increasing order. The arrays are in random order, so the first ones are as good as any; but the rays
// of one camera, which fix the scale, must not get lost among many of another. So half of them come from all cameras alike.
std::vector<int> someRays(const CorrespondenceArrays& arrays, std::size_t count) {
  const std::size_t all = arrays.rays().size();
  if (all <= count) return correspondences::allIndices(all);
  std::vector<int> chosen = correspondences::allIndices(count / 2);
  const std::size_t wanted = count - chosen.size();
  std::vector<std::size_t> ofCamera, ofRank, ranks(all);  // rank: how many of the same camera come before
  for (std::size_t i = chosen.size(); i < all; ++i) {
    const auto camera = static_cast<std::size_t>(arrays.rays()[i].camera);
    if (camera >= ofCamera.size()) ofCamera.resize(camera + 1, 0);
    ranks[i] = ofCamera[camera]++;
    if (ranks[i] >= ofRank.size()) ofRank.resize(ranks[i] + 1, 0);
    ++ofRank[ranks[i]];
  }
  std::size_t last = 0, before = 0;  // the last rank of which there is room for some, and how many there are of those before
  while (before + ofRank[last] < wanted) before += ofRank[last++];
  for (std::size_t i = chosen.size(), room = wanted - before; i < all; ++i)
    if (ranks[i] < last || (ranks[i] == last && room > 0)) {
      room -= ranks[i] == last;
      chosen.push_back(static_cast<int>(i));
    }
  return chosen;
}

std::vector<int> at(const std::vector<int>& values, const std::vector<int>& places) {
  std::vector<int> result;
  result.reserve(places.size());
  for (const int place : places) result.push_back(values[static_cast<std::size_t>(place)]);
  return result;
}

}  // namespace

double roughlyKnownFocalLength(const sac::HybridRansacOptions& options) {
  return options.knownFocalLengthPx.value_or(options.focalLengthPriorPx.value_or(0));
}

SearchData readSearchData(const hybrid_pose::HybridAdapterBase& adapter, const sac::HybridRansacOptions& options,
                          WorkerPool& workers) {
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  const bool isLarge = areMany(counts.rays, counts.points);
  const correspondences::ForEach byWorkers = [&](int count, const std::function<void(int)>& body) {
    workers.forEach(count, [&](int i, std::size_t) { body(i); });
  };
  const correspondences::ForEach forEach = isLarge ? byWorkers : correspondences::oneByOne;
  SearchData data;
  forEach(2, [&](int kind) {
    if (kind == 0)
      data.rayIndices = shuffled(counts.rays, options.seed, kRayOrderStream);
    else
      data.pointIndices = shuffled(counts.points, options.seed, kPointOrderStream);
  });
  data.arrays = CorrespondenceArrays(adapter, data.rayIndices, data.pointIndices, forEach);
  // Image points of a small object do not tell the image's size. A focal length that is too large only makes light of the map image's part of the
  // errors; one that is too small makes all of them small.
  data.arrays.fixUnknownFocalLengths(roughlyKnownFocalLength(options));
  if (!isLarge) data.sampler = makeSampler(adapter, data.arrays, data.rayIndices, data.pointIndices, options.sampling);
  return data;
}

std::optional<SearchData> partOf(const SearchData& all, const hybrid_pose::HybridAdapterBase& adapter,
                                 const sac::HybridRansacOptions& options) {
  if (!areMany(all.rayIndices.size(), all.pointIndices.size())) return std::nullopt;
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

#include <cmath>
#include <numeric>

#include "CheckArguments.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/detail/format.hpp"
#include "math/RandomStream.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Vectors = NoncentralHybridAdapter::Vectors;

// A random order of the first `count` entries among all of them.
void shuffleFront(std::vector<std::size_t>& entries, std::size_t count, math::SplitMix64& random) {
  for (std::size_t i = 0; i < count; ++i) std::swap(entries[i], entries[i + random.below(entries.size() - i)]);
}

// round(share * count) different numbers first, first + 1, .. first + count - 1.
std::vector<std::size_t> choose(std::size_t first, std::size_t count, double share, math::SplitMix64& random) {
  std::vector<std::size_t> entries(count);
  std::iota(entries.begin(), entries.end(), first);
  const auto chosen = static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
  shuffleFront(entries, chosen, random);
  entries.resize(chosen);
  return entries;
}

// The query's image points with the numbers of their features: first those of the 2D-2D correspondences, then those of the 2D-3D ones.
struct QueryPoints {
  Vectors points;
  std::vector<int> features;

  // Those from `begin` to before `end`.
  QueryPoints part(std::size_t begin, std::size_t end) const {
    const auto from = static_cast<std::ptrdiff_t>(begin), to = static_cast<std::ptrdiff_t>(end);
    return {{points.begin() + from, points.begin() + to}, {features.begin() + from, features.begin() + to}};
  }
};

QueryPoints queryPointsOf(const NoncentralHybridAdapter& adapter) {
  QueryPoints result;
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d2d(); ++i) {
    result.points.push_back(adapter.getImagePoint2d2d(i));
    result.features.push_back(adapter.getFeature2d2d(i));
  }
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i) {
    result.points.push_back(adapter.getImagePoint2d3d(i));
    result.features.push_back(adapter.getFeature2d3d(i));
  }
  return result;
}

// The adapter with other image points.
NoncentralHybridAdapter withQueryPoints(const NoncentralHybridAdapter& adapter, const QueryPoints& queryPoints) {
  const std::size_t rays = adapter.getNumberCorrespondences2d2d();
  Vectors bearings, centres, points;
  NoncentralHybridAdapter::Matrices rotations;
  std::vector<int> camIndices;
  std::vector<double> focalLengths, weights2d2d, weights2d3d;
  for (std::size_t i = 0; i < rays; ++i) {
    const auto camera = static_cast<std::size_t>(adapter.getCamIndex(i));
    if (camera >= centres.size()) {  // cameras in between that no ray uses may have any pose
      centres.resize(camera + 1, Eigen::Vector3d::Zero());
      rotations.resize(camera + 1, Eigen::Matrix3d::Identity());
      focalLengths.resize(camera + 1, 0);
    }
    centres[camera] = adapter.getCamOffset(i);
    rotations[camera] = adapter.getCamRotation(i);
    focalLengths[camera] = adapter.getRigFocalLength(i);
    camIndices.push_back(adapter.getCamIndex(i));
    bearings.push_back(adapter.getBearingVector(i));
    weights2d2d.push_back(adapter.getWeight2d2d(i));
  }
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i) {
    points.push_back(adapter.getPoint(i));
    weights2d3d.push_back(adapter.getWeight2d3d(i));
  }
  const QueryPoints ofRays = queryPoints.part(0, rays), ofPoints = queryPoints.part(rays, queryPoints.points.size());
  NoncentralHybridAdapter result(ofRays.points, bearings, camIndices, centres, rotations, ofPoints.points, points);
  result.setRigFocalLengths(focalLengths);
  result.setWeights(weights2d2d, weights2d3d);
  result.setFeatures(ofRays.features, ofPoints.features);
  return result;
}

}  // namespace

LocalizationProblem injectOutliers(const LocalizationProblem& problem, double share, std::uint64_t seed) {
  if (!(share >= 0 && share <= 1)) throwInvalid("share", "must be in 0 .. 1, is " + detail::format(share));
  const std::size_t rays = problem.adapter.getNumberCorrespondences2d2d();
  const std::size_t points = problem.adapter.getNumberCorrespondences2d3d();
  math::SplitMix64 random(seed);
  std::vector<std::size_t> chosen = choose(0, rays, share, random);
  const std::vector<std::size_t> chosenPoints = choose(rays, points, share, random);
  chosen.insert(chosen.end(), chosenPoints.begin(), chosenPoints.end());
  shuffleFront(chosen, chosen.size(), random);
  if (chosen.size() < 2) return problem;

  const QueryPoints original = queryPointsOf(problem.adapter);
  QueryPoints permuted = original;
  LocalizationProblem result = problem;
  result.isOutlier2d2d.resize(rays);
  result.isOutlier2d3d.resize(points);
  for (std::size_t i = 0; i < chosen.size(); ++i) {  // one cycle through all chosen ones: none keeps its own
    const std::size_t to = chosen[i], from = chosen[(i + 1) % chosen.size()];
    permuted.points[to] = original.points[from];
    permuted.features[to] = original.features[from];
    if (to < rays)
      result.isOutlier2d2d[to] = true;
    else
      result.isOutlier2d3d[to - rays] = true;
  }
  result.adapter = withQueryPoints(problem.adapter, permuted);
  return result;
}

}  // namespace sfm
}  // namespace hybridgv

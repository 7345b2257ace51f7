#include "robust/WrongNeighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "HybridScene.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace test {
namespace {

using correspondences::allIndices;
using correspondences::CorrespondenceArrays;
using robust::LevelShares;

constexpr double kThreshold = 40, kHalfImage = 500;
constexpr std::size_t kNeighbours = 8;

// Of every point with its nearest neighbours, at the true pose.
struct Shares {
  LevelShares all{}, wrong{};
  double largestDistance = 0;  // of the image places of a point and a neighbour
};

Shares sharesOf(const HybridScene& scene) {
  const CorrespondenceArrays arrays(scene.adapter(), {}, allIndices(scene.points.size()));
  const auto distance = [&](std::size_t i, std::size_t j) { return (scene.points[i] - scene.points[j]).norm(); };
  Shares result;
  std::vector<robust::NeighbourPair> pairs;
  std::vector<double> errors;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    std::vector<std::size_t> order(scene.points.size());
    for (std::size_t j = 0; j < order.size(); ++j) order[j] = j;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return distance(i, a) < distance(i, b); });
    for (std::size_t k = 1; k <= kNeighbours; ++k) {
      const Eigen::Vector2d seen = project(scene.truth, scene.points[i]);
      pairs.push_back({i, order[k]});
      errors.push_back((seen - scene.image2d3d[order[k]].head<2>()).squaredNorm());
      result.largestDistance = std::max(result.largestDistance, (seen - project(scene.truth, scene.points[order[k]])).norm());
    }
  }
  const robust::LevelCounts counts = robust::countLevels(errors.data(), errors.size(), kThreshold * kThreshold);
  for (std::size_t level = 0; level < counts.size(); ++level)
    result.all[level] = counts[level] / static_cast<double>(pairs.size());
  const robust::PlainPose truth = robust::toPlain(arrays.normalization().apply(scene.truth));
  result.wrong = sharesOfWrongNeighbours(arrays, pairs, errors, truth, kThreshold, result.all);
  return result;
}

HybridScene sceneOf(int points, double outlierShare, std::uint64_t number = 0) {
  Random random(testSeed() + 9350, number);
  SceneOptions options;
  options.rays = 0;
  options.points = points;
  options.outlierSharePoints = outlierShare;
  return makeHybridScene(random, options);
}

void shrink(HybridScene& scene, double factor) {
  for (Eigen::Vector3d& point : scene.points) point *= factor;
}

// Means over scenes: the pairs of one share wrong image points.
Shares meanShares(double outlierShare, double size) {
  constexpr int kScenes = 30;
  Shares mean;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    HybridScene scene = sceneOf(400, outlierShare, i);
    shrink(scene, size);
    const Shares shares = sharesOf(scene);
    for (std::size_t level = 0; level < mean.all.size(); ++level) {
      mean.all[level] += shares.all[level] / kScenes;
      mean.wrong[level] += shares.wrong[level] / kScenes;
    }
  }
  return mean;
}

// Neighbours that are right are near; those that are wrong are near by chance.
TEST(WrongNeighbours, AtTheRightPoseTheShareIsThatOfAccidents) {
  const Shares shares = meanShares(0.8, 1);
  const double chance = Random::kPi * kThreshold * kThreshold / (4 * kHalfImage * kHalfImage);
  EXPECT_GT(shares.all[0], 2 * chance);
  EXPECT_NEAR(shares.wrong[0], chance, 0.4 * chance);
}

// Where all image points are accidents it is the share of all pairs, however much of the neighbours' circles overlaps.
TEST(WrongNeighbours, WhereAllAreAccidentsNothingIsLost) {
  for (const double size : {1., 0.3, 0.1}) {
    const Shares shares = meanShares(1, size);
    EXPECT_NEAR(shares.wrong[0], shares.all[0], 0.4 * shares.all[0]) << size;
  }
}

// Nothing can be told from neighbours at one place.
TEST(WrongNeighbours, NeighboursAtOnePlaceKeepTheShareOfAllPairs) {
  HybridScene scene = sceneOf(200, 1);
  shrink(scene, 1e-4);
  const Shares shares = sharesOf(scene);
  ASSERT_LT(shares.largestDistance, 0.1);
  EXPECT_EQ(shares.wrong, shares.all);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

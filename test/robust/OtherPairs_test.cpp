#include "robust/OtherPairs.hpp"

#include <gtest/gtest.h>

#include "HybridScene.hpp"
#include "robust/toPlain.hpp"

namespace hybridgv {
namespace test {
namespace {

using correspondences::allIndices;
using correspondences::CorrespondenceArrays;
using robust::OtherPairs;
using robust::Shares;

struct Data {
  explicit Data(const HybridScene& scene)
      : arrays(scene.adapter(), allIndices(scene.bearings.size()), allIndices(scene.points.size())),
        features(arrays),
        truth(robust::toPlain(arrays.normalization().apply(scene.truth))) {}
  CorrespondenceArrays arrays;
  robust::QueryFeatures features;
  robust::PlainPose truth;
};

HybridScene sceneOf(int count) {
  Random random(testSeed() + 9300);
  SceneOptions options;
  options.rays = options.points = count;
  return makeHybridScene(random, options);
}

TEST(OtherPairs, CountLevelsHalvesTheThreshold) {
  const double squaredErrors[] = {0.9, 0.2, 0.06, 0.01, 1.1, 1e-9};
  const robust::LevelCounts counts = robust::countLevels(squaredErrors, 6, 1);
  EXPECT_EQ(counts, (robust::LevelCounts{5, 4, 3, 2, 1, 1, 1}));  // below 1, 1/4, 1/16, 1/64, ..
}

TEST(OtherPairs, PartnersOfTheOwnKindTellWhereOnlyThatKindCrowds) {
  HybridScene scene = sceneOf(200);
  Random random(testSeed() + 9302);
  for (Eigen::Vector3d& p : scene.image2d2d) p = Eigen::Vector3d(random.uniform(-500, 500), random.uniform(-500, 500), 1);
  for (Eigen::Vector3d& p : scene.image2d3d) p = Eigen::Vector3d(random.uniform(-10, 10), random.uniform(-10, 10), 1);
  const Data data(scene);
  robust::QueryPose farAway = data.arrays.normalization().apply(scene.truth);
  farAway.position -= 1e4 * farAway.rotation.col(2);  // where the map is seen as a point
  const auto share = [&](OtherPairs::PartnersOf of) {
    return OtherPairs::random(data.arrays, data.features, 1, OtherPairs::kPairs, of)
        .shares(robust::toPlain(farAway), 30, 30)
        .points[0];
  };
  EXPECT_EQ(share(OtherPairs::PartnersOf::OwnKind), 1);
  EXPECT_LT(share(OtherPairs::PartnersOf::EitherKind), 0.9);
}

// The share of evenly spread image points within T of a place is pi T^2 / area.
TEST(OtherPairs, RandomPairsOfEvenlySpreadPointsAgreeAsOftenAsTheAreaSays) {
  HybridScene scene = sceneOf(2000);
  Random random(testSeed() + 9301);
  for (auto* image : {&scene.image2d2d, &scene.image2d3d})
    for (Eigen::Vector3d& p : *image) p = Eigen::Vector3d(random.uniform(-500, 500), random.uniform(-500, 500), 1);
  const Data data(scene);
  const double threshold = 60;
  std::vector<Shares> ofSeeds;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    ofSeeds.push_back(OtherPairs::random(data.arrays, data.features, seed).shares(data.truth, threshold, threshold));
  const Shares shares = robust::meanOf(ofSeeds);
  const double expected = Random::kPi * threshold * threshold / 1e6;
  EXPECT_NEAR(shares.points[0], expected, 0.35 * expected);
  EXPECT_NEAR(shares.points[1], expected / 4, 0.5 * expected / 4);
}

// What a few pairs are taken to say is hardly ever less than what many say; and not much more.
TEST(OtherPairs, MostOfAFewIsABoundForMany) {
  int exceeded = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    HybridScene scene = sceneOf(300);
    Random random(testSeed() + 9303 + seed);
    for (auto* image : {&scene.image2d2d, &scene.image2d3d})
      for (Eigen::Vector3d& p : *image) p = Eigen::Vector3d(random.uniform(-300, 300), random.uniform(-300, 300), 1);
    const Data data(scene);
    const OtherPairs few = OtherPairs::random(data.arrays, data.features, seed, OtherPairs::kPairs / 4);
    const Shares most = few.mostOf(few.shares(data.truth, 20, 60));
    const Shares many = OtherPairs::random(data.arrays, data.features, seed + 1).shares(data.truth, 20, 60);
    for (std::size_t level = 0; level < many.points.size(); ++level, all += 2) {
      exceeded += (many.points[level] > most.points[level]) + (many.rays[level] > most.rays[level]);
      EXPECT_LE(most.points[level], 1);
    }
    EXPECT_LT(most.points[0], many.points[0] + 0.1);
    EXPECT_LT(most.rays[0], many.rays[0] + 0.15);
  }
  EXPECT_LE(exceeded, all / 100);
}

HybridScene sceneWithPointsListedTenTimes() {
  HybridScene scene = sceneOf(20);
  const HybridScene once = scene;
  for (int copy = 0; copy < 9; ++copy) {
    scene.points.insert(scene.points.end(), once.points.begin(), once.points.end());
    scene.image2d3d.insert(scene.image2d3d.end(), once.image2d3d.begin(), once.image2d3d.end());
  }
  return scene;
}

TEST(OtherPairs, AllAgreeIfTheImageHasOnlyOnePlace) {
  HybridScene scene = sceneOf(50);
  for (Eigen::Vector3d& point : scene.points) point = Eigen::Vector3d(0.1, 0.2, 0.3) + 1e-4 * (point - scene.points[0]);
  const Eigen::Vector2d place = project(scene.truth, Eigen::Vector3d(0.1, 0.2, 0.3));
  Random random(testSeed() + 9302);
  for (auto* image : {&scene.image2d2d, &scene.image2d3d})
    for (Eigen::Vector3d& p : *image) p = Eigen::Vector3d(place[0] + random.uniform(-1, 1), place[1] + random.uniform(-1, 1), 1);
  const Data data(scene);
  EXPECT_EQ(OtherPairs::random(data.arrays, data.features, 1).shares(data.truth, 6, 12).points[0], 1);
}

// An image point of the own feature agrees with the true pose; it says nothing about accidents.
TEST(OtherPairs, TheOwnFeatureIsNoRandomPartner) {
  HybridScene scene = sceneWithPointsListedTenTimes();
  const Data data(scene);
  EXPECT_EQ(OtherPairs::random(data.arrays, data.features, 1).shares(data.truth, 0.1, 0.1).points[0], 0);
}

// Neighbours see the image points of points near to them: at the true pose as far away as those are.
TEST(OtherPairs, NeighboursAgreeWhereTheyAreNearer) {
  HybridScene scene = sceneOf(400);
  const Data data(scene);
  const robust::Evidence evidence(data.arrays);
  const Shares random = OtherPairs::random(data.arrays, data.features, 1).shares(data.truth, 100, 100);
  const Shares neighbours = OtherPairs::ofNeighbours(data.arrays, evidence).shares(data.truth, 100, 100);
  EXPECT_GT(neighbours.points[0], 3 * random.points[0]);
  EXPECT_GT(neighbours.rays[0], random.rays[0]);
}

TEST(OtherPairs, NeighboursOfOneKindAreThoseOfBoth) {
  const Data data(sceneOf(400));
  const robust::Evidence evidence(data.arrays);
  const auto sharesOf = [&](const robust::Kinds& kinds) {
    return OtherPairs::ofNeighbours(data.arrays, evidence, nullptr, kinds).shares(data.truth, 100, 100);
  };
  const Shares both = sharesOf(robust::kBothKinds), rays = sharesOf({true, false}), points = sharesOf({false, true});
  EXPECT_GT(both.rays[0], 0);
  EXPECT_EQ(rays.rays, both.rays);
  EXPECT_EQ(rays.points, robust::LevelShares{});
  EXPECT_EQ(points.points, both.points);
  EXPECT_EQ(points.rays, robust::LevelShares{});
}

TEST(OtherPairs, ACorrespondenceIsNoNeighbourOfItsOwnCopies) {
  HybridScene scene = sceneWithPointsListedTenTimes();
  const Data data(scene);
  const Shares shares = OtherPairs::ofNeighbours(data.arrays, robust::Evidence(data.arrays)).shares(data.truth, 1, 1);
  EXPECT_EQ(shares.points[0], 0);
}

TEST(OtherPairs, FewOrNoCorrespondencesHaveNoShares) {
  for (const int count : {0, 1}) {
    HybridScene scene = sceneOf(count);
    const Data data(scene);
    const Shares random = OtherPairs::random(data.arrays, data.features, 1).shares(data.truth, 6, 12);
    const Shares neighbours = OtherPairs::ofNeighbours(data.arrays, robust::Evidence(data.arrays)).shares(data.truth, 6, 12);
    EXPECT_LE(random.points[0], 1);
    EXPECT_EQ(neighbours.points[0], 0);
    EXPECT_EQ(neighbours.rays[0], 0);
  }
}

TEST(OtherPairs, TheSameSeedDrawsTheSamePartners) {
  const Data data(sceneOf(300));
  const Shares a = OtherPairs::random(data.arrays, data.features, 5).shares(data.truth, 6, 12),
               b = OtherPairs::random(data.arrays, data.features, 5).shares(data.truth, 6, 12);
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.points, b.points);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

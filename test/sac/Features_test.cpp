// hybridRansac where several correspondences come from one feature of the query.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "FeatureScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac::HybridRansacResult;

HybridRansacResult localize(const NoncentralHybridAdapter& adapter, std::uint64_t seed = 1) {
  sac::HybridRansacOptions options;
  options.seed = seed;
  return hybridRansac(adapter, options);
}

double relativeDeviation(const HybridRansacResult& result) {
  return result.focalLengthStandardDeviation / result.pose.focalLength;
}

HybridScene ordinaryScene(Random& random, int count, double outlierShare) {
  SceneOptions options;
  options.rays = options.points = count;
  options.imageNoise = 1;
  options.outlierShareRays = options.outlierSharePoints = outlierShare;
  return makeHybridScene(random, options);
}

// How often a success is found, and the root of the mean square of error over stated deviation of the focal length.
struct Calibration {
  double successes = 0, ratio = 0;
};
Calibration calibration(int features, int raysPerFeature, bool withPoints, std::uint64_t stream) {
  constexpr int kScenes = 80;
  Random random(testSeed(), stream);
  int successes = 0;
  double squares = 0;
  for (int i = 0; i < kScenes; ++i) {
    const HybridScene scene = withFeatureNoise(random, makeFeatureScene(random, features, raysPerFeature, withPoints), 1);
    const HybridRansacResult result = localize(adapterOf(scene));
    if (!result.success) continue;
    ++successes;
    squares += std::pow(std::log(result.pose.focalLength / scene.truth.focalLength) / relativeDeviation(result), 2);
  }
  return {successes / static_cast<double>(kScenes), std::sqrt(squares / successes)};
}

TEST(Features, TheDeviationIsRightHoweverManyRaysAFeatureHas) {
  struct Case {
    int features, rays;
    bool withPoints;
  };
  for (const Case& c : {Case{40, 1, true}, Case{40, 3, true}, Case{40, 5, true}, Case{80, 3, false}, Case{80, 5, false}}) {
    const Calibration at = calibration(c.features, c.rays, c.withPoints, 9420);
    EXPECT_GT(at.ratio, 0.75) << c.rays << " rays";
    EXPECT_LT(at.ratio, 1.3) << c.rays << " rays";
    EXPECT_GE(at.successes, 0.95) << c.rays << " rays";
  }
}

// Its own image point is no other one: rays beside points must not look like frequent accidents.
TEST(Features, FewFeaturesWithManyRaysAreEnough) { EXPECT_GE(calibration(12, 5, true, 9421).successes, 0.95); }

TEST(Features, WhatIsListedSeveralTimesHasTheDeviationOfOnce) {
  Random random(testSeed(), 9422);
  for (const double outlierShare : {0., 0.3})
    for (const int times : {2, 10}) {
      std::vector<double> ratios;
      for (int i = 0; i < 15; ++i) {
        const HybridScene scene = ordinaryScene(random, 50, outlierShare);
        const HybridRansacResult once = localize(adapterOf(scene)), often = localize(adapterOf(repeated(scene, times)));
        ASSERT_TRUE(once.success);
        ASSERT_TRUE(often.success);
        ratios.push_back(relativeDeviation(often) / relativeDeviation(once));
      }
      EXPECT_NEAR(median(ratios), 1, 0.05) << times << " times";
    }
}

// A keypoint that was detected at slightly different places, or refined for each match.
TEST(Features, NumbersTellWhatImagePointsDoNot) {
  Random random(testSeed(), 9423);
  std::vector<double> numbered, without;
  for (int i = 0; i < 15; ++i) {
    const HybridScene once = ordinaryScene(random, 50, 0);
    HybridScene scene = repeated(once, 4);
    for (auto* images : {&scene.image2d2d, &scene.image2d3d})
      for (Eigen::Vector3d& image : *images) image += Eigen::Vector3d(0.05 * random.normal(), 0.05 * random.normal(), 0);
    NoncentralHybridAdapter adapter = adapterOf(scene);
    without.push_back(relativeDeviation(localize(adapter)) / relativeDeviation(localize(adapterOf(once))));
    std::vector<int> rays, points;
    for (std::size_t k = 0; k < scene.bearings.size(); ++k) rays.push_back(static_cast<int>(k % once.bearings.size()));
    for (std::size_t k = 0; k < scene.points.size(); ++k) points.push_back(1000 + static_cast<int>(k % once.points.size()));
    adapter.setFeatures(rays, points);
    numbered.push_back(relativeDeviation(localize(adapter)) / relativeDeviation(localize(adapterOf(once))));
  }
  EXPECT_NEAR(median(numbered), 1, 0.1);
  EXPECT_LT(median(without), 0.7);
}

TEST(Features, NumbersThatSayWhatImagePointsSayChangeNothing) {
  Random random(testSeed(), 9424);
  const HybridScene scene = withFeatureNoise(random, makeFeatureScene(random, 40, 3, true), 1);
  NoncentralHybridAdapter adapter = adapterOf(scene);
  const HybridRansacResult without = localize(adapter);
  std::vector<int> rays, points;
  for (int i = 0; i < 120; ++i) rays.push_back(i / 3);
  for (int i = 0; i < 40; ++i) points.push_back(i);
  for (const auto& [ofRays, ofPoints] : {std::pair(rays, points), std::pair(std::vector<int>(120, -1), points)}) {
    adapter.setFeatures(ofRays, ofPoints);
    const HybridRansacResult with = localize(adapter);
    EXPECT_EQ(with.pose.focalLength, without.pose.focalLength);
    EXPECT_EQ(with.covariance, without.covariance);
  }
}

// Wrong matches of which each feature has five: they agree with a wrong pose all at once or not at all.
TEST(Features, WrongFeaturesWithManyMatchesAreNoSuccess) {
  Random random(testSeed(), 9425);
  for (int i = 0; i < 15; ++i) {
    HybridScene scene = makeFeatureScene(random, 12, 5, false);
    std::vector<int> features;
    for (int k = 0; k < 12; ++k) {
      const Eigen::Vector3d wrong = randomImagePoint(random);
      for (int m = 0; m < 5; ++m) {
        features.push_back(k);
        scene.image2d2d[static_cast<std::size_t>(5 * k + m)] =
            wrong + Eigen::Vector3d(3 * random.normal(), 3 * random.normal(), 0);
      }
    }
    NoncentralHybridAdapter adapter = adapterOf(scene);
    adapter.setFeatures(features, {});
    EXPECT_FALSE(localize(adapter).success);
  }
}

// A user that calls everything one feature is told that this proves nothing.
TEST(Features, OneFeatureIsNoEvidence) {
  Random random(testSeed(), 9426);
  const HybridScene scene = ordinaryScene(random, 2000, 0);
  NoncentralHybridAdapter adapter = adapterOf(scene);
  adapter.setFeatures(std::vector<int>(2000, 0), std::vector<int>(2000, 0));
  EXPECT_FALSE(localize(adapter).success);
}

TEST(Features, TheResultDoesNotDependOnTheNumberOfThreads) {
  Random random(testSeed(), 9427);
  const HybridScene scene = withFeatureNoise(random, makeFeatureScene(random, 60, 4, true), 1);
  sac::HybridRansacOptions options;
  const HybridRansacResult one = hybridRansac(adapterOf(scene), options);
  options.threads = 3;
  const HybridRansacResult three = hybridRansac(adapterOf(scene), options);
  EXPECT_EQ(one.covariance, three.covariance);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

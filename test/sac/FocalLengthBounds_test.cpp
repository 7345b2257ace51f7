// Which focal lengths hybridRansac allows.
#include <gtest/gtest.h>

#include <cmath>

#include "HybridScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac::hybridRansac;
using sac::HybridRansacOptions;
using sac::HybridRansacResult;

SceneOptions withMatches(int ofEachKind, double outliers) {
  SceneOptions options;
  options.rays = options.points = ofEachKind;
  options.imageNoise = 1;
  options.outlierShareRays = options.outlierSharePoints = outliers;
  return options;
}

TEST(FocalLengthBounds, AreKept) {
  Random random(testSeed(), 92);
  const HybridScene scene = makeHybridScene(random, withMatches(100, 0.2));
  HybridRansacOptions options;
  options.maxIterations = 300;
  options.minFocalLength = 1.2 * scene.truth.focalLength;
  const HybridRansacResult result = hybridRansac(scene.adapter(), options);
  if (result.score > 0) {
    EXPECT_GE(result.pose.focalLength, options.minFocalLength);
  }
  options.minFocalLength = 0.9 * scene.truth.focalLength;
  options.maxFocalLength = 1.1 * scene.truth.focalLength;
  EXPECT_TRUE(hybridRansac(scene.adapter(), options).success);
}

// 60 points in an image of 1140 px, where u is at least `leastU`.
HybridScene wideScene(std::uint64_t stream, double focalLength, double leastU) {
  constexpr double kMost = 570;
  Random random(testSeed() + stream, 190);
  SceneOptions options;
  options.rays = 0;
  HybridScene scene = makeHybridScene(random, options);
  scene.truth.focalLength = focalLength;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const double depth = random.uniform(1, 3), u = random.uniform(leastU, kMost), v = random.uniform(-kMost, kMost);
    const Eigen::Vector3d inQuery(u / focalLength, v / focalLength, 1);
    scene.points[i] = scene.truth.position + depth * (scene.truth.rotation * inQuery);
    scene.image2d3d[i] = noisyImagePoint(random, project(scene.truth, scene.points[i]), 0.5);
  }
  return scene;
}

TEST(FocalLengthBounds, AFieldOfViewThatNoCameraHasIsFoundOnlyIfItIsAllowed) {
  for (std::uint64_t i = 0; i < 10; ++i) {
    const HybridScene scene = wideScene(i, 100, -570);  // 160 degrees
    HybridRansacOptions options;
    options.seed = i;
    EXPECT_FALSE(hybridRansac(scene.adapter(), options).success) << "scene " << i;

    HybridRansacOptions withLeast = options, withMost = options, withInitialPose = options;
    withLeast.minFocalLength = 20;
    withMost.maxFocalLength = 150;
    withInitialPose.initialPose = scene.truth;
    for (const HybridRansacOptions& allowing : {withLeast, withMost, withInitialPose}) {
      const HybridRansacResult result = hybridRansac(scene.adapter(), allowing);
      EXPECT_TRUE(result.success) << "scene " << i;
      EXPECT_NEAR(result.pose.focalLength, 100, 2) << "scene " << i;
    }
  }
}

// Matches in a strip along the image's border say no more of its size than others do.
TEST(FocalLengthBounds, AllowWideFieldsOfViewWhereverImagePointsAre) {
  for (std::uint64_t i = 0; i < 10; ++i) {
    const HybridScene scene = wideScene(i, 260, 430);  // 131 degrees
    HybridRansacOptions options;
    options.seed = i;
    const HybridRansacResult result = hybridRansac(scene.adapter(), options);
    EXPECT_TRUE(result.success) << "scene " << i;
    EXPECT_NEAR(result.pose.focalLength, 260, 10) << "scene " << i;
  }
}

// A few image points far outside say nothing of the image's size.
TEST(FocalLengthBounds, StrayImagePointsAmongFewDecideNothing) {
  for (const int ofEachKind : {8, 12, 20})
    for (const int strays : {1, 2}) {
      int right = 0;
      for (std::uint64_t i = 0; i < 40; ++i) {
        Random random(testSeed() + i, 191);
        HybridScene scene = makeHybridScene(random, withMatches(ofEachKind, 0));
        scene.image2d3d[0] = {20000, 0, 1};
        if (strays > 1) scene.image2d2d[0] = i % 2 == 0 ? Eigen::Vector3d(0, -20000, 1) : Eigen::Vector3d(20000, 0, 1);
        HybridRansacOptions options;
        options.seed = i;
        const HybridRansacResult result = hybridRansac(scene.adapter(), options);
        right += result.success && std::abs(result.pose.focalLength / scene.truth.focalLength - 1) < 0.2;
      }
      EXPECT_GE(right, 36) << ofEachKind << " of each kind, " << strays << " strays";
    }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

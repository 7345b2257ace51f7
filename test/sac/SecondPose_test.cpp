// Data with which two different poses agree.
#include <gtest/gtest.h>

#include "FocalPoseNear.hpp"
#include "HybridScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "robust/Overlap.hpp"

namespace hybridgv {
namespace {

using sac::FailureReason;
using sac::hybridRansac;
using sac::HybridRansacOptions;
using sac::HybridRansacResult;
using test::HybridScene;

constexpr int kScenes = 60;

struct Matches {
  int rays, points;
};

HybridScene makeScene(std::uint64_t seed, std::uint64_t index, const Matches& matches, double outliers) {
  test::Random random(test::testSeed() + seed, index);
  test::SceneOptions options;
  options.rays = matches.rays;
  options.points = matches.points;
  options.imageNoise = 1;
  options.outlierShareRays = options.outlierSharePoints = outliers;
  return test::makeHybridScene(random, options);
}

template <class T>
void append(const std::vector<T>& more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

// One rig that sees both scenes, and a query image whose matches are with either.
struct TwoPlaces {
  TwoPlaces(std::uint64_t index, const Matches& first, const Matches& second, double outliers)
      : here(makeScene(1, index, first, outliers)), there(makeScene(2, index, second, outliers)), all(here) {
    append(there.image2d2d, all.image2d2d);
    append(there.bearings, all.bearings);
    append(there.offsets, all.offsets);
    append(there.rotations, all.rotations);
    append(there.image2d3d, all.image2d3d);
    append(there.points, all.points);
    for (const int camera : there.cameras) all.cameras.push_back(camera + static_cast<int>(here.offsets.size()));
  }
  HybridScene here, there, all;
};

HybridRansacResult localize(const HybridScene& scene, std::uint64_t seed, int threads = 1) {
  HybridRansacOptions options;
  options.seed = seed;
  options.threads = threads;
  return hybridRansac(scene.adapter(), options);
}

bool isNear(const FocalPose& pose, const FocalPose& truth) {
  return static_cast<bool>(test::isFocalPoseNear(pose, truth, 0.1, 2));
}

TEST(SecondPose, TwoPosesThatAreAsGoodAreNoSuccess) {
  int reported = 0;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    const TwoPlaces places(i, {60, 60}, {60, 60}, 0.2);
    const HybridRansacResult result = localize(places.all, i);
    if (!result.secondPose) continue;  // is missed at times
    ++reported;
    const bool isHere = isNear(result.pose, places.here.truth);
    EXPECT_TRUE(isNear(result.pose, isHere ? places.here.truth : places.there.truth)) << "scene " << i;
    EXPECT_TRUE(isNear(*result.secondPose, isHere ? places.there.truth : places.here.truth)) << "scene " << i;
    EXPECT_EQ(result.success, result.secondPoseSupport <= 0.8) << "scene " << i;
    EXPECT_EQ(result.failureReason, result.success ? FailureReason::None : FailureReason::AmbiguousPose) << "scene " << i;
  }
  EXPECT_GE(reported, kScenes * 95 / 100);
}

// Scenes in which the second of two poses that are as good is found and right.
int found(const Matches& first, const Matches& second, double outliers, int scenes, HybridRansacOptions options = {}) {
  int result = 0;
  for (int i = 0; i < scenes; ++i) {
    const TwoPlaces places(300 + static_cast<std::uint64_t>(i), first, second, outliers);
    options.seed = static_cast<std::uint64_t>(i);
    const HybridRansacResult both = hybridRansac(places.all.adapter(), options);
    if (!both.secondPose) continue;
    const bool isHere = isNear(both.pose, places.here.truth);
    result += isNear(*both.secondPose, isHere ? places.there.truth : places.here.truth) ? 1 : 0;
  }
  return result;
}

TEST(SecondPose, IsFoundAmongPointsAlone) { EXPECT_GE(found({0, 100}, {0, 100}, 0.2, 20), 17); }
TEST(SecondPose, IsFoundAmongRaysAlone) { EXPECT_GE(found({100, 0}, {100, 0}, 0, 10), 8); }
TEST(SecondPose, IsFoundAmongFewCorrespondences) { EXPECT_GE(found({12, 12}, {12, 12}, 0, 20), 17); }
TEST(SecondPose, IsFoundAmongThousands) { EXPECT_GE(found({1500, 1500}, {1500, 1500}, 0.2, 4), 3); }
TEST(SecondPose, IsFoundAmongManyWrongMatches) { EXPECT_GE(found({100, 100}, {100, 100}, 0.5, 20), 17); }
// Samples of rays are drawn less often than those of points.
TEST(SecondPose, IsFoundByOtherKindsThanTheFirst) { EXPECT_GE(found({10, 100}, {200, 10}, 0.1, 40), 24); }
TEST(SecondPose, IsFoundWithUnknownDistortion) {
  HybridRansacOptions options;
  options.queryCamera = sac::QueryCamera::Radial;
  EXPECT_GE(found({100, 100}, {100, 100}, 0.2, 20, options), 17);
}

TEST(SecondPose, APlaneHasNone) {
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    test::Random random(test::testSeed() + 4, i);
    test::SceneOptions options;
    options.rays = options.points = 60;
    options.imageNoise = 1;
    options.coplanar = true;
    options.outlierShareRays = options.outlierSharePoints = 0.5;
    EXPECT_FALSE(localize(test::makeHybridScene(random, options), i).secondPose) << "scene " << i;
  }
}

TEST(SecondPose, IsNotLookedForWithoutSamples) {
  const HybridScene scene = makeScene(5, 0, {60, 60}, 0.5);
  HybridRansacOptions options;
  options.initialPose = scene.truth;
  options.timeBudgetSeconds = 1e-9;
  options.successProbability = 1e-300;
  const HybridRansacResult result = hybridRansac(scene.adapter(), options);
  EXPECT_TRUE(result.success);
  EXPECT_FALSE(result.secondPose);
}

TEST(SecondPose, OneWithHalfTheSupportIsReportedBesideASuccess) {
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    const TwoPlaces places(100 + i, {80, 80}, {45, 45}, 0.1);
    const HybridRansacResult result = localize(places.all, i);
    EXPECT_TRUE(result.success) << "scene " << i << ", " << toString(result.failureReason);
    EXPECT_TRUE(isNear(result.pose, places.here.truth)) << "scene " << i;
    if (!result.secondPose) continue;  // is looked for only as long as the best pose
    EXPECT_TRUE(isNear(*result.secondPose, places.there.truth)) << "scene " << i;
    EXPECT_NEAR(result.secondPoseSupport, 45. / 80, 0.15) << "scene " << i;
  }
}

TEST(SecondPose, WrongMatchesHaveNone) {
  for (const double outliers : {0., 0.3, 0.6})
    for (std::uint64_t i = 0; i < kScenes; ++i) {
      const HybridRansacResult result = localize(makeScene(3, i, {60, 60}, outliers), i);
      EXPECT_FALSE(result.secondPose) << outliers << ", scene " << i;
      EXPECT_EQ(result.secondPoseSupport, 0);
    }
}

TEST(SecondPose, DoesNotDependOnTheNumberOfThreads) {
  for (std::uint64_t i = 0; i < 4; ++i) {
    const TwoPlaces places(200 + i, {60, 60}, {60, 60}, 0.3);
    const HybridRansacResult one = localize(places.all, i), three = localize(places.all, i, 3);
    ASSERT_TRUE(one.secondPose && three.secondPose);
    EXPECT_EQ(one.secondPoseSupport, three.secondPoseSupport);
    EXPECT_EQ(one.secondPose->focalLength, three.secondPose->focalLength);
  }
}

TEST(Overlap, CountsBothKinds) {
  const robust::InlierMasks first{{1, 1, 0, 0}, {1, 0}}, second{{1, 0, 1, 1}, {0, 1}};
  const robust::Overlap overlap = robust::overlap(first, second);
  EXPECT_EQ(overlap.both, 1);
  EXPECT_EQ(overlap.onlyFirst, 2);
  EXPECT_EQ(overlap.onlySecond, 3);
  EXPECT_TRUE(robust::areDifferent(overlap));
  EXPECT_FALSE(robust::areDifferent(robust::overlap(first, first)));
  EXPECT_EQ(robust::relativeSupport(overlap), 1.5);
}

}  // namespace
}  // namespace hybridgv

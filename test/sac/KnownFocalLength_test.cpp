// hybridRansac where the focal length is known, exactly or roughly.
#include <gtest/gtest.h>

#include <cmath>

#include "FocalPoseNear.hpp"
#include "HybridScene.hpp"
#include "TrustScenes.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac::hybridRansac;
using sac::HybridRansacOptions;
using sac::HybridRansacResult;

SceneOptions noisy(int rays, int points, double outliers) {
  SceneOptions options;
  options.rays = rays;
  options.points = points;
  options.imageNoise = 1;
  options.outlierShareRays = options.outlierSharePoints = outliers;
  return options;
}

double angleBetween(const FocalPose& a, const FocalPose& b) {
  return Eigen::AngleAxisd(a.rotation.transpose() * b.rotation).angle();
}

HybridRansacResult run(const HybridScene& scene, std::uint64_t seed, double factor = 1) {
  HybridRansacOptions options;
  options.seed = seed;
  options.knownFocalLengthPx = factor * scene.truth.focalLength;
  return hybridRansac(scene.adapter(), options);
}

TEST(KnownFocalLength, IsKeptAndHasNoVariance) {
  Random random(testSeed(), 950);
  for (std::uint64_t i = 0; i < 10; ++i) {
    const HybridScene scene = makeHybridScene(random, noisy(60, 60, 0.4));
    const HybridRansacResult result = run(scene, i);
    ASSERT_TRUE(result.success) << toString(result.failureReason);
    EXPECT_EQ(result.pose.focalLength, scene.truth.focalLength);
    EXPECT_EQ(result.focalLengthStandardDeviation, 0);
    for (std::size_t k = 0; k < 7; ++k) {
      EXPECT_EQ(result.covariance[7 * 6 + k], 0);
      EXPECT_EQ(result.covariance[7 * k + 6], 0);
    }
    EXPECT_GT(result.covariance[0], 0);
    EXPECT_LT(angleBetween(result.pose, scene.truth), 0.02);
    for (const auto& entry : result.iterationsPerSolver) EXPECT_GE(entry.first, Solver::P3P) << toString(entry.first);
  }
}

// Five rays of one camera and one of another are a sample.
TEST(KnownFocalLength, RaysAloneAreEnough) {
  Random random(testSeed(), 957);
  int right = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const HybridScene scene = makeHybridScene(random, noisy(120, 0, 0.2));
    const HybridRansacResult result = run(scene, i);
    right += result.success && angleBetween(result.pose, scene.truth) < 0.02;
  }
  EXPECT_GE(right, 9);
}

TEST(KnownFocalLength, MakesThePoseMoreAccurate) {
  Random random(testSeed(), 951);
  std::vector<double> known, unknown;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const HybridScene scene = makeHybridScene(random, noisy(30, 30, 0.2));
    HybridRansacOptions options;
    options.seed = i;
    known.push_back((run(scene, i).pose.position - scene.truth.position).norm());
    unknown.push_back((hybridRansac(scene.adapter(), options).pose.position - scene.truth.position).norm());
  }
  EXPECT_LT(median(known), 0.7 * median(unknown));
}

TEST(KnownFocalLength, InitialPoseTakesIt) {
  Random random(testSeed(), 952);
  const HybridScene scene = makeHybridScene(random, noisy(60, 60, 0.2));
  HybridRansacOptions options;
  options.knownFocalLengthPx = scene.truth.focalLength;
  options.initialPose = scene.truth;
  options.initialPose->focalLength *= 1.1;
  options.timeBudgetSeconds = 1e-9;
  const HybridRansacResult result = hybridRansac(scene.adapter(), options);
  EXPECT_EQ(result.pose.focalLength, scene.truth.focalLength);
  EXPECT_LT(angleBetween(result.pose, scene.truth), 0.02);
}

TEST(KnownFocalLength, GoesWithUnknownDistortion) {
  Random random(testSeed(), 953);
  const HybridScene scene = makeHybridScene(random, noisy(100, 100, 0.2));
  HybridRansacOptions options;
  options.knownFocalLengthPx = scene.truth.focalLength;
  options.queryCamera = sac::QueryCamera::Radial;
  const HybridRansacResult result = hybridRansac(scene.adapter(), options);
  ASSERT_TRUE(result.success);
  EXPECT_EQ(result.pose.focalLength, scene.truth.focalLength);
  EXPECT_LT(angleBetween(result.pose, scene.truth), 0.02);
}

// How many of 20 scenes show that the given focal length is too long by a factor: in the noise, or in fewer inliers.
int countShown(double factor, std::uint64_t stream) {
  Random random(testSeed(), stream);
  int shown = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const HybridScene scene = makeHybridScene(random, noisy(100, 100, 0.3));
    const HybridRansacResult right = run(scene, i), wrong = run(scene, i, factor);
    const auto inliers = [](const HybridRansacResult& result) { return result.numberInliers2d2d + result.numberInliers2d3d; };
    shown += wrong.noise2d3d > 1.3 * right.noise2d3d || inliers(wrong) < 0.8 * inliers(right);
  }
  return shown;
}

// What is left of the error, the distance takes up: five percent are seen in most scenes, fifteen in all of them.
TEST(KnownFocalLength, WrongOneShowsInNoiseOrInliers) {
  EXPECT_GE(countShown(1.05, 954), 11);
  EXPECT_GE(countShown(1.15, 954), 19);
  EXPECT_EQ(countShown(1, 954), 0);
}

class WithoutPose : public testing::TestWithParam<TrustCase> {};

TEST_P(WithoutPose, IsNoSuccessWithAKnownFocalLength) {
  for (std::uint64_t i = 0; i < 3; ++i) {
    Random random(testSeed() + 9100, i);
    const HybridScene scene = GetParam().make(random);
    const HybridRansacResult result = run(scene, i);
    EXPECT_FALSE(result.success) << "scene " << i << ", inliers: " << result.numberInliers2d2d << " rays, "
                                 << result.numberInliers2d3d << " points";
  }
}

INSTANTIATE_TEST_SUITE_P(Trust, WithoutPose, testing::ValuesIn(casesWithoutPose()),
                         [](const testing::TestParamInfo<TrustCase>& info) { return info.param.name; });

HybridRansacResult runWithPrior(const HybridScene& scene, std::uint64_t seed, double factor, double deviation) {
  HybridRansacOptions options;
  options.seed = seed;
  options.focalLengthPriorPx = factor * scene.truth.focalLength;
  options.focalLengthPriorLogDeviation = deviation;
  return hybridRansac(scene.adapter(), options);
}

TEST(FocalLengthPrior, HelpsWhereMatchesAreFew) {
  Random random(testSeed(), 955);
  int with = 0, without = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const HybridScene scene = makeHybridScene(random, noisy(0, 8, 0));
    HybridRansacOptions options;
    options.seed = i;
    without += hybridRansac(scene.adapter(), options).success;
    with += runWithPrior(scene, i, 1, 0.1).success;
  }
  EXPECT_GE(with, without);
  EXPECT_GT(with, 40);
}

TEST(FocalLengthPrior, WrongOneGivesWay) {
  Random random(testSeed(), 956);
  for (std::uint64_t i = 0; i < 10; ++i) {
    const HybridScene scene = makeHybridScene(random, noisy(60, 60, 0.3));
    const HybridRansacResult result = runWithPrior(scene, i, 2, 0.1);
    ASSERT_TRUE(result.success);
    EXPECT_NEAR(result.pose.focalLength / scene.truth.focalLength, 1, 0.05);
  }
}

HybridScene flatScene(Random& random, double halfSize, int ofEachKind, double outliers) {
  SceneOptions options = noisy(ofEachKind, ofEachKind, outliers);
  options.coplanar = true;
  options.halfSize = halfSize;
  options.imageNoise = 2;
  return makeHybridScene(random, options);
}

constexpr double kRightAngle = 0.17;

// A small flat object looks the same in a second pose (LookAlikes), as far as perspective does not tell.
TEST(KnownFocalLength, AFlatObjectFarAwayIsNoSuccessInTheWrongOfItsTwoPoses) {
  int successes = 0, wrong = 0, ambiguous = 0, oneIsRight = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    Random random(testSeed() + i, 970);
    const HybridScene scene = flatScene(random, i % 2 == 0 ? 1 : 0.5, i % 3 == 0 ? 20 : 60, 0.3);
    const HybridRansacResult result = run(scene, i);
    const bool isRight = angleBetween(result.pose, scene.truth) < kRightAngle;
    successes += result.success;
    wrong += result.success && !isRight;
    if (result.failureReason != sac::FailureReason::AmbiguousPose) continue;
    ++ambiguous;
    ASSERT_TRUE(result.secondPose);
    EXPECT_GT(result.secondPoseSupport, 0.8);
    oneIsRight += isRight || angleBetween(*result.secondPose, scene.truth) < kRightAngle;
  }
  EXPECT_LE(wrong, 3) << "a quarter, if the second pose is not looked for";
  EXPECT_GT(successes, 20);
  EXPECT_GT(ambiguous, 50);
  EXPECT_GT(oneIsRight, 0.85 * ambiguous);
}

TEST(KnownFocalLength, NorIsItIfTheFocalLengthIsKnownRoughly) {
  int successes = 0, wrong = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(testSeed() + i, 973);
    const HybridScene scene = flatScene(random, 1, 60, 0.3);
    HybridRansacOptions options;
    options.seed = i;
    options.focalLengthPriorPx = scene.truth.focalLength;
    options.focalLengthPriorLogDeviation = 0.02;
    const HybridRansacResult result = hybridRansac(scene.adapter(), options);
    successes += result.success;
    wrong += result.success && angleBetween(result.pose, scene.truth) > kRightAngle;
  }
  EXPECT_LE(wrong, 2) << "a tenth, if the second pose is not looked for";
  EXPECT_GT(successes, 40);
}

TEST(KnownFocalLength, AFlatObjectThatFillsTheImageIsASuccess) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    Random random(testSeed() + i, 971);
    const HybridScene scene = flatScene(random, 5, 60, 0.3);
    const HybridRansacResult result = run(scene, i);
    EXPECT_TRUE(result.success) << "scene " << i << ": " << toString(result.failureReason);
    EXPECT_LT(angleBetween(result.pose, scene.truth), kRightAngle) << "scene " << i;
    EXPECT_FALSE(result.secondPose);
  }
}

// Rays alone hold a pose less well than points.
TEST(KnownFocalLength, NorIsItWithRaysAlone) {
  int successes = 0, wrong = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    Random random(testSeed() + i, 975);
    HybridScene scene = flatScene(random, i % 2 == 0 ? 1 : 2, 100, 0);
    scene.removePoints();
    const HybridRansacResult result = run(scene, i);
    successes += result.success;
    wrong += result.success && angleBetween(result.pose, scene.truth) > kRightAngle;
  }
  EXPECT_LE(wrong, 7) << "twice as many or more, if the likelihoods were taken as exact";
  EXPECT_GT(successes, 60);
}

// A hundredth of such an image is less than the noise.
TEST(KnownFocalLength, TheNoiseOfASmallObjectIsFound) {
  std::vector<double> noise, inliers;
  for (std::uint64_t i = 0; i < 60; ++i) {
    Random random(testSeed() + i, 974);
    SceneOptions options = noisy(60, 60, 0);
    options.halfSize = 0.5;
    options.imageNoise = 2;
    const HybridRansacResult result = run(makeHybridScene(random, options), i);
    noise.push_back(result.noise2d2d);
    inliers.push_back(result.numberInliers2d2d);
  }
  EXPECT_NEAR(test::median(noise), 2, 0.3);
  EXPECT_GT(test::median(inliers), 50);
}

TEST(KnownFocalLength, WhichOfTheTwoPosesOfAFlatObjectIsLikelierDoesNotDependOnTheSeed) {
  int others = 0, all = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    Random random(testSeed() + i, 972);
    const HybridScene scene = flatScene(random, 1, 60, 0.3);
    const HybridRansacResult first = run(scene, 0);
    for (std::uint64_t seed = 1; seed < 5; ++seed, ++all) others += angleBetween(run(scene, seed).pose, first.pose) > kRightAngle;
  }
  EXPECT_LE(others, 0.05 * all);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

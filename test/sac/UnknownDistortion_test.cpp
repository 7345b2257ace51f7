// Query images as they are: the lens distortion is estimated with the pose.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "EqualResults.hpp"
#include "WideScene.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac::HybridRansacOptions;
using sac::HybridRansacResult;
using sac::QueryCamera;

HybridRansacOptions radial(std::uint64_t seed) {
  HybridRansacOptions options;
  options.queryCamera = QueryCamera::Radial;
  options.seed = seed;
  return options;
}

NoncentralHybridAdapter adapterOf(const HybridScene& scene) {
  NoncentralHybridAdapter adapter = scene.adapter();
  adapter.setRigFocalLengths(std::vector<double>(scene.offsets.size(), kRigFocalLength));
  return adapter;
}

WideSceneOptions wide(QueryLens lens, double outlierShare = 0.3) {
  WideSceneOptions options;
  options.lens = std::move(lens);
  options.outlierShare = outlierShare;
  return options;
}

double relativeError(double focalLength, const HybridScene& scene) { return std::abs(focalLength / scene.truth.focalLength - 1); }

class SimpleRadialQuery : public testing::TestWithParam<double> {};

TEST_P(SimpleRadialQuery, FocalLengthAndK1AreFound) {
  Random random(testSeed(), 9600);
  const double k1 = GetParam();
  std::vector<double> errors, pinholeErrors, found;
  for (std::uint64_t i = 0; i < 15; ++i) {
    const HybridScene scene = makeWideScene(random, wide(simpleRadialLens(k1)));
    const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), radial(i));
    EXPECT_TRUE(result.success);
    EXPECT_LT((result.pose.rotation - scene.truth.rotation).norm(), 0.01);
    EXPECT_LT(std::abs(result.simpleRadialK1 - k1), 6 * result.simpleRadialK1StandardDeviation + 0.05 * std::abs(k1));
    errors.push_back(relativeError(result.simpleRadialFocalLength, scene));
    found.push_back(result.simpleRadialK1);
    HybridRansacOptions pinhole = radial(i);
    pinhole.queryCamera = QueryCamera::Pinhole;
    pinholeErrors.push_back(relativeError(sac::hybridRansac(adapterOf(scene), pinhole).pose.focalLength, scene));
  }
  EXPECT_LT(median(errors), 0.003);
  EXPECT_LT(median(errors), 0.5 * median(pinholeErrors));
  EXPECT_NEAR(median(found), k1, 0.1 * std::abs(k1));
}

INSTANTIATE_TEST_SUITE_P(Distortion, SimpleRadialQuery, testing::Values(-0.2, -0.05, 0.1),
                         [](const testing::TestParamInfo<double>& info) {
                           return (info.param < 0 ? "Minus" : "Plus") + std::to_string(std::lround(std::abs(1000 * info.param)));
                         });

TEST(UnknownDistortion, WithoutDistortionTheResultIsThatOfAPinholeCamera) {
  Random random(testSeed(), 9601);
  int kept = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const HybridScene scene = makeWideScene(random, wide(simpleRadialLens(0)));
    const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), radial(i));
    ASSERT_TRUE(result.success);
    if (result.distortion != 0) {
      ++kept;
      continue;
    }
    HybridRansacOptions pinhole = radial(i);
    pinhole.queryCamera = QueryCamera::Pinhole;
    const HybridRansacResult expected = sac::hybridRansac(adapterOf(scene), pinhole);
    EXPECT_NEAR(result.pose.focalLength, expected.pose.focalLength, 1e-4 * expected.pose.focalLength);
    EXPECT_EQ(result.simpleRadialFocalLength, result.pose.focalLength);
    EXPECT_EQ(result.simpleRadialK1, 0);
    EXPECT_EQ(result.distortionStandardDeviation, 0);
    EXPECT_EQ(result.simpleRadialK1StandardDeviation, 0);
    EXPECT_EQ(expected.simpleRadialFocalLength, expected.pose.focalLength);
  }
  EXPECT_LE(kept, 3);
}

// A lens of the model: what is estimated is it, and the deviations are those of the errors.
TEST(UnknownDistortion, StandardDeviationsAreThoseOfTheErrors) {
  Random random(testSeed(), 9602);
  const double distortion = -0.15 / (2 * kWideHalfSize * kWideHalfSize);
  std::vector<double> ofFocalLength, ofDistortion;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const HybridScene scene = makeWideScene(random, wide(divisionLens(distortion)));
    const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), radial(i));
    ASSERT_TRUE(result.success);
    ofFocalLength.push_back(std::abs(result.pose.focalLength - scene.truth.focalLength) / result.focalLengthStandardDeviation);
    ofDistortion.push_back(std::abs(result.distortion - distortion) / result.distortionStandardDeviation);
    const double relative = result.focalLengthStandardDeviation / result.pose.focalLength;
    EXPECT_NEAR(std::sqrt(result.covariance[48]), relative, 1e-9);
    const double k1 = result.simpleRadialK1StandardDeviation / std::abs(result.simpleRadialK1);
    EXPECT_NEAR(k1, result.distortionStandardDeviation / std::abs(result.distortion), 3 * relative + 0.2 * k1);
  }
  EXPECT_GT(median(ofFocalLength), 0.4);
  EXPECT_LT(median(ofFocalLength), 1);
  EXPECT_GT(median(ofDistortion), 0.4);
  EXPECT_LT(median(ofDistortion), 1);
}

TEST(UnknownDistortion, StrongDistortionIsFoundWithThresholdsBelowIt) {
  Random random(testSeed(), 9603);
  int right = 0, rightWithoutLens = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    WideSceneOptions lens = wide(divisionLens(-0.4 / (2 * kWideHalfSize * kWideHalfSize)), 0.5);
    lens.imageNoise = 0.5;
    const HybridScene scene = makeWideScene(random, lens);
    HybridRansacOptions options = radial(i);
    options.maxReprojectionErrorPx = 3;
    options.maxEpipolarErrorPx = 1.5;
    const auto isRight = [&] {
      const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), options);
      return result.success && relativeError(result.pose.focalLength, scene) < 0.02;
    };
    right += isRight();
    options.queryCamera = QueryCamera::Pinhole;
    rightWithoutLens += isRight();
  }
  EXPECT_EQ(right, 10);
  EXPECT_LE(rightWithoutLens, 5);
}

TEST(UnknownDistortion, EqualSeedsGiveEqualBitsForAnyNumberOfThreads) {
  Random random(testSeed(), 9604);
  for (std::uint64_t i = 0; i < 4; ++i) {
    const HybridScene scene = makeWideScene(random, wide(simpleRadialLens(-0.1), 0.6));
    HybridRansacOptions options = radial(i);
    const HybridRansacResult expected = sac::hybridRansac(adapterOf(scene), options);
    for (const int threads : {2, 5}) {
      options.threads = threads;
      expectEqual(sac::hybridRansac(adapterOf(scene), options), expected);
    }
  }
}

TEST(UnknownDistortion, InliersAreThoseOfTheDistortedImage) {
  Random random(testSeed(), 9605);
  const HybridScene scene = makeWideScene(random, wide(divisionLens(-0.2 / (2 * kWideHalfSize * kWideHalfSize))));
  HybridRansacOptions options = radial(0);
  options.maxReprojectionErrorPx = 12;
  options.maxEpipolarErrorPx = 6;
  const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), options);
  const NoncentralHybridAdapter adapter = adapterOf(scene);
  int points = 0, rays = 0;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (result.inliers2d3d[i] == 0) continue;
    ++points;
    EXPECT_LT(hybrid_pose::reprojectionError(result.pose, result.distortion, adapter.getImagePoint2d3d(i), adapter.getPoint(i)),
              12);
  }
  for (std::size_t i = 0; i < scene.bearings.size(); ++i) {
    if (result.inliers2d2d[i] == 0) continue;
    ++rays;
    EXPECT_LT(hybrid_pose::sampsonError(result.pose, result.distortion, adapter.getImagePoint2d2d(i), adapter.getBearingVector(i),
                                        adapter.getCamOffset(i), adapter.getCamRotation(i), adapter.getRigFocalLength(i)),
              options.maxEpipolarErrorPx);
  }
  EXPECT_GE(points, 60);
  EXPECT_GE(rays, 60);
}

TEST(UnknownDistortion, IsAlwaysKeptIfNoEvidenceIsNeeded) {
  Random random(testSeed(), 9606);
  WideSceneOptions few = wide(simpleRadialLens(-0.1), 0);
  few.rays = few.points = 12;
  for (std::uint64_t i = 0; i < 10; ++i) {
    HybridRansacOptions options = radial(i);
    options.distortionEvidence = -std::numeric_limits<double>::infinity();
    const HybridRansacResult result = sac::hybridRansac(adapterOf(makeWideScene(random, few)), options);
    EXPECT_NE(result.distortion, 0);
    EXPECT_GT(result.distortionStandardDeviation, 0);
  }
}

TEST(UnknownDistortion, DrawsFourTimesAsManySamplesAtLeast) {
  Random random(testSeed(), 9620);
  const HybridScene scene = makeWideScene(random, wide(simpleRadialLens(0), 0));
  HybridRansacOptions options = radial(1);
  options.minIterations = 30;
  EXPECT_EQ(sac::hybridRansac(adapterOf(scene), options).iterations, 120);
  options.maxIterations = 100;
  EXPECT_EQ(sac::hybridRansac(adapterOf(scene), options).iterations, 100);
}

// What is given in its units changes the prior a little; the estimate is one in pixels.
TEST(UnknownDistortion, HardlyDependsOnTheImagesRadius) {
  Random random(testSeed(), 9607);
  for (std::uint64_t i = 0; i < 5; ++i) {
    const HybridScene scene = makeWideScene(random, wide(simpleRadialLens(-0.1)));
    HybridRansacOptions options = radial(i);
    const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), options);
    options.imageRadiusPx = 1.3 * kWideHalfSize * std::sqrt(2.);
    const HybridRansacResult larger = sac::hybridRansac(adapterOf(scene), options);
    EXPECT_NEAR(larger.distortion, result.distortion, 0.3 * result.distortionStandardDeviation);
    EXPECT_NEAR(larger.pose.focalLength, result.pose.focalLength, 0.3 * result.focalLengthStandardDeviation);
  }
}

TEST(UnknownDistortion, IsFoundWithAKnownFocalLength) {
  Random random(testSeed(), 9612);
  const double distortion = -0.15 / (2 * kWideHalfSize * kWideHalfSize);
  for (std::uint64_t i = 0; i < 5; ++i) {
    const HybridScene scene = makeWideScene(random, wide(divisionLens(distortion)));
    HybridRansacOptions options = radial(i);
    options.knownFocalLengthPx = scene.truth.focalLength;
    const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), options);
    EXPECT_TRUE(result.success);
    EXPECT_EQ(result.pose.focalLength, scene.truth.focalLength);
    EXPECT_EQ(result.focalLengthStandardDeviation, 0);
    EXPECT_NEAR(result.distortion, distortion, 6 * result.distortionStandardDeviation);
    EXPECT_GT(result.simpleRadialK1StandardDeviation, 0);
    EXPECT_LT(result.simpleRadialK1StandardDeviation, 0.05 * std::abs(result.simpleRadialK1));
    EXPECT_LT((result.pose.rotation - scene.truth.rotation).norm(), 0.01);
  }
}

TEST(UnknownDistortion, AStrayImagePointDoesNoHarm) {
  Random random(testSeed(), 9608);
  HybridScene scene = makeWideScene(random, wide(simpleRadialLens(-0.15)));
  scene.image2d3d[0] = {1e5, -1e5, 1};
  scene.image2d2d[0] = {-3e5, 1e5, 1};
  const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), radial(0));
  EXPECT_TRUE(result.success);
  EXPECT_NEAR(result.simpleRadialK1, -0.15, 0.03);
  EXPECT_LT(relativeError(result.simpleRadialFocalLength, scene), 0.01);
}

TEST(UnknownDistortion, ImagePointsAtTheCentreSayNothing) {
  Random random(testSeed(), 9609);
  HybridScene scene = makeWideScene(random, wide(simpleRadialLens(0)));
  for (auto* image : {&scene.image2d2d, &scene.image2d3d}) std::fill(image->begin(), image->end(), Eigen::Vector3d(0, 0, 1));
  const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), radial(0));
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.distortion, 0);
}

TEST(UnknownDistortion, OutliersAloneGiveNoSuccess) {
  Random random(testSeed(), 9610);
  for (std::uint64_t i = 0; i < 5; ++i) {
    HybridRansacOptions options = radial(i);
    options.maxIterations = 2000;
    EXPECT_FALSE(sac::hybridRansac(adapterOf(makeWideScene(random, wide(simpleRadialLens(0), 1))), options).success);
  }
}

TEST(UnknownDistortion, EveryChoiceOfOptimizationGivesAPoseAndTheFocalLengthAmongTheBounds) {
  Random random(testSeed(), 9611);
  const HybridScene scene = makeWideScene(random, wide(simpleRadialLens(-0.1), 0.2));
  for (const bool local : {false, true})
    for (const bool atEnd : {false, true}) {
      HybridRansacOptions options = radial(1);
      options.localOptimization = local;
      options.finalOptimization = atEnd;
      options.maxFocalLength = 1.1 * scene.truth.focalLength;
      if (local) options.initialPose = scene.truth;
      const HybridRansacResult result = sac::hybridRansac(adapterOf(scene), options);
      EXPECT_LE(result.pose.focalLength, options.maxFocalLength);
      EXPECT_TRUE(std::isfinite(result.distortion));
      EXPECT_LT(relativeError(result.pose.focalLength, scene), local || atEnd ? 0.02 : 0.3);
    }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

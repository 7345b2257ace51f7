#include "hybridgv/sac/HybridRansac.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "EqualResults.hpp"
#include "FocalPoseNear.hpp"
#include "HybridScene.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace {

using sac::FailureReason;
using sac::hybridRansac;
using sac::HybridRansacOptions;
using sac::HybridRansacResult;
using sac::StopReason;
using test::HybridScene;
using test::SceneOptions;

SceneOptions noisy(int rays, int points, double outliers) {
  SceneOptions options;
  options.rays = rays;
  options.points = points;
  options.imageNoise = 1;
  options.outlierShareRays = options.outlierSharePoints = outliers;
  return options;
}

HybridRansacOptions thresholds() {
  HybridRansacOptions options;
  options.maxReprojectionErrorPx = 6;
  options.maxEpipolarErrorPx = 4;
  return options;
}

// Near the truth, at distance 15 to 25 from the scene's middle; how near depends on the noise.
testing::AssertionResult isRight(const FocalPose& pose, const FocalPose& truth) {
  return test::isFocalPoseNear(pose, truth, 0.1, 2);
}

int sum(const std::vector<char>& mask) { return std::accumulate(mask.begin(), mask.end(), 0); }

// About the width of the image, see hybridRansac.
double focalLengthOfUnknownMapImages(const HybridScene& scene) {
  std::vector<double> coordinates;
  for (const auto* image : {&scene.image2d2d, &scene.image2d3d})
    for (const Eigen::Vector3d& x : *image) coordinates.push_back(std::max(std::abs(x[0]), std::abs(x[1])));
  std::sort(coordinates.begin(), coordinates.end());
  return coordinates.empty() ? 1 : 2 * coordinates[static_cast<std::size_t>(0.95 * static_cast<double>(coordinates.size()))];
}

// Errors of inliers and of others.
class Limit {
 public:
  void add(double error, bool isInlier) { (isInlier ? inliers_ : others_).push_back(error); }
  // The inliers are below the bound (if there is one), and the others above all inliers, but for a few that were refused.
  void expectBelow(double bound, int refused) const {
    const double largest = inliers_.empty() ? 0 : *std::max_element(inliers_.begin(), inliers_.end());
    if (bound > 0) {
      EXPECT_LT(largest, bound);
    }
    EXPECT_LE(std::count_if(others_.begin(), others_.end(), [&](double e) { return e < largest; }), refused);
  }

 private:
  std::vector<double> inliers_, others_;
};

// What every result must hold, whatever the data.
void expectSound(const HybridRansacResult& result, const HybridScene& scene, const HybridRansacOptions& options) {
  ASSERT_EQ(result.inliers2d2d.size(), scene.bearings.size());
  ASSERT_EQ(result.inliers2d3d.size(), scene.points.size());
  EXPECT_EQ(result.success, result.failureReason == FailureReason::None);
  EXPECT_TRUE(result.pose.rotation.allFinite() && result.pose.position.allFinite() && result.pose.focalLength > 0);
  EXPECT_LT((result.pose.rotation.transpose() * result.pose.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_EQ(sum(result.inliers2d2d), result.numberInliers2d2d);
  EXPECT_EQ(sum(result.inliers2d3d), result.numberInliers2d3d);
  if (!(result.score > 0)) return;
  const NoncentralHybridAdapter adapter = scene.adapter();
  const double rigFocalLength = focalLengthOfUnknownMapImages(scene);
  Limit ofPoints, ofRays;
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    ofPoints.add(hybrid_pose::reprojectionError(result.pose, adapter.getImagePoint2d3d(i), adapter.getPoint(i)),
                 result.inliers2d3d[i] != 0);
  ofPoints.expectBelow(options.maxReprojectionErrorPx, 0);
  for (std::size_t i = 0; i < scene.bearings.size(); ++i) {
    const double error = hybrid_pose::sampsonError(result.pose, adapter.getImagePoint2d2d(i), adapter.getBearingVector(i),
                                                   adapter.getCamOffset(i), adapter.getCamRotation(i), rigFocalLength);
    ofRays.add(error, result.inliers2d2d[i] != 0);
  }
  // Levers that the other correspondences do not predict are refused; a wrong pose may have many of them.
  ofRays.expectBelow(options.maxEpipolarErrorPx, result.success ? 3 : static_cast<int>(scene.bearings.size()));
}

// Runs `count` scenes and returns the number of right poses; each result is sound and none is wrong but called a success.
int countRight(const SceneOptions& sceneOptions, HybridRansacOptions options, int count, std::uint64_t stream,
               const std::function<void(HybridScene&)>& change = {}) {
  test::Random random(test::testSeed(), stream);
  int right = 0;
  for (int i = 0; i < count; ++i) {
    HybridScene scene = test::makeHybridScene(random, sceneOptions);
    if (change) change(scene);
    options.seed = static_cast<std::uint64_t>(i);
    const HybridRansacResult result = hybridRansac(scene.adapter(), options);
    expectSound(result, scene, options);
    if (!result.success) continue;
    const testing::AssertionResult isCorrect = isRight(result.pose, scene.truth);
    right += isCorrect;
    EXPECT_TRUE(isCorrect) << "scene " << i << ": a wrong pose is called a success, " << result.numberInliers2d2d << " + "
                           << result.numberInliers2d3d << " inliers";
  }
  return right;
}

TEST(HybridRansac, FindsThePoseAtEveryShareOfOutliers) {
  for (const double outliers : {0., 0.3, 0.5, 0.7})
    EXPECT_EQ(countRight(noisy(100, 100, outliers), thresholds(), 10, 70), 10) << outliers;
}

TEST(HybridRansac, MasksAreTheTrueInliers) {
  test::Random random(test::testSeed(), 71);
  const HybridScene scene = test::makeHybridScene(random, noisy(200, 200, 0.4));
  const HybridRansacResult result = hybridRansac(scene.adapter(), thresholds());
  int different = 0;
  for (std::size_t i = 0; i < 200; ++i)
    different += (result.inliers2d2d[i] != scene.inliers2d2d[i]) + (result.inliers2d3d[i] != scene.inliers2d3d[i]);
  EXPECT_LE(different, 12) << "some outliers match by chance";
}

TEST(HybridRansac, NoisyPointsAreOutweighedByExactRays) {
  SceneOptions sceneOptions = noisy(150, 150, 0.3);
  sceneOptions.pointNoise = 0.4;
  HybridRansacOptions options = thresholds();
  options.maxReprojectionErrorPx = 60;
  EXPECT_GE(countRight(sceneOptions, options, 15, 72), 14);
}

// ---- one kind is bad or absent ----

TEST(HybridRansac, AllRaysOutliers) {
  SceneOptions scene = noisy(150, 150, 0.3);
  scene.outlierShareRays = 1;
  EXPECT_EQ(countRight(scene, thresholds(), 10, 73), 10);
}

TEST(HybridRansac, OutlierRaysCostNeitherAccuracyNorManySamples) {
  SceneOptions sceneOptions = noisy(150, 150, 0.4);
  sceneOptions.outlierShareRays = 1;
  std::vector<double> hybridErrors, pointErrors;
  double hybridSamples = 0, pointSamples = 0;
  test::Random random(test::testSeed(), 95);
  for (int i = 0; i < 25; ++i) {
    const HybridScene scene = test::makeHybridScene(random, sceneOptions);
    const NoncentralHybridAdapter pointsOnly({}, {}, {}, {}, {}, scene.image2d3d, scene.points);
    const HybridRansacResult hybrid = hybridRansac(scene.adapter(), thresholds()),
                             points = hybridRansac(pointsOnly, thresholds());
    EXPECT_TRUE(hybrid.success && points.success);
    hybridErrors.push_back(std::abs(hybrid.pose.focalLength / scene.truth.focalLength - 1));
    pointErrors.push_back(std::abs(points.pose.focalLength / scene.truth.focalLength - 1));
    hybridSamples += hybrid.iterations;
    pointSamples += points.iterations;
  }
  EXPECT_LT(test::median(hybridErrors), 1.1 * test::median(pointErrors));
  EXPECT_LT(hybridSamples, 1.5 * pointSamples);
}

TEST(HybridRansac, AllPointsOutliersGiveNoWrongSuccess) {
  SceneOptions scene = noisy(150, 150, 0.2);
  scene.outlierSharePoints = 1;
  HybridRansacOptions options = thresholds();
  options.maxIterations = 3000;
  EXPECT_GE(countRight(scene, options, 6, 74), 4) << "the rays determine the pose";
}

TEST(HybridRansac, AllOutliersGiveNoSuccess) {
  HybridRansacOptions options = thresholds();
  options.maxIterations = 500;
  EXPECT_EQ(countRight(noisy(150, 150, 1), options, 10, 75), 0);
}

TEST(HybridRansac, NoRays) { EXPECT_EQ(countRight(noisy(0, 80, 0.3), thresholds(), 10, 76), 10); }

TEST(HybridRansac, SixRaysAreTooFew) {
  test::Random random(test::testSeed(), 77);
  const HybridScene scene = test::makeHybridScene(random, noisy(6, 0, 0));
  const HybridRansacResult result = hybridRansac(scene.adapter());
  EXPECT_EQ(result.failureReason, FailureReason::TooFewCorrespondences);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.inliers2d2d.size(), 6u);
}

TEST(HybridRansac, RaysAloneFixThePose) {
  for (const double outliers : {0.0, 0.3, 0.5})
    EXPECT_GE(countRight(noisy(200, 0, outliers), thresholds(), 10, 84), 9) << outliers;
}

TEST(HybridRansac, RaysAloneOfManyCamerasWithFewEach) {
  SceneOptions scene = noisy(200, 0, 0.1);
  scene.cameras = 50;
  EXPECT_GE(countRight(scene, thresholds(), 4, 85), 4);
}

TEST(HybridRansac, RaysAloneOfAFacade) {
  SceneOptions scene = noisy(200, 0, 0.2);
  scene.coplanar = true;
  EXPECT_GE(countRight(scene, thresholds(), 6, 86), 5);
}

TEST(HybridRansac, FewBadPointsDoNotSpoilManyRays) {
  SceneOptions scene = noisy(200, 8, 0.3);
  scene.outlierSharePoints = 1;
  EXPECT_GE(countRight(scene, thresholds(), 6, 87), 5);
}

TEST(HybridRansac, WrongRaysAloneGiveNoSuccess) {
  HybridRansacOptions options = thresholds();
  options.maxIterations = 1000;
  for (const int rays : {10, 60, 400}) EXPECT_EQ(countRight(noisy(rays, 0, 1), options, 8, 88), 0) << rays;
}

// The distance from that camera is open.
TEST(HybridRansac, RaysOfOneCameraAloneHaveNoScale) {
  test::Random random(test::testSeed(), 89);
  SceneOptions options = noisy(80, 0, 0.2);
  options.cameras = 1;
  const HybridScene scene = test::makeHybridScene(random, options);
  const HybridRansacResult result = hybridRansac(scene.adapter());
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.failureReason, FailureReason::UndeterminedPose);
  EXPECT_EQ(result.iterations, 0);
}

TEST(HybridRansac, ThreePointsAndManyRays) {
  SceneOptions scene = noisy(120, 3, 0);
  scene.outlierShareRays = 0.3;
  EXPECT_EQ(countRight(scene, thresholds(), 10, 78), 10);
}

TEST(HybridRansac, ThreeRaysAndManyPoints) {
  SceneOptions scene = noisy(3, 120, 0);
  scene.outlierSharePoints = 0.3;
  EXPECT_EQ(countRight(scene, thresholds(), 10, 79), 10);
}

TEST(HybridRansac, NothingAtAll) {
  const NoncentralHybridAdapter adapter({}, {}, {}, {}, {}, {}, {});
  EXPECT_EQ(hybridRansac(adapter).failureReason, FailureReason::TooFewCorrespondences);
}

TEST(HybridRansac, FourPointsAloneProveNothing) {
  test::Random random(test::testSeed(), 80);
  const HybridScene scene = test::makeHybridScene(random, noisy(0, 4, 0));
  HybridRansacOptions options = thresholds();
  options.maxIterations = 50;
  const HybridRansacResult result = hybridRansac(scene.adapter(), options);
  EXPECT_EQ(result.failureReason, FailureReason::InliersMayBeChance);
  EXPECT_GT(result.score, 0) << "a pose is given nevertheless";
}

// ---- degenerate geometry ----

TEST(HybridRansac, AllPointsCoplanar) {
  SceneOptions scene = noisy(100, 100, 0.3);
  scene.coplanar = true;
  EXPECT_GE(countRight(scene, thresholds(), 12, 81), 11);
}

TEST(HybridRansac, AllRaysFromOneCamera) {
  SceneOptions scene = noisy(100, 100, 0.3);
  scene.cameras = 1;
  EXPECT_EQ(countRight(scene, thresholds(), 10, 82), 10);
}

// The relative pose is found, but not the distance: nothing but chance fixes it.
TEST(HybridRansac, RaysFromOneCameraAndOutlierPointsAreNoSuccess) {
  SceneOptions scene = noisy(150, 100, 0.1);
  scene.cameras = 1;
  scene.outlierSharePoints = 1;
  HybridRansacOptions options = thresholds();
  options.maxIterations = 500;
  EXPECT_EQ(countRight(scene, options, 6, 83), 0);
}

TEST(HybridRansac, IdenticalPointsAndCollinearPointsEndWithoutSuccess) {
  HybridRansacOptions options = thresholds();
  options.maxIterations = 300;
  EXPECT_EQ(countRight(noisy(0, 40, 0), options, 3, 84,
                       [](HybridScene& scene) {
                         for (auto& point : scene.points) point = scene.points[0];
                       }),
            0);
  countRight(noisy(0, 40, 0), options, 3, 85, [](HybridScene& scene) {
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      scene.points[i] = Eigen::Vector3d(0.1, 0.05, -0.02) * (static_cast<double>(i) - 20);
      scene.image2d3d[i] = test::project(scene.truth, scene.points[i]).homogeneous();
    }
  });
}

// ---- hard data ----

// A pose is found, if at all, by one of 30 000 samples.
TEST(HybridRansac, NinetySevenPercentOutliersEndWithinTheTimeBudget) {
  test::Random random(test::testSeed(), 86);
  const HybridScene scene = test::makeHybridScene(random, noisy(400, 400, 0.97));
  HybridRansacOptions options = thresholds();
  options.maxIterations = 1 << 30;
  options.timeBudgetSeconds = 0.05;
  const HybridRansacResult result = hybridRansac(scene.adapter(), options);
  expectSound(result, scene, options);
  EXPECT_TRUE(!result.success || isRight(result.pose, scene.truth));
  EXPECT_EQ(result.stopReason, StopReason::TimeBudget);
  EXPECT_LT(result.iterations, 1 << 30);
}

TEST(HybridRansac, SceneFarFromTheOriginAndOfAnyScale) {
  SceneOptions options = noisy(100, 100, 0.3);
  test::Random random(test::testSeed(), 87);
  for (const double scale : {1e-3, 1e3}) {
    options.scale = scale;
    options.origin = scale * Eigen::Vector3d(5e4, -4e5, 300);
    const HybridScene scene = test::makeHybridScene(random, options);
    const HybridRansacResult result = hybridRansac(scene.adapter(), thresholds());
    EXPECT_TRUE(result.success);
    EXPECT_TRUE(test::isFocalPoseNear(result.pose, scene.truth, 0.1, 2 * scale));
  }
}

// ---- options ----

TEST(HybridRansac, EqualSeedsGiveEqualBitsForAnyNumberOfThreads) {
  test::Random random(test::testSeed(), 88);
  const HybridScene scene = test::makeHybridScene(random, noisy(150, 150, 0.6));
  const NoncentralHybridAdapter adapter = scene.adapter();
  HybridRansacOptions options = thresholds();
  options.seed = 5;
  const HybridRansacResult one = hybridRansac(adapter, options);
  test::expectEqual(one, hybridRansac(adapter, options));
  for (const int threads : {0, 2, 3, 8, std::numeric_limits<int>::max()}) {
    options.threads = threads;
    test::expectEqual(one, hybridRansac(adapter, options));
  }
  options.seed = 6;
  EXPECT_NE(hybridRansac(adapter, options).iterationsPerSolver, one.iterationsPerSolver);
}

TEST(HybridRansac, ThreadsThatShareManyCorrespondencesGiveEqualBits) {
  test::Random random(test::testSeed(), 188);
  const HybridScene scene = test::makeHybridScene(random, noisy(6001, 4999, 0.3));
  const NoncentralHybridAdapter adapter = scene.adapter();
  for (const bool isKnown : {false, true}) {
    HybridRansacOptions options;
    if (isKnown) options.knownFocalLengthPx = scene.truth.focalLength;
    const HybridRansacResult one = hybridRansac(adapter, options);
    EXPECT_TRUE(one.success);
    for (const int threads : {2, 5}) {
      options.threads = threads;
      test::expectEqual(one, hybridRansac(adapter, options));
    }
  }
}

// 60 right rays tell their noise. A bound that is twice as wide must not make them count less because the points are noisier: the
// results differ by a small part of their deviation.
TEST(HybridRansac, AWiderBoundDoesNotChangeWhatRaysCount) {
  std::vector<double> differences;
  for (std::uint64_t i = 0; i < 60; ++i) {
    test::Random random(test::testSeed() + 9600, i);
    test::SceneOptions scene = noisy(200, 200, 0.7);
    scene.imageNoise = 2;
    scene.pointNoise = 0.2;  // some 12 px
    const NoncentralHybridAdapter adapter = test::makeHybridScene(random, scene).adapter();
    HybridRansacOptions options;
    options.seed = i;
    const HybridRansacResult wide = hybridRansac(adapter, options);
    options.maxEpipolarErrorPx = 6;
    const HybridRansacResult narrow = hybridRansac(adapter, options);
    ASSERT_TRUE(wide.success && narrow.success) << i;
    differences.push_back(std::abs(wide.pose.focalLength - narrow.pose.focalLength) / narrow.focalLengthStandardDeviation);
  }
  EXPECT_LT(test::median(differences), 0.1);
}

TEST(HybridRansac, OnlyTheGivenSolversAreDrawn) {
  test::Random random(test::testSeed(), 89);
  const HybridScene scene = test::makeHybridScene(random, noisy(100, 100, 0.2));
  for (const Solver solver : allSolvers()) {
    HybridRansacOptions options = thresholds();
    options.solvers = {{solver, 1}};
    if (solver == Solver::H22 || solver == Solver::H41 || solver == Solver::H60)
      options.focalLengthPriorPx = scene.truth.focalLength;
    const HybridRansacResult result = hybridRansac(scene.adapter(), options);
    EXPECT_TRUE(result.success);
    EXPECT_TRUE(isRight(result.pose, scene.truth)) << toString(solver);
    EXPECT_EQ(result.solver, solver);
    ASSERT_EQ(result.iterationsPerSolver.size(), 1u);
    EXPECT_EQ(result.iterationsPerSolver.at(solver), result.iterations);
  }
}

TEST(HybridRansac, EveryChoiceOfScoringAndOptimizationFindsThePose) {
  test::Random random(test::testSeed(), 90);
  const HybridScene scene = test::makeHybridScene(random, noisy(150, 150, 0.3));
  for (const auto scoring : {sac::Scoring::Msac, sac::Scoring::InlierCount})
    for (const bool local : {false, true})
      for (const bool final : {false, true}) {
        HybridRansacOptions options = thresholds();
        options.minIterations = 300;  // without optimization the best of many samples is wanted
        options.scoring = scoring;
        options.localOptimization = local;
        options.finalOptimization = final;
        const HybridRansacResult result = hybridRansac(scene.adapter(), options);
        expectSound(result, scene, options);
        EXPECT_TRUE(result.success);
        EXPECT_TRUE(test::isFocalPoseNear(result.pose, scene.truth, local || final ? 0.1 : 0.5));
        EXPECT_EQ(result.localOptimizations > 0, local);
      }
}

TEST(HybridRansac, InitialPoseIsUsedIfItIsGoodAndDoesNoHarmIfNot) {
  test::Random random(test::testSeed(), 91);
  const HybridScene scene = test::makeHybridScene(random, noisy(100, 100, 0.6));
  HybridRansacOptions options = thresholds();
  options.initialPose = scene.truth;
  options.maxIterations = 1;
  const HybridRansacResult good = hybridRansac(scene.adapter(), options);
  EXPECT_TRUE(good.success);
  EXPECT_TRUE(isRight(good.pose, scene.truth));
  options.solvers.clear();
  const HybridRansacResult alone = hybridRansac(scene.adapter(), options);
  EXPECT_TRUE(alone.success);
  EXPECT_TRUE(isRight(alone.pose, scene.truth)) << "an initial pose alone will do";
  EXPECT_FALSE(alone.solver.has_value());
  options = thresholds();
  options.initialPose = FocalPose{};
  const HybridRansacResult bad = hybridRansac(scene.adapter(), options);
  EXPECT_TRUE(bad.success);
  EXPECT_TRUE(isRight(bad.pose, scene.truth));
}

// Good correspondences first: far fewer samples than uniform sampling, with the same result.
TEST(HybridRansac, QualityOrderSpeedsUpTheSearch) {
  test::Random random(test::testSeed(), 93);
  HybridScene scene = test::makeHybridScene(random, noisy(400, 400, 0.9));
  NoncentralHybridAdapter adapter = scene.adapter();
  std::vector<double> weights2d2d, weights2d3d;
  for (const char inlier : scene.inliers2d2d) weights2d2d.push_back(inlier + random.uniform(0, 0.9));
  for (const char inlier : scene.inliers2d3d) weights2d3d.push_back(inlier + random.uniform(0, 0.9));
  adapter.setWeights(weights2d2d, weights2d3d);
  HybridRansacOptions options = thresholds();
  options.maxIterations = 200;
  const HybridRansacResult ordered = hybridRansac(adapter, options);
  EXPECT_TRUE(ordered.success);
  EXPECT_TRUE(isRight(ordered.pose, scene.truth));
  options.sampling = sac::Sampling::Uniform;
  EXPECT_FALSE(isRight(hybridRansac(adapter, options).pose, scene.truth));
}

// The squared error of the focal length, measured in the stated variance, has mean 1 (a little more: noise is estimated).
TEST(HybridRansac, StandardDeviationOfTheFocalLengthIsThatOfItsErrors) {
  test::Random random(test::testSeed(), 94);
  double squares = 0;
  const int count = 150;
  for (int i = 0; i < count; ++i) {
    const HybridScene scene = test::makeHybridScene(random, noisy(100, 100, 0.2));
    const HybridRansacResult result = hybridRansac(scene.adapter(), thresholds());
    squares += std::pow((result.pose.focalLength - scene.truth.focalLength) / result.focalLengthStandardDeviation, 2);
    EXPECT_NEAR(result.focalLengthStandardDeviation, result.pose.focalLength * std::sqrt(result.covariance[48]), 1e-9);
  }
  EXPECT_GT(squares / count, 0.5);
  EXPECT_LT(squares / count, 2.5);
}

// The search looks at a part of them, the result at all.
TEST(HybridRansac, ManyCorrespondencesAreAllUsed) {
  test::Random random(test::testSeed(), 79);
  double squares = 0;
  constexpr int kCount = 12;
  for (int i = 0; i < kCount; ++i) {
    const HybridScene scene = test::makeHybridScene(random, noisy(6000, 4000, 0.4));
    HybridRansacOptions options;
    options.seed = static_cast<std::uint64_t>(i);
    const HybridRansacResult result = hybridRansac(scene.adapter(), options);
    ASSERT_TRUE(result.success);
    expectSound(result, scene, options);
    EXPECT_GT(result.numberInliers2d2d, 3500);
    EXPECT_GT(result.numberInliers2d3d, 2300);
    EXPECT_LT(result.focalLengthStandardDeviation, 0.002 * scene.truth.focalLength) << "that of a part is about 0.003";
    squares += std::pow((result.pose.focalLength - scene.truth.focalLength) / result.focalLengthStandardDeviation, 2);
    options.threads = 3;
    EXPECT_EQ(hybridRansac(scene.adapter(), options).pose.focalLength, result.pose.focalLength);
  }
  EXPECT_LT(squares / kCount, 2.5);
}

// Without points the scale hangs on the cameras with few rays.
TEST(HybridRansac, FewRaysOfACameraDoNotGetLostAmongMany) {
  test::Random random(test::testSeed(), 80);
  for (std::uint64_t i = 0; i < 5; ++i) {
    SceneOptions sceneOptions = noisy(30000, 0, 0.2);
    HybridScene scene = test::makeHybridScene(random, sceneOptions), uneven = scene;
    uneven.image2d2d.clear();
    uneven.bearings.clear();
    uneven.cameras.clear();
    std::vector<int> count(scene.offsets.size(), 0);
    for (std::size_t k = 0; k < scene.cameras.size(); ++k) {
      int& ofCamera = count[static_cast<std::size_t>(scene.cameras[k])];
      if (scene.cameras[k] != 0 && ofCamera >= 30) continue;
      ++ofCamera;
      uneven.image2d2d.push_back(scene.image2d2d[k]);
      uneven.bearings.push_back(scene.bearings[k]);
      uneven.cameras.push_back(scene.cameras[k]);
    }
    HybridRansacOptions options;
    options.seed = i;
    const HybridRansacResult result = hybridRansac(uneven.adapter(), options);
    EXPECT_TRUE(result.success) << toString(result.failureReason);
    EXPECT_TRUE(isRight(result.pose, scene.truth));
  }
}

TEST(HybridRansac, WrongOptionsAreRefused) {
  const NoncentralHybridAdapter adapter({}, {}, {}, {}, {}, {}, {});
  const std::vector<std::function<void(HybridRansacOptions&)>> mistakes = {
      [](auto& o) { o.maxReprojectionErrorPx = -1; },
      [](auto& o) { o.maxEpipolarErrorPx = NAN; },
      [](auto& o) { o.successProbability = 1; },
      [](auto& o) { o.maxIterations = 0; },
      [](auto& o) { o.minIterations = -1; },
      [](auto& o) { o.timeBudgetSeconds = 0; },
      [](auto& o) { o.minFocalLength = -1; },
      [](auto& o) { o.minFocalLength = 100, o.maxFocalLength = 50; },
      [](auto& o) { o.threads = -1; },
      [](auto& o) { o.solvers.clear(); },
      [](auto& o) { o.solvers[0].prior = 0; },
      [](auto& o) { o.solvers.push_back(o.solvers[0]); },
      [](auto& o) { o.initialPose = FocalPose{}, o.initialPose->focalLength = 0; },
      [](auto& o) { o.initialPose = FocalPose{}, o.initialPose->rotation *= 2; },
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    HybridRansacOptions options;
    EXPECT_NO_THROW(options.check());
    mistakes[i](options);
    EXPECT_THROW(options.check(), std::invalid_argument) << i;
    EXPECT_THROW(hybridRansac(adapter, options), std::invalid_argument) << i;
  }
}

TEST(HybridRansac, ReasonsHaveNames) {
  EXPECT_STREQ(toString(FailureReason::None), "none");
  EXPECT_STREQ(toString(FailureReason::UndeterminedPose), "pose not determined by the inliers");
  EXPECT_STREQ(toString(StopReason::Confident), "confident");
}

}  // namespace
}  // namespace hybridgv

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "FocalPoseNear.hpp"
#include "WideScene.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"

namespace hybridgv {
namespace {

using hybrid_pose::NonlinearResult;
using hybrid_pose::optimize_nonlinear;
using test::HybridScene;
using test::SceneOptions;

HybridScene scene(test::Random& random, int rays, int points, double noise, int cameras = 5) {
  SceneOptions options;
  options.rays = rays;
  options.points = points;
  options.imageNoise = noise;
  options.cameras = cameras;
  return test::makeHybridScene(random, options);
}

double cost(const HybridScene& scene, const FocalPose& pose) {
  const NoncentralHybridAdapter adapter = scene.adapter();
  double sum = 0;
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    sum += std::pow(hybrid_pose::reprojectionError(pose, adapter.getImagePoint2d3d(i), adapter.getPoint(i)), 2);
  for (std::size_t i = 0; i < scene.bearings.size(); ++i)
    sum += std::pow(hybrid_pose::sampsonError(pose, adapter.getImagePoint2d2d(i), adapter.getBearingVector(i),
                                              adapter.getCamOffset(i), adapter.getCamRotation(i), 0),
                    2);
  return sum;
}

TEST(OptimizeNonlinear, RecoversTheTruthFromExactData) {
  test::Random random(test::testSeed(), 20);
  for (const auto& [rays, points] : {std::pair{40, 0}, {0, 20}, {3, 3}, {1, 6}, {20, 20}})
    for (int i = 0; i < 10; ++i) {
      const HybridScene data = scene(random, rays, points, 0);
      const FocalPose start = test::perturbed(random, data.truth, 0.01, 0.1, 0.01);
      const NonlinearResult result = optimize_nonlinear(data.adapter(), start);
      EXPECT_TRUE(result.converged);
      if (rays + points > 6) {
        EXPECT_TRUE(test::isFocalPoseNear(result.pose, data.truth, 1e-6)) << rays << " rays " << points << " points";
      }
      EXPECT_LT(result.cost, 1e-6);
    }
}

TEST(OptimizeNonlinear, ReportsTheCostOfItsResultAndIsNeverWorseThanTheStart) {
  test::Random random(test::testSeed(), 21);
  for (int i = 0; i < 20; ++i) {
    const HybridScene data = scene(random, 30, 30, 2);
    const FocalPose start = test::perturbed(random, data.truth, 0.1, 2, 0.3);
    const NonlinearResult result = optimize_nonlinear(data.adapter(), start);
    if (std::isfinite(cost(data, result.pose))) {
      EXPECT_NEAR(result.cost, cost(data, result.pose), 1e-6 * (1 + result.cost));
    }
    if (std::isfinite(cost(data, start))) {
      EXPECT_LE(result.cost, cost(data, start) * (1 + 1e-9));
    }
  }
}

TEST(OptimizeNonlinear, ResultIsAMinimum) {
  test::Random random(test::testSeed(), 22);
  for (int i = 0; i < 10; ++i) {
    const HybridScene data = scene(random, 30, 30, 2);
    const NonlinearResult result = optimize_nonlinear(data.adapter(), data.truth);
    ASSERT_TRUE(result.converged);
    for (int k = 0; k < 20; ++k) EXPECT_GT(cost(data, test::perturbed(random, result.pose, 1e-3, 1e-2, 1e-3)), result.cost);
  }
}

// Over many noisy scenes the squared error of log f, measured in the predicted variance, has mean 1.
TEST(OptimizeNonlinear, StandardDeviationOfTheFocalLengthIsThatOfItsErrors) {
  test::Random random(test::testSeed(), 23);
  const double noise = 0.5;
  double sum = 0;
  const int count = 300;
  for (int i = 0; i < count; ++i) {
    const HybridScene data = scene(random, 30, 30, noise);
    const NonlinearResult result = optimize_nonlinear(data.adapter(), data.truth);
    sum += std::pow((result.pose.focalLength - data.truth.focalLength) / (noise * result.focalLengthStandardDeviation), 2);
  }
  EXPECT_NEAR(sum / count, 1, 0.3);
}

TEST(OptimizeNonlinear, DoesNotDependOnTheFrameOrScaleOfTheScene) {
  for (const double scale : {1e-3, 1., 1e4}) {
    test::Random random(test::testSeed(), 24);
    SceneOptions options;
    options.imageNoise = 2;
    const HybridScene reference = test::makeHybridScene(random, options);
    test::Random again(test::testSeed(), 24);
    options.scale = scale, options.origin = scale * Eigen::Vector3d(5e5, -4e6, 300);  // as in a national grid
    const HybridScene moved = test::makeHybridScene(again, options);
    const NonlinearResult a = optimize_nonlinear(reference.adapter(), reference.truth);
    const NonlinearResult b = optimize_nonlinear(moved.adapter(), moved.truth);
    EXPECT_TRUE(test::isFocalPoseNear(a.pose, b.pose, 1e-6));
    EXPECT_NEAR(a.focalLengthStandardDeviation, b.focalLengthStandardDeviation, 1e-4 * a.focalLengthStandardDeviation);
    EXPECT_NEAR(a.information[3 * 7 + 3], b.information[3 * 7 + 3] * scale * scale, 1e-4 * a.information[3 * 7 + 3]);
  }
}

void expectStart(const NonlinearResult& result, const FocalPose& start) {
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.pose.rotation, start.rotation);
  EXPECT_EQ(result.pose.position, start.position);
  EXPECT_EQ(result.pose.focalLength, start.focalLength);
  EXPECT_EQ(result.focalLengthStandardDeviation, std::numeric_limits<double>::infinity());
}

TEST(OptimizeNonlinear, DegenerateDataGiveTheStart) {
  test::Random random(test::testSeed(), 25);
  const HybridScene none = scene(random, 0, 0, 0), three = scene(random, 0, 3, 0), oneCentre = scene(random, 40, 0, 2, 1);
  for (const HybridScene* data : {&none, &three, &oneCentre}) {
    const FocalPose start = test::perturbed(random, data->truth, 0.01, 0.1, 0.01);
    expectStart(optimize_nonlinear(data->adapter(), start), start);
  }
  HybridScene onePoint = scene(random, 0, 10, 0);
  for (Eigen::Vector3d& point : onePoint.points) point = onePoint.points[0];
  expectStart(optimize_nonlinear(onePoint.adapter(), onePoint.truth), onePoint.truth);
}

TEST(OptimizeNonlinear, StartWithAPointBehindTheQueryIsReturnedWithInfiniteCost) {
  test::Random random(test::testSeed(), 26);
  const HybridScene data = scene(random, 10, 10, 0);
  FocalPose start = data.truth;
  start.position = -start.position;
  const NonlinearResult result = optimize_nonlinear(data.adapter(), start);
  expectStart(result, start);
  EXPECT_EQ(result.cost, std::numeric_limits<double>::infinity());
}

TEST(OptimizeNonlinear, UsesTheGivenCorrespondencesOnly) {
  test::Random random(test::testSeed(), 27);
  HybridScene data = scene(random, 10, 10, 0);
  data.image2d2d[3] = data.image2d3d[5] = {1e4, -1e4, 1};
  const std::vector<std::vector<int>> indices = {{0, 1, 2, 4, 5, 6}, {9, 8, 7, 6, 0}};
  const NonlinearResult result =
      optimize_nonlinear(data.adapter(), indices, test::perturbed(random, data.truth, 0.01, 0.1, 0.01));
  EXPECT_TRUE(test::isFocalPoseNear(result.pose, data.truth, 1e-6));
}

HybridScene wideScene(test::Random& random, double distortion, double noise) {
  test::WideSceneOptions options;
  options.rays = options.points = 40;
  options.imageNoise = noise;
  options.lens = test::divisionLens(distortion);
  return test::makeWideScene(random, options);
}

TEST(OptimizeNonlinear, FindsTheDistortionOfExactImages) {
  test::Random random(test::testSeed(), 29);
  for (const double distortion : {-6e-7, -5e-8, 0., 2e-7}) {
    const HybridScene data = wideScene(random, distortion, 0);
    const FocalPose start = test::perturbed(random, data.truth, 0.01, 0.1, 0.01);
    const NonlinearResult result = optimize_nonlinear(data.adapter(), start, 0);
    EXPECT_TRUE(result.converged);
    EXPECT_TRUE(test::isFocalPoseNear(result.pose, data.truth, 1e-5));
    EXPECT_NEAR(result.distortion, distortion, 1e-11);
    EXPECT_EQ(optimize_nonlinear(data.adapter(), data.truth).distortion, 0);
  }
}

TEST(OptimizeNonlinear, DeviationsWithDistortionAreThoseOfTheErrors) {
  test::Random random(test::testSeed(), 30);
  const double noise = 0.5, distortion = -2e-7;
  double ofFocalLength = 0, ofDistortion = 0;
  const int count = 200;
  for (int i = 0; i < count; ++i) {
    const HybridScene data = wideScene(random, distortion, noise);
    const NonlinearResult result = optimize_nonlinear(data.adapter(), data.truth, distortion);
    ofFocalLength +=
        std::pow((result.pose.focalLength - data.truth.focalLength) / (noise * result.focalLengthStandardDeviation), 2);
    ofDistortion += std::pow((result.distortion - distortion) / (noise * result.distortionStandardDeviation), 2);
  }
  EXPECT_NEAR(ofFocalLength / count, 1, 0.35);
  EXPECT_NEAR(ofDistortion / count, 1, 0.35);
}

// That of the seven parameters for unknown distortion: its inverse has the variance of log f.
TEST(OptimizeNonlinear, InformationWithDistortionIsMarginal) {
  test::Random random(test::testSeed(), 31);
  const HybridScene data = wideScene(random, -2e-7, 1);
  const NonlinearResult result = optimize_nonlinear(data.adapter(), data.truth, 0);
  const Eigen::Map<const Eigen::Matrix<double, 7, 7>> information(result.information.data());
  const double variance = information.inverse()(6, 6);
  const double relative = result.focalLengthStandardDeviation / result.pose.focalLength;
  EXPECT_NEAR(std::sqrt(variance), relative, 1e-6 * relative);
}

TEST(OptimizeNonlinear, AStartFromWhichAnImagePointSeesNothingIsReturned) {
  test::Random random(test::testSeed(), 32);
  const HybridScene data = wideScene(random, -1e-7, 0);
  const NonlinearResult result = optimize_nonlinear(data.adapter(), data.truth, -1e-4);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.cost, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.pose.focalLength, data.truth.focalLength);
}

TEST(OptimizeNonlinear, WrongCallsAreRefused) {
  test::Random random(test::testSeed(), 28);
  const HybridScene data = scene(random, 10, 10, 0);
  const NoncentralHybridAdapter adapter = data.adapter();
  EXPECT_THROW(optimize_nonlinear(adapter, {{0, 1, 2}}, data.truth), std::invalid_argument);
  for (const double wrong : {NAN, -INFINITY}) EXPECT_THROW(optimize_nonlinear(adapter, data.truth, wrong), std::invalid_argument);
  EXPECT_THROW(optimize_nonlinear(adapter, {{0, 1, 10}, {0, 1, 2, 3}}, data.truth), std::invalid_argument);
  EXPECT_THROW(optimize_nonlinear(adapter, {{0, 1, 1}, {0, 1, 2, 3}}, data.truth), std::invalid_argument);
  EXPECT_THROW(optimize_nonlinear(adapter, {{}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 0}}, data.truth), std::invalid_argument);
  FocalPose start = data.truth;
  start.focalLength = -1;
  EXPECT_THROW(optimize_nonlinear(adapter, start), std::invalid_argument);
  start = data.truth;
  start.position[0] = NAN;
  EXPECT_THROW(optimize_nonlinear(adapter, start), std::invalid_argument);
  start = data.truth;
  start.rotation *= 2;
  EXPECT_THROW(optimize_nonlinear(adapter, start), std::invalid_argument);
}

}  // namespace
}  // namespace hybridgv

#include "robust/TurnAboutLine.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "HybridScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace robust {
namespace {

// All points at most about `width` beside a line through the origin.
test::HybridScene lineScene(std::uint64_t stream, int rays, int points, double width, double noise, double outliers = 0) {
  test::Random random(test::testSeed() + stream, 9800);
  test::SceneOptions options;
  options.rays = rays;
  options.points = points;
  test::HybridScene scene = test::makeHybridScene(random, options);
  const Eigen::Vector3d direction = random.direction();
  const auto place = [&] {
    return Eigen::Vector3d(random.uniform(-3, 3) * direction +
                           width * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  };
  for (std::size_t i = 0; i < scene.image2d3d.size(); ++i) {
    scene.points[i] = place();
    scene.image2d3d[i] = test::noisyImagePoint(random, test::project(scene.truth, scene.points[i]), noise);
    if (random.uniform() < outliers) scene.image2d3d[i] = test::randomImagePoint(random);
  }
  for (std::size_t i = 0; i < scene.image2d2d.size(); ++i) {
    const auto k = static_cast<std::size_t>(scene.cameras[i]);
    FocalPose camera;
    camera.rotation = scene.rotations[k];
    camera.position = scene.offsets[k];
    camera.focalLength = test::kRigFocalLength;
    const Eigen::Vector3d point = place(), inMap = test::noisyImagePoint(random, test::project(camera, point), noise);
    scene.image2d2d[i] = test::noisyImagePoint(random, test::project(scene.truth, point), noise);
    if (random.uniform() < outliers) scene.image2d2d[i] = test::randomImagePoint(random);
    scene.bearings[i] = Eigen::Vector3d(inMap[0], inMap[1], test::kRigFocalLength).normalized();
  }
  return scene;
}

double deviationAtTruth(const test::HybridScene& scene, double noise) {
  CorrespondenceArrays arrays(scene.adapter(), correspondences::allIndices(scene.image2d2d.size()),
                              correspondences::allIndices(scene.image2d3d.size()));
  arrays.fixUnknownFocalLengths();
  const PoseScorer scorer(arrays, {5 * noise, 5 * noise}, sac::Scoring::Msac);
  return deviationOfTurn(scorer, arrays.normalization().applyTo(QueryPose(scene.truth)), noise, {noise, 0});
}

TEST(TurnAboutLine, IsNotFixedByALineHoweverTheRaysAreNoisy) {
  int fixed = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    fixed += deviationAtTruth(lineScene(i, 60, 60, 0, 2), 2) < 0.15;
    fixed += deviationAtTruth(lineScene(i, 60, 0, 0, 2), 2) < 0.15;
    EXPECT_TRUE(std::isinf(deviationAtTruth(lineScene(i, 0, 60, 0, 2), 2)) ||
                deviationAtTruth(lineScene(i, 0, 60, 0, 2), 2) > 1e6);
  }
  EXPECT_LE(fixed, 3);
}

TEST(TurnAboutLine, IsFixedByWhatLiesBesideTheLine) {
  for (std::uint64_t i = 0; i < 30; ++i) {
    EXPECT_LT(deviationAtTruth(lineScene(i, 0, 60, 0.3, 2), 2), 0.1) << i;
    EXPECT_LT(deviationAtTruth(lineScene(i, 60, 0, 1, 2), 2), 0.15) << i;
    EXPECT_GT(deviationAtTruth(lineScene(i, 0, 60, 0.1, 2), 2), deviationAtTruth(lineScene(i, 0, 60, 0.3, 2), 2)) << i;
  }
}

// Successes, and those in a pose that is more than six stated deviations off.
struct Successes {
  int all = 0, wrong = 0;
};

Successes localizeLines(double width, bool isKnown, double outliers) {
  Successes result;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const test::HybridScene scene = lineScene(100 + i, 40, 40, width, 2, outliers);
    sac::HybridRansacOptions options;
    options.seed = i;
    if (isKnown) options.knownFocalLengthPx = scene.truth.focalLength;
    const sac::HybridRansacResult found = sac::hybridRansac(scene.adapter(), options);
    if (!found.success) continue;
    ++result.all;
    const Eigen::Vector3d error = found.pose.position - scene.truth.position;
    const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix<double, 7, 7>>(found.covariance.data()).block<3, 3>(3, 3);
    result.wrong += std::sqrt(error.dot(covariance.inverse() * error) / 3) > 6;
  }
  return result;
}

TEST(TurnAboutLine, AllOnOneLineIsNoSuccess) {
  for (const double width : {0., 1e-3})
    for (const double outliers : {0., 0.3})
      for (const bool isKnown : {true, false})
        EXPECT_LE(localizeLines(width, isKnown, outliers).all, 6)
            << "width " << width << ", outliers " << outliers << ", known " << isKnown;
}

TEST(TurnAboutLine, ABandThatIsNotTooNarrowIsOne) {
  for (const double outliers : {0., 0.3}) {
    const Successes successes = localizeLines(0.4, true, outliers);
    EXPECT_GE(successes.all, 55);
    EXPECT_LE(successes.wrong, 2);
  }
}

// About as wide as the noise: what is a success must be right, and what is not may be told from nothing.
TEST(TurnAboutLine, ABandAboutAsWideAsTheNoiseIsHardlyEverWrong) {
  Successes all;
  for (const double width : {0.02, 0.03, 0.05})
    for (const double outliers : {0., 0.3}) {
      const Successes successes = localizeLines(width, true, outliers);
      all.all += successes.all;
      all.wrong += successes.wrong;
    }
  EXPECT_LE(all.wrong, 10) << "of 360";
  EXPECT_GE(all.all, 60);
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

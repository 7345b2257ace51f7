#include "robust/LocalOptimizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "HybridScene.hpp"
#include "robust/LookAlikes.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kNoise = 1;
constexpr int kParameters = 7, kCameras = 6;

// The bearings of each rig camera are turned by up to some pixels.
test::HybridScene makeScene(test::Random& random, double commonError) {
  test::SceneOptions options;
  options.rays = 600;
  options.points = 60;
  options.cameras = kCameras;
  options.imageNoise = kNoise;
  test::HybridScene scene = test::makeHybridScene(random, options);
  std::vector<Eigen::Vector3d> errors(kCameras);
  for (Eigen::Vector3d& error : errors) error = commonError / test::kRigFocalLength * random.direction();
  for (std::size_t i = 0; i < scene.bearings.size(); ++i)
    scene.bearings[i] = (scene.bearings[i] + errors[static_cast<std::size_t>(scene.cameras[i])]).normalized();
  return scene;
}

struct Data {
  explicit Data(const test::HybridScene& scene)
      : arrays(scene.adapter(), correspondences::allIndices(scene.bearings.size()),
               correspondences::allIndices(scene.points.size())),
        scorer(arrays, {40, 60}, sac::Scoring::Msac),
        chance(arrays, 40, 60),
        features(arrays),
        optimizer(scorer, chance, features, 0, 1e9),
        truth(arrays.normalization().apply(scene.truth)) {}

  correspondences::CorrespondenceArrays arrays;
  PoseScorer scorer;
  ChanceModel chance;
  QueryFeatures features;
  LocalOptimizer optimizer;
  QueryPose truth;
};

double effectiveParameters(double commonError, std::uint64_t stream) {
  test::Random random(test::testSeed(), stream);
  std::vector<double> numbers;
  for (int i = 0; i < 30; ++i) {
    const Data data(makeScene(random, commonError));
    const FinalPose pose = data.optimizer.finish(data.optimizer.polish(data.truth));
    EXPECT_TRUE(pose.isRegular);
    EXPECT_GE(pose.effectiveParameters, kParameters - 1e-6);
    numbers.push_back(pose.effectiveParameters);
  }
  return test::median(numbers);
}

TEST(LocalOptimizer, PoseTakesUpAsManyParametersAsItHasIfErrorsAreIndependent) {
  EXPECT_LT(effectiveParameters(0, 150), 1.3 * kParameters);
}

TEST(LocalOptimizer, PoseTakesUpMoreThanItsParametersWhereRaysOfACameraShareAnError) {
  EXPECT_GT(effectiveParameters(12, 151), 1.5 * kParameters);
}

TEST(LocalOptimizer, KeptPoseStaysAsItIsAndHasTheNoiseOfItsErrors) {
  test::Random random(test::testSeed(), 152);
  const Data data(makeScene(random, 0));
  const FinalPose kept = data.optimizer.finish(data.optimizer.keep(data.truth));
  EXPECT_EQ(kept.pose.position, data.truth.position);
  EXPECT_EQ(kept.pose.focalLength, data.truth.focalLength);
  EXPECT_TRUE(kept.treatment.refused().empty());
  EXPECT_NEAR(kept.noise.points.deviation, kNoise, 0.3);
}

TEST(LocalOptimizer, PolishedPoseStaysWhereItIs) {
  test::Random random(test::testSeed(), 153);
  const Data data(makeScene(random, 0));
  const Optimum first = data.optimizer.polish(data.truth), again = data.optimizer.polish(first.pose);
  EXPECT_LT((again.pose.position - first.pose.position).norm(), 1e-3);
  EXPECT_NEAR(again.pose.focalLength / first.pose.focalLength, 1, 1e-4);
}

// The middle of the scene, which keeps its size in the image.
double distanceTo(const Data& data, const Eigen::Vector3d& middle) {
  const double factor = 2;
  const QueryPose farther = data.optimizer.atDistance(data.truth, factor);
  EXPECT_NEAR(farther.focalLength, factor * data.truth.focalLength, 1e-9 * farther.focalLength);
  const Eigen::Vector3d moved = data.truth.position - farther.position, axis = data.truth.rotation.col(2);
  EXPECT_NEAR(axis.cross(moved).norm(), 0, 1e-9 * moved.norm());
  return axis.dot(moved) / axis.dot(middle - data.truth.position);
}

TEST(LocalOptimizer, DistanceIsThatOfThePointsOrOfWhereRaysMeetTheQuerysOnes) {
  for (std::uint64_t i = 0; i < 10; ++i) {
    test::Random random(test::testSeed() + i, 157);
    test::SceneOptions options;
    options.rays = options.points = 60;
    options.origin = 30 * random.direction();
    test::HybridScene scene = test::makeHybridScene(random, options);
    const Data both(scene);
    EXPECT_NEAR(distanceTo(both, both.arrays.normalization().apply(options.origin)), 1, 0.15) << i;
    scene.removePoints();
    const Data raysAlone(scene);
    EXPECT_NEAR(distanceTo(raysAlone, raysAlone.arrays.normalization().apply(options.origin)), 1, 0.15) << i;
  }
}

TEST(LocalOptimizer, DistanceIsFiniteWhereTheQueryIsInARigCamera) {
  test::Random random(test::testSeed(), 156);
  test::SceneOptions options;
  options.rays = 60;
  options.points = 0;
  test::HybridScene scene = test::makeHybridScene(random, options);
  for (const bool inAll : {false, true}) {
    for (std::size_t k = 0; k < scene.offsets.size(); ++k)
      if (inAll || k == 0) scene.offsets[k] = scene.truth.position;
    const Data data(scene);
    const QueryPose farther = data.optimizer.atDistance(data.truth, 2);
    EXPECT_TRUE(farther.position.allFinite());
    EXPECT_TRUE(data.optimizer.finish(data.optimizer.keep(data.truth)).pose.position.allFinite());
  }
}

TEST(LikelihoodRatio, OfAPoseOverItselfIsOne) {
  test::Random random(test::testSeed(), 158);
  const Data data(makeScene(random, 0));
  const Optimum optimum = data.optimizer.keep(data.truth);
  const LikelihoodRatio ratio = data.optimizer.likelihoodRatio(optimum, optimum);
  EXPECT_EQ(ratio.log, 0);
  EXPECT_EQ(ratio.deviation, 0);
}

TEST(LikelihoodRatio, OfTheTruthOverAWrongPoseIsLargeAndItsInverseTheOtherWayRound) {
  test::Random random(test::testSeed(), 159);
  const Data data(makeScene(random, 0));
  QueryPose wrong = data.truth;
  wrong.rotation = wrong.rotation * Eigen::AngleAxisd(0.02, random.direction()).toRotationMatrix();
  const Optimum a = data.optimizer.keep(data.truth), b = data.optimizer.keep(wrong);
  const LikelihoodRatio ratio = data.optimizer.likelihoodRatio(a, b), inverse = data.optimizer.likelihoodRatio(b, a);
  EXPECT_GT(ratio.log, 100);
  EXPECT_GT(ratio.log, 5 * ratio.deviation);
  EXPECT_NEAR(inverse.log, -ratio.log, 1e-9 * ratio.log);
  EXPECT_NEAR(inverse.deviation, ratio.deviation, 1e-9 * ratio.deviation);
}

// A small flat object and its mirrored pose: of the rays, each is an accident of its own.
TEST(LikelihoodRatio, ScattersAboutAsStatedWhereTwoPosesAreAsGood) {
  std::vector<double> ratios;
  for (std::uint64_t i = 0; i < 200; ++i) {
    test::Random random(test::testSeed() + i, 160);
    test::SceneOptions options;
    options.rays = 100;
    options.points = 10;
    options.halfSize = 0.1;
    options.coplanar = true;
    options.imageNoise = kNoise;
    const Data data(test::makeHybridScene(random, options));
    const LookAlikes others = lookAlikes(data.scorer, data.truth);
    if (others.mirrored.empty()) continue;
    const LikelihoodRatio ratio =
        data.optimizer.likelihoodRatio(data.optimizer.keep(data.truth), data.optimizer.keep(others.mirrored[0]));
    if (ratio.log != 0) ratios.push_back(std::abs(ratio.log) / ratio.deviation);
  }
  ASSERT_GT(ratios.size(), 100u);
  EXPECT_NEAR(test::median(ratios), 0.7, 0.25) << "that of the absolute value of a normal variable is 0.67";
}

}  // namespace
}  // namespace hybridgv

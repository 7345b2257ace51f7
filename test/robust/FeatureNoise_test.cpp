#include "robust/FeatureNoise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>
#include <vector>

#include "FeatureScene.hpp"
#include "robust/Jackknife.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kNoise = 1;

struct Data {
  explicit Data(const test::HybridScene& scene)
      : arrays(test::adapterOf(scene), correspondences::allIndices(scene.bearings.size()),
               correspondences::allIndices(scene.points.size())),
        features(arrays),
        groups(jackknifeGroups(arrays, features)),
        truth(arrays.normalization().apply(scene.truth)) {}
  LeastSquaresProblem problem(double rayDeviation = kNoise, double pointDeviation = kNoise) const {
    return makeProblem(arrays, {Loss::Quadratic, 1, 1 / (pointDeviation * pointDeviation)},
                       {Loss::Quadratic, 1, 1 / (rayDeviation * rayDeviation)});
  }
  std::optional<SharedInformation> shared(const LeastSquaresProblem& of, const QueryPose& pose) const {
    return sharedInformation(of, pose, features, groups);
  }

  correspondences::CorrespondenceArrays arrays;
  QueryFeatures features;
  JackknifeGroups groups;
  QueryPose truth;
};

TEST(FeatureNoise, IsNoneWhereEveryCorrespondenceHasAFeatureOfItsOwn) {
  test::Random random(test::testSeed(), 9410);
  const Data data(test::makeFeatureScene(random, 20, 1, false));
  EXPECT_FALSE(data.shared(data.problem(), data.truth));
}

// The gradient of what is listed n times is n times that of the same once, and its covariance n^2 times.
TEST(FeatureNoise, RepeatedCorrespondencesTellAsMuchAsOnce) {
  test::Random random(test::testSeed(), 9411);
  const test::HybridScene scene = test::makeFeatureScene(random, 30, 1, false);
  test::HybridScene points = test::makeFeatureScene(random, 30, 0, true);
  points.image2d2d = scene.image2d2d;
  points.bearings = scene.bearings;
  points.cameras = scene.cameras;
  for (const int times : {2, 10}) {
    const Data data(test::repeated(points, times));
    const LeastSquaresProblem problem = data.problem(2, 0.5);
    const ParameterMatrix information = robust::information(problem, data.truth);
    const std::optional<SharedInformation> shared = data.shared(problem, data.truth);
    ASSERT_TRUE(shared);
    EXPECT_NEAR((shared->all - (times - 1) * information).norm(), 0, 1e-9 * information.norm());
    EXPECT_NEAR(shared->betweenGroups.norm(), 0, 1e-9 * information.norm()) << "copies are in one group";
  }
}

// The sample covariance of the gradient at the true pose, in coordinates in which the predicted one is the identity.
struct Setting {
  int features, raysPerFeature;
  bool withPoints;
  double mapNoise = kNoise;
};
Eigen::VectorXd varianceOverPrediction(std::uint64_t stream, const Setting& setting, bool allow) {
  constexpr int kRuns = 600;
  test::Random random(test::testSeed(), stream);
  const test::HybridScene scene = test::makeFeatureScene(random, setting.features, setting.raysPerFeature, setting.withPoints);
  const Data exact(scene);
  const double ofRays = std::sqrt((kNoise * kNoise + setting.mapNoise * setting.mapNoise) / 2);  // about
  Eigen::MatrixXd sample = Eigen::MatrixXd::Zero(7, 7), predicted = sample;
  for (int i = 0; i < kRuns; ++i) {
    const Data data(test::withFeatureNoise(random, scene, kNoise, setting.mapNoise));
    const QueryPose truth = data.arrays.normalization().apply(exact.arrays.normalization().undo(exact.truth));
    const LeastSquaresProblem problem = data.problem(ofRays, kNoise);
    const Derivatives at = derivatives(problem, truth);
    const std::optional<SharedInformation> shared = data.shared(problem, truth);
    sample += at.gradient * at.gradient.transpose() / kRuns;
    predicted += at.information / kRuns;
    if (shared && allow) predicted += shared->all / kRuns;
  }
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(sample, predicted).eigenvalues();
}

TEST(FeatureNoise, IsTheCovarianceThatTheGradientHas) {
  for (const Setting& s :
       {Setting{25, 3, false}, Setting{25, 5, false}, Setting{25, 1, true}, Setting{25, 3, true}, Setting{25, 5, true}}) {
    const Eigen::VectorXd ratios = varianceOverPrediction(9412, s, true);
    EXPECT_GT(ratios.minCoeff(), 0.7) << s.raysPerFeature << " rays";
    EXPECT_LT(ratios.maxCoeff(), 1.4) << s.raysPerFeature << " rays";
  }
}

// How much of a ray's error the query has, the data tell.
TEST(FeatureNoise, IsRightAlsoWhereTheMapImagesAreMoreExactThanTheQuery) {
  for (const bool withPoints : {false, true}) {
    const Eigen::VectorXd ratios = varianceOverPrediction(9417, {60, 5, withPoints, 0.2 * kNoise}, true);
    EXPECT_GT(ratios.minCoeff(), 0.6);
    EXPECT_LT(ratios.maxCoeff(), 1.5);
  }
}

TEST(FeatureNoise, IndependenceWouldNotExplainTheGradient) {
  EXPECT_GT(varianceOverPrediction(9413, {25, 5, true}, false).maxCoeff(), 2.5);
}

// The square of such a precision is 0.
TEST(FeatureNoise, IsFiniteForAnyNoise) {
  test::Random random(test::testSeed(), 9415);
  const Data data(test::makeFeatureScene(random, 20, 3, true));
  for (const double noise : {1e-10, 1e90, 1e137}) {
    const std::optional<SharedInformation> shared = data.shared(data.problem(noise, noise), data.truth);
    ASSERT_TRUE(shared) << noise;
    EXPECT_TRUE(shared->all.allFinite() && shared->betweenGroups.allFinite()) << noise;
  }
}

TEST(FeatureNoise, OutliersShareNothing) {
  test::Random random(test::testSeed(), 9414);
  test::HybridScene scene = test::makeFeatureScene(random, 30, 2, true);
  for (Eigen::Vector3d& bearing : scene.bearings) bearing = random.direction();
  const Data data(scene);
  LeastSquaresProblem problem = data.problem();
  problem.rayLoss = {Loss::Truncated, 1e-3, 1};
  const std::optional<SharedInformation> shared = data.shared(problem, data.truth);
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->all.norm(), 0, 1e-12 * information(problem, data.truth).norm());
}

// Rays of one feature in different cameras are in different groups; so are its rays and its point.
TEST(FeatureNoise, IsBetweenGroupsWhereNoGroupHasTwoOfAFeature) {
  test::Random random(test::testSeed(), 9415);
  const Data data(test::makeFeatureScene(random, 20, 3, true));
  const std::optional<SharedInformation> shared = data.shared(data.problem(), data.truth);
  ASSERT_TRUE(shared);
  EXPECT_NEAR((shared->all - shared->betweenGroups).norm(), 0, 1e-9 * shared->all.norm());
  EXPECT_GT(shared->all.norm(), 0);
}

TEST(FeatureNoise, PointsOfOneFeatureAreInOneJackknifeGroup) {
  test::Random random(test::testSeed(), 9416);
  const Data data(test::repeated(test::makeFeatureScene(random, 100, 1, true), 3));
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(data.groups.points[i], data.groups.points[i + 100]);
    EXPECT_EQ(data.groups.points[i], data.groups.points[i + 200]);
    EXPECT_EQ(data.groups.points[i], static_cast<int>(i / 2));
    EXPECT_EQ(data.groups.rays[i], data.arrays.rays()[i].camera);
  }
}

}  // namespace
}  // namespace hybridgv

#include "robust/Jackknife.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "HybridScene.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kNoise = 1;

// A scene with independent errors, and the rays of each rig camera moved by a common error of its image [px].
test::HybridScene makeScene(test::Random& random, double commonError) {
  test::SceneOptions options;
  options.rays = 120;
  options.points = 40;
  options.cameras = 12;
  options.imageNoise = kNoise;
  test::HybridScene scene = test::makeHybridScene(random, options);
  std::vector<Eigen::Vector3d> errors;
  for (int k = 0; k < options.cameras; ++k)
    errors.push_back(commonError / test::kRigFocalLength * random.normal() * random.direction());
  for (std::size_t i = 0; i < scene.bearings.size(); ++i)
    scene.bearings[i] = (scene.bearings[i] + errors[static_cast<std::size_t>(scene.cameras[i])]).normalized();
  return scene;
}

struct Estimate {
  ParameterMatrix byInformation, covariance;
  Eigen::Vector3d positionError;
};

correspondences::CorrespondenceArrays arraysOf(const test::HybridScene& scene) {
  return {scene.adapter(), correspondences::allIndices(scene.bearings.size()), correspondences::allIndices(scene.points.size())};
}

LeastSquaresProblem problemOf(const correspondences::CorrespondenceArrays& arrays) {
  const KindLoss noise{Loss::Quadratic, kNoise, 1 / (kNoise * kNoise)};
  return makeProblem(arrays, noise, noise);
}

JackknifeGroups groupsOf(const test::HybridScene& scene) {
  JackknifeGroups groups;
  for (const int camera : scene.cameras) groups.rays.push_back(camera);
  groups.points = correspondences::allIndices(scene.points.size());
  return groups;
}

Estimate estimate(const test::HybridScene& scene) {
  const correspondences::CorrespondenceArrays arrays = arraysOf(scene);
  const LeastSquaresProblem problem = problemOf(arrays);
  const QueryPose truth = arrays.normalization().apply(scene.truth);
  const QueryPose minimum = minimize(problem, truth).pose;
  Estimate result;
  const Derivatives at = derivatives(problem, minimum);
  EXPECT_TRUE(invertInformation(at.information, result.byInformation));
  EXPECT_TRUE(jackknifeCovariance(problem, minimum, groupsOf(scene), at, std::nullopt, result.covariance));
  result.positionError = minimum.position - truth.position;
  return result;
}

double smallestEigenvalue(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()[0];
}

// Mean of the squared error of the position over its variance, by both covariances; 1 if they are right.
struct Calibration {
  double byInformation = 0, byJackknife = 0;
};
Calibration positionCalibration(double commonError, std::uint64_t stream) {
  constexpr int kScenes = 120;
  test::Random random(test::testSeed(), stream);
  Calibration result;
  for (int i = 0; i < kScenes; ++i) {
    const Estimate at = estimate(makeScene(random, commonError));
    const auto squared = [&](const ParameterMatrix& covariance) {
      const Eigen::Matrix3d ofPosition = covariance.block<3, 3>(3, 3);
      return at.positionError.dot(ofPosition.inverse() * at.positionError) / 3;
    };
    result.byInformation += squared(at.byInformation) / kScenes;
    result.byJackknife += squared(at.covariance) / kScenes;
  }
  return result;
}

TEST(Jackknife, IsNeverSmallerThanTheInverseOfTheInformation) {
  test::Random random(test::testSeed(), 140);
  for (const double commonError : {0., 3.})
    for (int i = 0; i < 20; ++i) {
      const Estimate at = estimate(makeScene(random, commonError));
      EXPECT_GT(smallestEigenvalue(at.covariance - at.byInformation), -1e-6 * at.byInformation.norm());
    }
}

TEST(Jackknife, LeavesIndependentErrorsAsTheyAre) {
  const Calibration calibration = positionCalibration(0, 141);
  EXPECT_NEAR(calibration.byInformation, 1, 0.3);
  EXPECT_GT(calibration.byJackknife, 0.7 * calibration.byInformation);
}

TEST(Jackknife, ShowsErrorsThatTheRaysOfACameraShare) {
  const Calibration calibration = positionCalibration(6, 142);
  EXPECT_GT(calibration.byInformation, 4) << "else the scenes show nothing";
  EXPECT_LT(calibration.byJackknife, 0.5 * calibration.byInformation);
}

// Most points are one group. From beside the minimum, the others have a long way there, which is not what that group tells.
TEST(Jackknife, IsThatOfTheMinimumAlsoBesideIt) {
  test::Random random(test::testSeed(), 144);
  for (int i = 0; i < 20; ++i) {
    const test::HybridScene scene = makeScene(random, 0);
    const correspondences::CorrespondenceArrays arrays = arraysOf(scene);
    const LeastSquaresProblem problem = problemOf(arrays);
    const QueryPose minimum = minimize(problem, arrays.normalization().apply(scene.truth)).pose;
    ParameterMatrix there, beside;
    JackknifeGroups groups = groupsOf(scene);
    for (std::size_t k = 0; k < groups.points.size(); ++k)
      if (k % 10 != 0) groups.points[k] = 0;
    ASSERT_TRUE(jackknifeCovariance(problem, minimum, groups, derivatives(problem, minimum), std::nullopt, there));
    QueryPose pose = minimum;
    pose.focalLength *= 1 + 2 * std::sqrt(there(6, 6));
    pose.position += 2 * std::sqrt(there(5, 5)) * pose.rotation.col(2);
    ASSERT_TRUE(jackknifeCovariance(problem, pose, groups, derivatives(problem, pose), std::nullopt, beside));
    EXPECT_NEAR(std::sqrt(beside(6, 6) / there(6, 6)), 1, 0.3);
  }
}

TEST(Jackknife, ThreadsShareManyCorrespondencesWithTheSameBits) {
  test::Random random(test::testSeed(), 9620);
  test::SceneOptions options;
  options.rays = 6000;
  options.points = 5000;
  options.imageNoise = kNoise;
  const test::HybridScene scene = test::makeHybridScene(random, options);
  const correspondences::CorrespondenceArrays arrays = arraysOf(scene);
  LeastSquaresProblem problem = problemOf(arrays);
  const QueryPose truth = arrays.normalization().apply(scene.truth);
  const Derivatives at = derivatives(problem, truth);
  const JackknifeGroups groups = jackknifeGroups(arrays, QueryFeatures(arrays));
  ParameterMatrix alone;
  ASSERT_TRUE(jackknifeCovariance(problem, truth, groups, at, std::nullopt, alone));
  for (const std::size_t threads : {1, 2, 5}) {
    WorkerPool workers(threads);
    problem.workers = &workers;
    ParameterMatrix shared;
    ASSERT_TRUE(jackknifeCovariance(problem, truth, groups, at, std::nullopt, shared));
    EXPECT_EQ(shared, alone) << threads;
  }
}

TEST(Jackknife, GroupsOfManyCamerasAreBoundedAndKeepACameraTogether) {
  test::Random random(test::testSeed(), 9621);
  test::SceneOptions options;
  options.rays = 6000;
  options.points = 100;
  options.cameras = 2500;
  const correspondences::CorrespondenceArrays arrays = arraysOf(test::makeHybridScene(random, options));
  const JackknifeGroups groups = jackknifeGroups(arrays, QueryFeatures(arrays));
  std::map<int, int> ofCamera;
  for (std::size_t i = 0; i < arrays.rays().size(); ++i) {
    EXPECT_LT(groups.rays[i], 1024);
    EXPECT_EQ(ofCamera.emplace(arrays.rays()[i].camera, groups.rays[i]).first->second, groups.rays[i]);
  }
  EXPECT_LT(*std::max_element(groups.points.begin(), groups.points.end()), 64);
}

TEST(Jackknife, HasNoResultIfTheInformationHasNoInverse) {
  test::Random random(test::testSeed(), 143);
  test::SceneOptions options;
  options.rays = 3;
  options.points = 0;
  const test::HybridScene scene = test::makeHybridScene(random, options);
  const correspondences::CorrespondenceArrays arrays(scene.adapter(), correspondences::allIndices(3), {});
  const LeastSquaresProblem problem = makeProblem(arrays, {}, {});
  const QueryPose truth = arrays.normalization().apply(scene.truth);
  ParameterMatrix covariance;
  EXPECT_FALSE(jackknifeCovariance(problem, truth, {{0, 1, 2}, {}}, derivatives(problem, truth), std::nullopt, covariance));
}

}  // namespace
}  // namespace hybridgv

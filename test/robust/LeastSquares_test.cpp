#include "robust/LeastSquares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "HybridScene.hpp"
#include "WideScene.hpp"
#include "correspondences/PaddedValues.hpp"
#include "correspondences/arrayParts.hpp"
#include "robust/Leverage.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using correspondences::CorrespondenceArrays;

constexpr Intrinsics kUnknownFocalLength{true, false}, kKnownFocalLength{false, false};

struct Data {
  Data(test::Random& random, int rays, int points, double noise)
      : scene(make(random, rays, points, noise)),
        adapter(scene.adapter()),
        arrays(adapter, correspondences::allIndices(scene.bearings.size()), correspondences::allIndices(scene.points.size())),
        truth(arrays.normalization().apply(scene.truth)) {}
  static test::HybridScene make(test::Random& random, int rays, int points, double noise) {
    test::SceneOptions options;
    options.rays = rays;
    options.points = points;
    options.imageNoise = noise;
    return test::makeHybridScene(random, options);
  }
  LeastSquaresProblem problem(Intrinsics estimated) const { return makeProblem(arrays, {}, {}, estimated); }

  test::HybridScene scene;
  NoncentralHybridAdapter adapter;
  CorrespondenceArrays arrays;
  QueryPose truth;
};

QueryPose withFocalLength(QueryPose pose, double focalLength) {
  pose.focalLength = focalLength;
  return pose;
}

TEST(LeastSquares, FindsThePoseAndKeepsAKnownFocalLength) {
  test::Random random(test::testSeed(), 140);
  for (int i = 0; i < 20; ++i) {
    const Data data(random, 12, 8, 0);
    const FocalPose start = test::perturbed(random, data.truth, 0.02, 0.02, 0);
    const LeastSquaresResult result = minimize(data.problem(kKnownFocalLength), withFocalLength(start, data.truth.focalLength));
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.pose.focalLength, data.truth.focalLength);
    EXPECT_LT((result.pose.rotation - data.truth.rotation).norm(), 1e-7);
    EXPECT_LT((result.pose.position - data.truth.position).norm(), 1e-6);
    EXPECT_EQ(result.information.rows(), kKnownFocalLength.parameters());
  }
}

// Whoever knows the focal length knows the pose as well as the conditional distribution says.
TEST(LeastSquares, CovarianceForAKnownFocalLengthIsTheConditionalOne) {
  test::Random random(test::testSeed(), 141);
  const Data data(random, 30, 20, 0);
  ParameterMatrix known, unknown;
  ASSERT_TRUE(invertInformation(information(data.problem(kKnownFocalLength), data.truth), known));
  ASSERT_TRUE(invertInformation(information(data.problem(kUnknownFocalLength), data.truth), unknown));
  const Eigen::VectorXd withFocal = unknown.col(6).head(6);
  const Eigen::MatrixXd conditional = unknown.topLeftCorner(6, 6) - withFocal * withFocal.transpose() / unknown(6, 6);
  ASSERT_EQ(known.rows(), 6);
  EXPECT_LT((known - conditional).norm(), 1e-6 * known.norm());
  EXPECT_EQ(varianceOfLogFocalLength(known, kKnownFocalLength), 0);
  EXPECT_GT(varianceOfLogFocalLength(unknown, kUnknownFocalLength), 0);
}

// The squared error of the pose, measured in the stated covariance, is the number of parameters on average.
TEST(LeastSquares, CovarianceIsThatOfTheErrors) {
  constexpr double kNoise = 0.5;
  constexpr int kScenes = 150;
  for (const Intrinsics estimated : {kUnknownFocalLength, kKnownFocalLength}) {
    test::Random random(test::testSeed(), 142);
    double squares = 0;
    for (int i = 0; i < kScenes; ++i) {
      const Data data(random, 0, 40, kNoise);
      const LeastSquaresResult result = minimize(data.problem(estimated), data.truth);
      const Eigen::AngleAxisd turn(Eigen::Matrix3d(data.truth.rotation.transpose() * result.pose.rotation));
      Eigen::VectorXd error(7);
      error << turn.angle() * turn.axis(), result.pose.position - data.truth.position,
          std::log(result.pose.focalLength / data.truth.focalLength);
      const Eigen::VectorXd used = error.head(estimated.parameters());
      squares += used.dot(result.information * used) / (kNoise * kNoise);
    }
    EXPECT_NEAR(squares / kScenes, estimated.parameters(), 1);
  }
}

TEST(LeastSquares, ThreePointsFixThePoseOfAKnownCameraOnly) {
  test::Random random(test::testSeed(), 143);
  const Data data(random, 0, 3, 0);
  ParameterMatrix covariance;
  EXPECT_TRUE(invertInformation(information(data.problem(kKnownFocalLength), data.truth), covariance));
  EXPECT_FALSE(invertInformation(information(data.problem(kUnknownFocalLength), data.truth), covariance));
}

TEST(LeastSquares, LeveragesOfRaysAloneSumUpToTheNumberOfEstimatedParameters) {
  test::Random random(test::testSeed(), 144);
  const Data data(random, 30, 0, 0.5);
  for (const Intrinsics estimated : {kUnknownFocalLength, kKnownFocalLength}) {
    const std::vector<double> leverages = rayLeverages(data.problem(estimated), data.truth);
    EXPECT_NEAR(std::accumulate(leverages.begin(), leverages.end(), 0.), estimated.parameters(), 1e-5);
  }
}

TEST(LeastSquares, AKindThatDoesNotTakePartDoesNotMatter) {
  test::Random random(test::testSeed(), 145);
  const Data data(random, 20, 20, 0.5);
  LeastSquaresProblem rays = data.problem({}), points = rays, both = rays;
  rays.kinds = {true, false};
  points.kinds = {false, true};
  const ParameterMatrix sum = information(rays, data.truth) + information(points, data.truth);
  EXPECT_LT((information(both, data.truth) - sum).norm(), 1e-9 * sum.norm());
  EXPECT_EQ(rayLeverages(points, data.truth), std::vector<double>(20, 0));
}

// Sums over many correspondences are made of parts: they are those over all, and the same for any number of threads.
// Points near the optical axis hardly tell the focal length: a step that changes next to nothing of the cost can be many powers of e long.
TEST(LeastSquares, NoLongStepIsTakenUnseenBecauseItChangesLittle) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    test::Random random(test::testSeed() + i, 148);
    test::SceneOptions options;
    options.rays = 0;
    options.points = 30;
    test::HybridScene scene = test::makeHybridScene(random, options);
    for (std::size_t k = 0; k < scene.points.size(); ++k) {
      const Eigen::Vector3d inQuery(1e-6 * random.normal(), 1e-6 * random.normal(), random.uniform(10, 30));
      scene.points[k] = scene.truth.position + scene.truth.rotation * inQuery;
      scene.image2d3d[k] = {random.normal(), random.normal(), 1};
    }
    const CorrespondenceArrays arrays(scene.adapter(), {}, correspondences::allIndices(30));
    const QueryPose start = arrays.normalization().applyTo(QueryPose(scene.truth));
    for (const double least : {1e-8, 1e-4, 1e-2, 0.05}) {
      LeastSquaresOptions limits;
      limits.minRelativeDecrease = least;
      const LeastSquaresProblem problem =
          makeProblem(arrays, {Loss::Quadratic, 1, 1}, {Loss::Quadratic, 1, 1}, kUnknownFocalLength);
      const LeastSquaresResult result = minimize(problem, start, limits);
      EXPECT_TRUE(std::isfinite(result.pose.focalLength)) << i;
      EXPECT_TRUE(result.pose.position.allFinite()) << i;
      const double cost = minimize(problem, result.pose, {0}).cost, before = minimize(problem, start, {0}).cost;
      EXPECT_LE(cost, (1 + 2 * least) * before) << i;
    }
  }
}

TEST(LeastSquares, ThreadsShareManyCorrespondencesWithTheSameBits) {
  test::Random random(test::testSeed(), 147);
  const Data data(random, 5003, 2049, 1);
  for (const Intrinsics estimated : {kUnknownFocalLength, kKnownFocalLength, Intrinsics{true, true}}) {
    LeastSquaresProblem problem = data.problem(estimated);
    std::vector<double> values(5003);
    for (double& value : values) value = random.uniform(1, 3);
    const correspondences::PaddedValues narrowing(values, 1);
    problem.rays.narrowing = narrowing.pointer();
    problem.rayLoss = {Loss::Mixture, 10, 0.02, 50};
    problem.pointLoss = {Loss::Truncated, 10, 0.01};
    ParameterMatrix whole = ParameterMatrix::Zero(estimated.parameters(), estimated.parameters());
    for (std::size_t i = 0; i < 5003; i += 8) {
      LeastSquaresProblem part = problem;
      part.kinds = {true, i < 2049};
      part.rays = correspondences::part(problem.rays, i, std::min<std::size_t>(i + 8, 5003));
      if (i < 2049) part.points = correspondences::part(problem.points, i, std::min<std::size_t>(i + 8, 2049));
      whole += information(part, data.truth);
    }
    const ParameterMatrix alone = information(problem, data.truth);
    EXPECT_LT((alone - whole).norm(), 1e-9 * whole.norm());
    const LeastSquaresResult minimum = minimize(problem, data.truth);
    for (const std::size_t threads : {1, 2, 5}) {
      WorkerPool workers(threads);
      problem.workers = &workers;
      EXPECT_EQ(information(problem, data.truth), alone) << threads;
      EXPECT_EQ(minimize(problem, data.truth).pose.position, minimum.pose.position) << threads;
      EXPECT_EQ(minimize(problem, data.truth).cost, minimum.cost) << threads;
    }
  }
}

TEST(ParameterMatrix, OfAFocalPoseHasNoEntriesForWhatIsKnownAndLeavesTheDistortionOut) {
  for (const Intrinsics estimated :
       {Intrinsics{false, false}, Intrinsics{true, false}, Intrinsics{false, true}, Intrinsics{true, true}}) {
    const int size = estimated.parameters();
    ParameterMatrix matrix(size, size);
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) matrix(row, column) = 1 + std::min(row, column);
    const FocalPoseMatrix result = toFocalPoseMatrix(matrix, estimated);
    for (int row = 0; row < 7; ++row)
      for (int column = 0; column < 7; ++column) {
        const bool isFocal = row == 6 || column == 6;
        const double expected = isFocal && !estimated.focalLength ? 0 : 1 + std::min(row, column);
        EXPECT_EQ(result[static_cast<std::size_t>(7 * row + column)], expected);
      }
  }
}

TEST(ParameterMatrix, FollowsTheUnitOfThePositions) {
  ParameterMatrix matrix = ParameterMatrix::Ones(7, 7);
  matrix = withPositionsTimes(3, matrix);
  EXPECT_EQ(matrix(0, 0), 1);
  EXPECT_EQ(matrix(3, 0), 3);
  EXPECT_EQ(matrix(1, 5), 3);
  EXPECT_EQ(matrix(4, 5), 9);
  EXPECT_EQ(matrix(6, 3), 3);
  EXPECT_EQ(matrix(6, 6), 1);
}

constexpr Intrinsics kUnknownLens{true, true};

// Scenes that fill the image, as a lens of the division model sees them.
struct WideData {
  WideData(test::Random& random, double distortion, double noise) : scene(make(random, distortion, noise)) {}
  static test::HybridScene make(test::Random& random, double distortion, double noise) {
    test::WideSceneOptions options;
    options.lens = test::divisionLens(distortion);
    options.imageNoise = noise;
    options.rays = options.points = 40;
    return test::makeWideScene(random, options);
  }
  CorrespondenceArrays arrays() const {
    return {scene.adapter(), correspondences::allIndices(scene.bearings.size()),
            correspondences::allIndices(scene.points.size())};
  }
  test::HybridScene scene;
};

TEST(LeastSquares, FindsTheDistortionOfExactData) {
  test::Random random(test::testSeed(), 145);
  for (const double distortion : {-6e-7, -1e-7, 0., 2e-7}) {
    const WideData data(random, distortion, 0);
    const CorrespondenceArrays arrays = data.arrays();
    const QueryPose start = arrays.normalization().apply(test::perturbed(random, data.scene.truth, 0.01, 0.02, 0.01));
    const LeastSquaresResult result = minimize(makeProblem(arrays, {}, {}, kUnknownLens), start);
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(result.pose.distortion, distortion, 1e-12);
    EXPECT_NEAR(result.pose.focalLength, data.scene.truth.focalLength, 1e-5 * data.scene.truth.focalLength);
    EXPECT_EQ(result.information.rows(), kUnknownLens.parameters());
  }
}

TEST(LeastSquares, ThePriorDrawsTheDistortionTowardsZeroAndTheBoundsHold) {
  test::Random random(test::testSeed(), 146);
  const double distortion = -3e-7;
  const WideData data(random, distortion, 1);
  const CorrespondenceArrays arrays = data.arrays();
  const QueryPose start = arrays.normalization().apply(data.scene.truth);
  LeastSquaresProblem problem = makeProblem(arrays, {}, {}, kUnknownLens);
  const double free = minimize(problem, start).pose.distortion;
  problem.distortionPrior.scale = 1e-9;
  const LeastSquaresResult drawn = minimize(problem, start);
  EXPECT_GT(drawn.pose.distortion, free);
  EXPECT_LT(drawn.pose.distortion, 0);
  problem.distortionPrior = {};
  LeastSquaresOptions options;
  options.minDistortion = -1e-7;
  options.maxDistortion = 1e-7;
  EXPECT_EQ(minimize(problem, start, options).pose.distortion, options.minDistortion);
}

// Of exact data, where the errors' second derivatives do not matter.
TEST(LeastSquares, AMovedImageMovesTheMinimumAgainstTheChangeOfTheGradient) {
  constexpr double kShift = 1e-3;
  test::Random random(test::testSeed(), 147);
  for (const Intrinsics estimated : {kUnknownFocalLength, kKnownFocalLength, kUnknownLens})
    for (int i = 0; i < 5; ++i) {
      const WideData data(random, estimated.radial ? -4e-7 : 0, 0);
      const CorrespondenceArrays still = data.arrays();
      const QueryPose start = still.normalization().apply(data.scene.truth);
      const LeastSquaresProblem problem = makeProblem(still, {}, {}, estimated);
      const LeastSquaresResult before = minimize(problem, start);
      ParameterMatrix covariance;
      ASSERT_TRUE(invertInformation(before.information, covariance));
      const ParameterPair expected = -kShift * (covariance * gradientByImageShift(problem, before.pose));
      for (int axis = 0; axis < 2; ++axis) {
        WideData moved = data;
        for (Eigen::Vector3d& point : moved.scene.image2d2d) point[axis] += kShift;
        for (Eigen::Vector3d& point : moved.scene.image2d3d) point[axis] += kShift;
        const CorrespondenceArrays arrays = moved.arrays();
        const LeastSquaresResult after = minimize(makeProblem(arrays, {}, {}, estimated), before.pose);
        const ParameterVector change = changeOf(before.pose, after.pose, estimated);
        // In units of the parameters' deviations for errors of one pixel.
        const Eigen::VectorXd unit = covariance.diagonal().cwiseSqrt();
        const Eigen::VectorXd found = change.cwiseQuotient(unit), wanted = expected.col(axis).cwiseQuotient(unit);
        EXPECT_LT((found - wanted).norm(), 1e-3 * wanted.norm()) << "axis " << axis;
      }
    }
}

}  // namespace
}  // namespace hybridgv

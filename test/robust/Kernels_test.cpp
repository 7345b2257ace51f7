#include "robust/kernels/Kernels.hpp"
#include "robust/toPlain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "HybridScene.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "correspondences/PaddedValues.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using math::SimdLevel;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<SimdLevel> levels() {
  std::vector<SimdLevel> result;
  for (const SimdLevel level : {SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Avx512})
    if (level <= math::supportedSimdLevel()) result.push_back(level);
  return result;
}

// Sizes that are and are not multiples of the vectors' lengths; half of the rig cameras have a known focal length.
struct Data {
  Data(test::Random& random, int rays, int points) : adapter(make(random, rays, points)), arrays(read(adapter)) {}

  NoncentralHybridAdapter make(test::Random& random, int rays, int points) {
    test::SceneOptions options;
    options.rays = rays, options.points = points, options.imageNoise = 2;
    options.outlierShareRays = options.outlierSharePoints = 0.4;
    scene = test::makeHybridScene(random, options);
    NoncentralHybridAdapter result = scene.adapter();
    result.setRigFocalLengths({0, 1000, 0, 800, 2000});
    // Some near truth, some far from it, some that look away.
    for (int i = 0; i < 4; ++i) poses.push_back(test::perturbed(random, scene.truth, 0.02, 0.2, 0.05));
    for (int i = 0; i < 4; ++i) poses.push_back(test::perturbed(random, scene.truth, 3, 10, 1));
    return result;
  }
  static correspondences::CorrespondenceArrays read(const NoncentralHybridAdapter& adapter) {
    return {adapter, correspondences::allIndices(adapter.getNumberCorrespondences2d2d()),
            correspondences::allIndices(adapter.getNumberCorrespondences2d3d())};
  }
  PlainPose plain(const FocalPose& pose) const { return toPlain(arrays.normalization().apply(pose)); }
  double reprojection(const FocalPose& pose, std::size_t i) const {
    return hybrid_pose::reprojectionError(pose, adapter.getImagePoint2d3d(i), adapter.getPoint(i));
  }
  double sampson(const FocalPose& pose, std::size_t i) const {
    return hybrid_pose::sampsonError(pose, adapter.getImagePoint2d2d(i), adapter.getBearingVector(i), adapter.getCamOffset(i),
                                     adapter.getCamRotation(i), adapter.getRigFocalLength(i));
  }

  test::HybridScene scene;
  std::vector<FocalPose> poses;
  NoncentralHybridAdapter adapter;
  correspondences::CorrespondenceArrays arrays;
};

void expectEqualErrors(double squared, double error) {
  if (std::isinf(error)) {
    EXPECT_EQ(squared, kInfinity);
  } else
    EXPECT_NEAR(std::sqrt(squared), error, 1e-7 * (1 + error));
}

TEST(Kernels, ErrorsAreThoseOfTheDefinitionsAtEveryLevel) {
  test::Random random(test::testSeed(), 10);
  for (const int size : {0, 1, 7, 8, 61}) {
    const Data data(random, size, size + 2);
    std::vector<double> errors(100);
    for (const SimdLevel level : levels())
      for (const FocalPose& pose : data.poses) {
        kernels(level).squaredPointErrors(data.arrays.pointArrays(), data.plain(pose), errors.data());
        for (std::size_t i = 0; i < data.scene.points.size(); ++i) expectEqualErrors(errors[i], data.reprojection(pose, i));
        kernels(level).squaredRayErrors(data.arrays.rayArrays(), data.plain(pose), errors.data());
        for (std::size_t i = 0; i < data.scene.bearings.size(); ++i) expectEqualErrors(errors[i], data.sampson(pose, i));
      }
  }
}

Score expectedScore(const std::vector<double>& errors, std::size_t begin, std::size_t end, double threshold) {
  Score score;
  for (std::size_t i = begin; i < end; ++i)
    if (errors[i] < threshold) score.msac += 1 - std::pow(errors[i] / threshold, 2), ++score.inliers;
  return score;
}

TEST(Kernels, ScoresAreTheSumsOverTheInliersAtEveryLevel) {
  test::Random random(test::testSeed(), 11);
  const double threshold = 9;
  for (const int size : {1, 8, 61}) {
    const Data data(random, size, size + 2);
    for (const FocalPose& pose : data.poses) {
      std::vector<double> reprojection, sampson;
      for (std::size_t i = 0; i < data.scene.points.size(); ++i) reprojection.push_back(data.reprojection(pose, i));
      for (std::size_t i = 0; i < data.scene.bearings.size(); ++i) sampson.push_back(data.sampson(pose, i));
      for (const SimdLevel level : levels())
        for (const std::size_t begin : {std::size_t{0}, std::size_t{8}}) {
          if (begin >= sampson.size()) continue;
          const Score points = kernels(level).scorePoints(data.arrays.pointArrays(), data.plain(pose), threshold * threshold,
                                                          begin, reprojection.size());
          const Score expectedPoints = expectedScore(reprojection, begin, reprojection.size(), threshold);
          EXPECT_EQ(points.inliers, expectedPoints.inliers);
          EXPECT_NEAR(points.msac, expectedPoints.msac, 1e-8 * (1 + points.msac));
          const Score rays =
              kernels(level).scoreRays(data.arrays.rayArrays(), data.plain(pose), threshold * threshold, begin, sampson.size());
          const Score expectedRays = expectedScore(sampson, begin, sampson.size(), threshold);
          EXPECT_EQ(rays.inliers, expectedRays.inliers);
          EXPECT_NEAR(rays.msac, expectedRays.msac, 1e-8 * (1 + rays.msac));
        }
    }
  }
}

TEST(Kernels, APoseThatIsNotANumberHasNoInliers) {
  test::Random random(test::testSeed(), 12);
  const Data data(random, 20, 20);
  FocalPose pose = data.scene.truth;
  pose.position[1] = NAN;
  for (const SimdLevel level : levels()) {
    EXPECT_EQ(kernels(level).scorePoints(data.arrays.pointArrays(), toPlain(pose), 100, 0, 20).inliers, 0);
    EXPECT_EQ(kernels(level).scoreRays(data.arrays.rayArrays(), toPlain(pose), 100, 0, 20).msac, 0);
  }
}

// ---- normal equations ----

constexpr int kParameters = correspondences::kFocalPoseParameters;

constexpr Loss kLosses[] = {Loss::Quadratic, Loss::Truncated, Loss::Mixture};

NormalEquations sums(SimdLevel level, const Data& data, const FocalPose& normalized, const KindLoss& loss, bool points, bool rays,
                     correspondences::PaddedPointer narrowing = {}) {
  NormalEquations result;
  if (points) kernels(level).addPoints(data.arrays.pointArrays(), toPlain(normalized), loss, result);
  RayArrays rayArrays = data.arrays.rayArrays();
  rayArrays.narrowing = narrowing;
  if (rays) kernels(level).addRays(rayArrays, toPlain(normalized), loss, result);
  return result;
}

FocalPose moved(const FocalPose& pose, int parameter, double step) {
  FocalPose result = pose;
  if (parameter < 3) result.rotation = pose.rotation * Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(parameter));
  if (parameter >= 3 && parameter < 6) result.position[parameter - 3] += step;
  if (parameter == 6) result.focalLength *= std::exp(step);
  return result;
}

double expectedCost(double error, const KindLoss& loss, double narrowing = 1) {
  const double x = narrowing * error * error / (loss.scale * loss.scale);
  const double mixture = std::log((1 + loss.odds) / (1 + loss.odds * std::pow(1 + x, -8)));
  const double rho = loss.loss == Loss::Quadratic ? x : loss.loss == Loss::Truncated ? std::min(x, 1.) : mixture;
  return loss.precision * loss.scale * loss.scale * rho / narrowing;
}

TEST(Kernels, CostsAreThoseOfTheLossAtEveryLevel) {
  test::Random random(test::testSeed(), 13);
  const Data data(random, 61, 63);
  const FocalPose& pose = data.poses[0];  // all points in front
  for (const Loss loss : {Loss::Truncated, Loss::Mixture})
    for (const SimdLevel level : levels()) {
      const KindLoss spec{loss, 1000, 0.25, 1e9};  // wide: no error is infinite
      double points = 0, rays = 0;
      for (std::size_t i = 0; i < data.scene.points.size(); ++i) points += expectedCost(data.reprojection(pose, i), spec);
      const FocalPose normalized = data.arrays.normalization().apply(pose);
      EXPECT_NEAR(sums(level, data, normalized, spec, true, false).cost, points, 1e-8 * points);
      for (std::size_t i = 0; i < data.scene.bearings.size(); ++i) rays += expectedCost(data.sampson(pose, i), spec);
      EXPECT_NEAR(sums(level, data, normalized, spec, false, true).cost, rays, 1e-8 * rays);
    }
}

// gradient = J^T W e is half the derivative of the cost.
TEST(Kernels, GradientsAreTheCentralDifferencesOfTheCostAtEveryLevel) {
  test::Random random(test::testSeed(), 14);
  const Data data(random, 61, 63);
  for (const Loss loss : kLosses)
    for (const bool points : {true, false})
      for (const SimdLevel level : levels())
        for (int k = 0; k < 4; ++k) {
          const FocalPose pose = data.arrays.normalization().apply(data.poses[static_cast<std::size_t>(k)]);
          const KindLoss spec{loss, 30, 2, 50};
          const NormalEquations at = sums(level, data, pose, spec, points, !points);
          if (!std::isfinite(at.cost)) continue;  // something is behind a camera
          for (int i = 0; i < kParameters; ++i) {
            const double h = 1e-6;
            const double difference = (sums(level, data, moved(pose, i, h), spec, points, !points).cost -
                                       sums(level, data, moved(pose, i, -h), spec, points, !points).cost) /
                                      (2 * h);
            EXPECT_NEAR(2 * at.gradient[i], difference, 1e-5 * (1 + std::abs(difference)) + 1e-13 * at.cost / h)
                << "loss " << static_cast<int>(loss) << " points " << points << " parameter " << i;
          }
        }
}

TEST(Kernels, ANarrowedLossIsNarrowerWithTheSameCurvatureAtEveryLevel) {
  test::Random random(test::testSeed(), 17);
  const Data data(random, 61, 4);
  std::vector<double> values(61);
  for (double& value : values) value = random.uniform(1, 50);
  const correspondences::PaddedValues narrowing(values, 1);
  const FocalPose pose = data.arrays.normalization().apply(data.poses[0]);
  for (const Loss loss : kLosses)
    for (const SimdLevel level : levels()) {
      const KindLoss spec{loss, 1000, 0.25, 1e9};  // wide: no error is infinite
      double cost = 0;
      for (std::size_t i = 0; i < data.scene.bearings.size(); ++i)
        cost += expectedCost(data.sampson(data.poses[0], i), spec, narrowing[i]);
      const NormalEquations at = sums(level, data, pose, spec, false, true, narrowing.pointer());
      EXPECT_NEAR(at.cost, cost, 1e-8 * cost);
      for (int i = 0; i < kParameters; ++i) {
        const double h = 1e-6;
        const double difference = (sums(level, data, moved(pose, i, h), spec, false, true, narrowing.pointer()).cost -
                                   sums(level, data, moved(pose, i, -h), spec, false, true, narrowing.pointer()).cost) /
                                  (2 * h);
        EXPECT_NEAR(2 * at.gradient[i], difference, 1e-5 * (1 + std::abs(difference)) + 1e-13 * at.cost / h);
      }
    }
}

TEST(Kernels, LeveragesAreEqualAtAllLevels) {
  test::Random random(test::testSeed(), 18);
  const Data data(random, 61, 4);
  Eigen::Matrix<double, kMostParameters, kMostParameters> covariance;
  covariance.setIdentity();
  covariance(2, 5) = covariance(5, 2) = 0.5;
  const PlainPose pose = data.plain(data.poses[0]);
  for (const Loss loss : kLosses) {
    std::vector<double> expected(64), actual(64);
    const KindLoss spec{loss, 20, 0.5, 50};
    kernels(SimdLevel::Baseline).rayLeverages(data.arrays.rayArrays(), pose, spec, covariance.data(), expected.data());
    for (const SimdLevel level : levels()) {
      kernels(level).rayLeverages(data.arrays.rayArrays(), pose, spec, covariance.data(), actual.data());
      for (std::size_t i = 0; i < 61; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-9 * (1 + expected[i]));
    }
  }
}

// With one ray J^T J is the square of the error's derivative, which the Sampson denominator enters.
TEST(Kernels, OneRaysInformationIsTheSquareOfTheCentralDifferenceOfItsError) {
  test::Random random(test::testSeed(), 15);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Data data(random, 1, 4);
    const FocalPose pose = data.arrays.normalization().apply(test::perturbed(random, data.scene.truth, 0.02, 0.2, 0.05));
    const auto error = [&](const FocalPose& at) {
      double squared[correspondences::kPadding];
      kernels().squaredRayErrors(data.arrays.rayArrays(), toPlain(at), squared);
      return std::sqrt(squared[0]);
    };
    if (!(error(pose) > 1 && error(pose) < 1e6)) continue;  // where the sign changes there is no derivative
    Eigen::Matrix<double, kParameters, 1> derivative;
    const double h = 1e-6;
    for (int i = 0; i < kParameters; ++i) derivative[i] = (error(moved(pose, i, h)) - error(moved(pose, i, -h))) / (2 * h);
    if (!derivative.allFinite()) continue;
    const NormalEquations at = sums(math::supportedSimdLevel(), data, pose, {}, false, true);
    const double tolerance = 1e-5 * derivative.squaredNorm();
    for (int row = 0; row < kParameters; ++row)
      for (int column = row; column < kParameters; ++column)
        EXPECT_NEAR(at.hessian[row][column], derivative[row] * derivative[column], tolerance);
  }
}

// The same for one point, which has two errors.
TEST(Kernels, APointsInformationIsTheSquareOfTheCentralDifferencesOfItsProjection) {
  test::Random random(test::testSeed(), 19);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Data data(random, 1, 1);
    const FocalPose pose = test::perturbed(random, data.scene.truth, 0.02, 0.2, 0.05);
    const FocalPose normalized = data.arrays.normalization().apply(pose);
    const Eigen::Vector3d point = data.arrays.points()[0].point;
    const auto projection = [&](const FocalPose& at) {
      const Eigen::Vector3d y = at.rotation.transpose() * (point - at.position);
      return Eigen::Vector2d(at.focalLength * y[0] / y[2], at.focalLength * y[1] / y[2]);
    };
    Eigen::Matrix<double, 2, kParameters> derivative;
    const double h = 1e-6;
    for (int i = 0; i < kParameters; ++i)
      derivative.col(i) = (projection(moved(normalized, i, h)) - projection(moved(normalized, i, -h))) / (2 * h);
    const Eigen::Matrix<double, kParameters, kParameters> expected = derivative.transpose() * derivative;
    for (const SimdLevel level : levels()) {
      const NormalEquations at = sums(level, data, normalized, {}, true, false);
      for (int row = 0; row < kParameters; ++row)
        for (int column = row; column < kParameters; ++column)
          EXPECT_NEAR(at.hessian[row][column], expected(row, column),
                      1e-6 * std::sqrt(expected(row, row) * expected(column, column)) + 1e-3);
    }
  }
}

TEST(Kernels, NormalEquationsAreEqualAtAllLevels) {
  test::Random random(test::testSeed(), 16);
  const Data data(random, 61, 63);
  for (const Loss loss : kLosses) {
    const FocalPose pose = data.arrays.normalization().apply(data.poses[1]);
    const KindLoss spec{loss, 20, 0.5, 50};
    const NormalEquations expected = sums(SimdLevel::Baseline, data, pose, spec, true, true);
    for (const SimdLevel level : levels()) {
      const NormalEquations actual = sums(level, data, pose, spec, true, true);
      if (std::isfinite(expected.cost)) {
        EXPECT_NEAR(actual.cost, expected.cost, 1e-9 * expected.cost);
      }
      for (int row = 0; row < kParameters; ++row)
        for (int column = row; column < kParameters; ++column)
          EXPECT_NEAR(actual.hessian[row][column], expected.hessian[row][column], 1e-7 * expected.hessian[0][0]);
    }
  }
}

}  // namespace
}  // namespace hybridgv

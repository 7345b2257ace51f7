#include "robust/RaySlope.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "HybridScene.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kFocalLength = 5000, kNoise = 1, kDepth = 100;

FocalPose cameraAt(const Eigen::Vector3d& position) {
  FocalPose camera;
  camera.rotation.setIdentity();
  camera.position = position;
  camera.focalLength = kFocalLength;
  return camera;
}

struct Facade {
  double relief, baseline;  // of the depth
};

// A long lens before a facade, and rig cameras around it.
test::HybridScene makeScene(test::Random& random, const Facade& facade, double noise, int rays = 100, int points = 40) {
  constexpr int kCameras = 6;
  test::HybridScene scene;
  scene.truth = cameraAt({0, 0, 0});
  for (int k = 0; k < kCameras; ++k) {
    scene.offsets.push_back(facade.baseline * kDepth * random.vector(-1, 1));
    scene.rotations.push_back(Eigen::Matrix3d::Identity());
  }
  const auto scenePoint = [&] {
    const double z = kDepth * (1 + facade.relief * random.uniform(-1, 1)), x = random.uniform(-0.1, 0.1),
                 y = random.uniform(-0.1, 0.1);
    return Eigen::Vector3d(x * z, y * z, z);
  };
  for (int i = 0; i < rays; ++i) {
    const int k = i % kCameras;
    const Eigen::Vector3d point = scenePoint(), &centre = scene.offsets[static_cast<std::size_t>(k)];
    scene.image2d2d.push_back(test::noisyImagePoint(random, test::project(scene.truth, point), noise));
    const Eigen::Vector3d inMap = test::noisyImagePoint(random, test::project(cameraAt(centre), point), noise);
    scene.bearings.push_back(Eigen::Vector3d(inMap.x(), inMap.y(), kFocalLength).normalized());
    scene.cameras.push_back(k);
  }
  for (int i = 0; i < points; ++i) {
    scene.points.push_back(scenePoint());
    scene.image2d3d.push_back(test::noisyImagePoint(random, test::project(scene.truth, scene.points.back()), noise));
  }
  return scene;
}

struct Problem {
  explicit Problem(const test::HybridScene& scene)
      : adapter(scene.adapter()), arrays(arraysOf(scene)), pose(arrays.normalization().apply(scene.truth)) {
    const KindLoss inliers{Loss::Truncated, 7 * kNoise, 1 / (kNoise * kNoise)};
    problem = makeProblem(arrays, inliers, inliers);
  }
  correspondences::CorrespondenceArrays arraysOf(const test::HybridScene& scene) {
    adapter.setRigFocalLengths(std::vector<double>(scene.offsets.size(), kFocalLength));
    return {adapter, correspondences::allIndices(scene.bearings.size()), correspondences::allIndices(scene.points.size())};
  }
  ParameterMatrix ofPoints() const { return information(withoutRays(problem), pose); }
  std::optional<RaySlope> slope() const { return raySlope(problem, arrays, pose, {kNoise, 0}); }
  double varianceBySlope(double weight = 1) const {
    ParameterMatrix covariance;
    EXPECT_TRUE(covarianceBySlope(ofPoints(), *slope(), weight, covariance));
    return varianceOfLogFocalLength(covariance, {});
  }
  double varianceByInformation() const {
    ParameterMatrix covariance;
    EXPECT_TRUE(invertInformation(information(problem, pose), covariance));
    return varianceOfLogFocalLength(covariance, {});
  }

  NoncentralHybridAdapter adapter;
  correspondences::CorrespondenceArrays arrays;
  QueryPose pose;
  LeastSquaresProblem problem;
};

constexpr Facade kFlat{0.02, 0.02}, kDeep{0.3, 0.3};

TEST(RaySlope, IsNotNeededWhereBaselinesAreWide) {
  test::Random random(test::testSeed(), 180);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(Problem(makeScene(random, kDeep, kNoise)).slope());
}

TEST(RaySlope, IsNotNeededWithoutRaysOrWithoutInliers) {
  test::Random random(test::testSeed(), 181);
  const test::HybridScene scene = makeScene(random, kFlat, kNoise);
  Problem withoutRays(scene);
  withoutRays.problem.kinds.rays = false;
  EXPECT_FALSE(withoutRays.slope());
  Problem withoutInliers(scene);
  withoutInliers.problem.rayLoss.scale = 1e-9;
  EXPECT_FALSE(withoutInliers.slope());
  EXPECT_FALSE(Problem(makeScene(random, kFlat, kNoise, 0)).slope());
}

// Along the line of sight the noise pretends to a relief; the slope is that of exact images nevertheless, and the scatter what noisy ones say.
TEST(RaySlope, IsTheInformationOfExactImages) {
  std::vector<double> slopes, scatters, pretences;
  for (std::uint64_t i = 0; i < 100; ++i) {
    test::Random random(test::testSeed() + i, 182), again(test::testSeed() + i, 182);
    const Problem noisy(makeScene(random, kFlat, kNoise)), exact(makeScene(again, kFlat, 0));
    // In the direction in which only the relief tells: farther away with a longer lens.
    ParameterVector direction = ParameterVector::Zero(7);
    direction[5] = -kDepth / noisy.arrays.normalization().unit;
    direction[6] = 1;
    const auto along = [&](const ParameterMatrix& matrix) { return direction.dot(matrix * direction); };
    const std::optional<RaySlope> found = noisy.slope();
    ASSERT_TRUE(found);
    const auto ofRays = [&](const Problem& p) { return along(information(p.problem, p.pose) - p.ofPoints()); };
    slopes.push_back(along(found->slope) / ofRays(exact));
    scatters.push_back(along(found->scatter) / ofRays(noisy));
    pretences.push_back(ofRays(noisy) / ofRays(exact));
  }
  EXPECT_GT(test::median(pretences), 3);
  EXPECT_NEAR(test::median(slopes), 1, 0.15);
  EXPECT_NEAR(test::median(scatters), 1, 0.3);
}

TEST(RaySlope, TheDeviationIsLargerThanByTheInformation) {
  test::Random random(test::testSeed(), 184);
  for (int i = 0; i < 50; ++i) {
    const Problem problem(makeScene(random, kFlat, kNoise));
    EXPECT_GT(problem.varianceBySlope(), problem.varianceByInformation());
  }
}

TEST(RaySlope, TheBestWeightGivesTheLeastDeviation) {
  test::Random random(test::testSeed(), 185);
  int smaller = 0;
  for (int i = 0; i < 50; ++i) {
    const Problem problem(makeScene(random, kFlat, kNoise));
    const double weight = bestWeight(problem.ofPoints(), *problem.slope(), {});
    const double least = problem.varianceBySlope(weight);
    EXPECT_LE(least, problem.varianceBySlope());
    if (weight == 1) continue;
    ++smaller;
    EXPECT_LE(least, problem.varianceBySlope(2 * weight));
    if (weight > 2e-3) {  // it is never less than 1e-3
      EXPECT_LE(least, problem.varianceBySlope(weight / 2));
    }
  }
  EXPECT_GT(smaller, 25);
}

TEST(RaySlope, WithAKnownFocalLengthTheWeightIsTheBestForThePosition) {
  test::Random random(test::testSeed(), 186);
  Intrinsics known;
  known.focalLength = false;
  int smaller = 0;
  for (int i = 0; i < 50; ++i) {
    Problem problem(makeScene(random, kFlat, kNoise));
    problem.problem.estimated = known;
    problem.problem.kernels = &kernels(CameraModel::CalibratedPinhole);
    const std::optional<RaySlope> rays = problem.slope();
    const auto varianceFor = [&](double weight) {
      ParameterMatrix covariance;
      EXPECT_TRUE(covarianceBySlope(problem.ofPoints(), *rays, weight, covariance));
      return covariance.diagonal().segment<3>(3).sum();
    };
    const double weight = bestWeight(problem.ofPoints(), *rays, known);
    EXPECT_LE(varianceFor(weight), varianceFor(1));
    smaller += weight < 1;
  }
  EXPECT_GT(smaller, 10);
}

// What lies far before the facade tells of the focal length, unless so many would be inliers by chance.
TEST(RaySlope, TheForegroundIsTrustedAsFarAsItIsNotChance) {
  test::Random random(test::testSeed(), 187);
  test::HybridScene scene = makeScene(random, kFlat, kNoise);
  for (int i = 0; i < 6; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Eigen::Vector3d point = 0.2 * scene.points[at];
    scene.image2d2d[at] = test::noisyImagePoint(random, test::project(scene.truth, point), kNoise);
    const Eigen::Vector3d centre = scene.offsets[static_cast<std::size_t>(scene.cameras[at])];
    scene.bearings[at] = (point - centre).normalized();
  }
  const Problem problem(scene);
  const auto varianceFor = [&](double byChance) {
    ParameterMatrix covariance;
    const std::optional<RaySlope> rays = raySlope(problem.problem, problem.arrays, problem.pose, {kNoise, byChance});
    EXPECT_TRUE(covarianceBySlope(problem.ofPoints(), *rays, 1, covariance));
    return varianceOfLogFocalLength(covariance, {});
  };
  EXPECT_LT(10 * varianceFor(0), varianceFor(3));
  EXPECT_LT(varianceFor(0.5), varianceFor(3));
}

// There the depths are not known at all, and what divides by the distance must not be more than a number.
TEST(RaySlope, RigCamerasInTheQuerysPlaceLeaveNumbers) {
  test::Random random(test::testSeed(), 188);
  for (const double distance : {0., 1e-300, 1e-170, 1e-150, 1e-12, 1e-3}) {
    test::HybridScene scene = makeScene(random, kFlat, kNoise);
    for (std::size_t k = 0; k < 3; ++k) scene.offsets[k] = scene.truth.position + distance * random.direction();
    const Problem problem(scene);
    const std::optional<RaySlope> rays = problem.slope();
    ASSERT_TRUE(rays) << distance;
    EXPECT_TRUE(rays->slope.allFinite() && rays->scatter.allFinite()) << distance;
    const double weight = bestWeight(problem.ofPoints(), *rays, {});
    EXPECT_TRUE(weight > 0 && weight <= 1) << distance;
  }
}

FullParameterMatrix randomCovariance(test::Random& random) {
  FullParameterMatrix factor;
  for (Eigen::Index i = 0; i < factor.size(); ++i) factor.data()[i] = random.normal();
  return factor * factor.transpose() + 0.1 * FullParameterMatrix::Identity();
}

// In no direction smaller than either, nor larger than both together.
TEST(Enlarged, LiesBetweenBothAndTheirSum) {
  test::Random random(test::testSeed(), 178);
  for (int i = 0; i < 20; ++i) {
    const FullParameterMatrix base = randomCovariance(random), other = randomCovariance(random);
    const FullParameterMatrix found = enlarged(base.llt().matrixL(), other);
    const auto leastOf = [](const FullParameterMatrix& matrix) { return eigendecomposition(matrix).values[0]; };
    EXPECT_GT(leastOf(found - base), -1e-9);
    EXPECT_GT(leastOf(found - other), -1e-9);
    EXPECT_GT(leastOf(base + other - found), -1e-9);
  }
}

TEST(Enlarged, IsTheBaseWhereTheOtherIsSmallerOrAllowed) {
  test::Random random(test::testSeed(), 189);
  const FullParameterMatrix base = randomCovariance(random), L = base.llt().matrixL();
  EXPECT_TRUE(enlarged(L, 0.5 * base).isApprox(base, 1e-9));
  EXPECT_TRUE(enlarged(L, 1.5 * base, 0.5).isApprox(base, 1e-9));
  EXPECT_TRUE(enlarged(L, 3 * base, 0.5).isApprox(2.5 * base, 1e-9));
}

}  // namespace
}  // namespace hybridgv

// hybridRansac where the principal point is not known exactly.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "HybridScene.hpp"
#include "WideScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac::hybridRansac;
using sac::HybridRansacOptions;
using sac::HybridRansacResult;
using Covariance = Eigen::Matrix<double, 7, 7>;

constexpr double kDeviation = 5;  // [px]
constexpr double kDistortion = -3e-7;

enum class Case { Pinhole, KnownFocalLength, Radial };

HybridScene makeScene(Random& random, Case which, int matches = 50) {
  if (which == Case::Radial) {
    WideSceneOptions options;
    options.rays = options.points = matches;
    options.imageNoise = 1;
    options.outlierShare = 0.3;
    options.lens = divisionLens(kDistortion);
    return makeWideScene(random, options);
  }
  SceneOptions options;
  options.rays = options.points = matches;
  options.imageNoise = 1;
  options.outlierShareRays = options.outlierSharePoints = 0.3;
  return makeHybridScene(random, options);
}

HybridScene withWrongPrincipalPoint(HybridScene scene, Random& random) {
  const double du = kDeviation * random.normal(), dv = kDeviation * random.normal();
  for (std::vector<Eigen::Vector3d>* image : {&scene.image2d2d, &scene.image2d3d})
    for (Eigen::Vector3d& point : *image) point += Eigen::Vector3d(du, dv, 0);
  return scene;
}

HybridRansacOptions optionsFor(Case which, const HybridScene& scene, double deviation) {
  HybridRansacOptions options;
  options.principalPointDeviationPx = deviation;
  if (which == Case::KnownFocalLength) options.knownFocalLengthPx = scene.truth.focalLength;
  if (which == Case::Radial) options.queryCamera = sac::QueryCamera::Radial;
  return options;
}

Covariance covarianceOf(const HybridRansacResult& result) { return Eigen::Map<const Covariance>(result.covariance.data()); }

Eigen::Vector3d turnOf(const FocalPose& from, const FocalPose& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(from.rotation.transpose() * to.rotation));
  return turn.angle() * turn.axis();
}

// Means of the squared errors over their variances, which are 1 if the covariance is right.
struct Calibration {
  double rotation = 0, position = 0, focalLength = 0, distortion = 0;
};

Calibration calibration(Case which, int matches, double deviation, std::uint64_t stream) {
  constexpr int kScenes = 300;
  Random random(testSeed(), stream);
  Calibration mean;
  for (int i = 0; i < kScenes; ++i) {
    const HybridScene scene = withWrongPrincipalPoint(makeScene(random, which, matches), random);
    HybridRansacOptions options = optionsFor(which, scene, deviation);
    options.seed = static_cast<std::uint64_t>(i);
    const HybridRansacResult result = hybridRansac(scene.adapter(), options);
    EXPECT_TRUE(result.success) << toString(result.failureReason);
    const Covariance covariance = covarianceOf(result);
    const auto squared = [](const Eigen::Vector3d& error, const Eigen::Matrix3d& of) {
      return error.dot(of.ldlt().solve(error));
    };
    mean.rotation += squared(turnOf(scene.truth, result.pose), covariance.block<3, 3>(0, 0)) / (3 * kScenes);
    mean.position += squared(result.pose.position - scene.truth.position, covariance.block<3, 3>(3, 3)) / (3 * kScenes);
    const double logError = std::log(result.pose.focalLength / scene.truth.focalLength);
    if (which != Case::KnownFocalLength) mean.focalLength += logError * logError / covariance(6, 6) / kScenes;
    if (which != Case::Radial) continue;
    EXPECT_GT(result.distortionStandardDeviation, 0);
    mean.distortion += std::pow((result.distortion - kDistortion) / result.distortionStandardDeviation, 2) / kScenes;
  }
  return mean;
}

void expectRight(const Calibration& mean, Case which) {
  EXPECT_GT(mean.rotation, 0.8);
  EXPECT_LT(mean.rotation, 1.25);
  EXPECT_GT(mean.position, 0.7);
  EXPECT_LT(mean.position, 1.4);
  if (which != Case::KnownFocalLength) {
    EXPECT_GT(std::sqrt(mean.focalLength), 0.85);
    EXPECT_LT(std::sqrt(mean.focalLength), 1.2);
  }
  if (which == Case::Radial) {
    EXPECT_GT(std::sqrt(mean.distortion), 0.8);
    EXPECT_LT(std::sqrt(mean.distortion), 1.3);
  }
}

TEST(PrincipalPoint, DeviationsAreThoseOfTheErrorsIfItsOwnIsStated) {
  expectRight(calibration(Case::Pinhole, 50, kDeviation, 960), Case::Pinhole);
  expectRight(calibration(Case::KnownFocalLength, 50, kDeviation, 961), Case::KnownFocalLength);
  expectRight(calibration(Case::Radial, 50, kDeviation, 962), Case::Radial);
}

// Else there is nothing to allow for.
TEST(PrincipalPoint, ErrorsAreLargerThanTheInliersSay) {
  EXPECT_GT(calibration(Case::Pinhole, 50, 0, 963).rotation, 8);
  EXPECT_GT(calibration(Case::Radial, 50, 0, 964).rotation, 20);
}

// Of correspondences so many that only a part is searched in.
TEST(PrincipalPoint, IsAllowedForInManyCorrespondences) {
  Random random(testSeed(), 965);
  const HybridScene scene = makeScene(random, Case::Pinhole, 1500);
  const Covariance without = covarianceOf(hybridRansac(scene.adapter(), optionsFor(Case::Pinhole, scene, 0)));
  const HybridRansacResult result = hybridRansac(scene.adapter(), optionsFor(Case::Pinhole, scene, kDeviation));
  EXPECT_TRUE(result.success);
  const Eigen::Vector3d before = without.diagonal().head<3>(), after = covarianceOf(result).diagonal().head<3>();
  EXPECT_GT(after.sum(), 100 * before.sum());
}

TEST(PrincipalPoint, LeavesEverythingButTheDeviationsAsItIs) {
  Random random(testSeed(), 967);
  for (const Case which : {Case::Pinhole, Case::KnownFocalLength, Case::Radial}) {
    const HybridScene scene = makeScene(random, which);
    const HybridRansacResult without = hybridRansac(scene.adapter(), optionsFor(which, scene, 0));
    const HybridRansacResult with = hybridRansac(scene.adapter(), optionsFor(which, scene, kDeviation));
    EXPECT_EQ(with.pose.rotation, without.pose.rotation);
    EXPECT_EQ(with.pose.position, without.pose.position);
    EXPECT_EQ(with.pose.focalLength, without.pose.focalLength);
    EXPECT_EQ(with.distortion, without.distortion);
    EXPECT_EQ(with.inliers2d2d, without.inliers2d2d);
    EXPECT_EQ(with.inliers2d3d, without.inliers2d3d);
    EXPECT_EQ(with.noise2d2d, without.noise2d2d);
    EXPECT_EQ(with.iterations, without.iterations);
    EXPECT_EQ(with.success, without.success);
    const Covariance added = covarianceOf(with) - covarianceOf(without);
    const Eigen::Matrix<double, 7, 1> sizes = Eigen::SelfAdjointEigenSolver<Covariance>(added).eigenvalues();
    EXPECT_GT(sizes[0], -1e-9 * sizes[6]) << "never smaller";
    EXPECT_GT(sizes[5], 0);
    EXPECT_LT(sizes[4], 1e-9 * sizes[6]) << "two errors span a plane";
    const bool isKnown = which == Case::KnownFocalLength;
    EXPECT_EQ(with.focalLengthStandardDeviation > without.focalLengthStandardDeviation, !isKnown);
    EXPECT_EQ(covarianceOf(with)(6, 6) == 0, isKnown);
    EXPECT_EQ(with.distortionStandardDeviation > without.distortionStandardDeviation, which == Case::Radial);
    EXPECT_EQ(with.simpleRadialK1StandardDeviation > without.simpleRadialK1StandardDeviation, which == Case::Radial);
  }
}

TEST(PrincipalPoint, GrowsWithTheSquareOfItsDeviation) {
  Random random(testSeed(), 968);
  const HybridScene scene = makeScene(random, Case::Pinhole);
  const auto run = [&](double deviation) {
    return covarianceOf(hybridRansac(scene.adapter(), optionsFor(Case::Pinhole, scene, deviation)));
  };
  const Covariance once = run(kDeviation) - run(0), twice = run(2 * kDeviation) - run(0);
  EXPECT_LT((twice - 4 * once).norm(), 1e-9 * twice.norm());
}

TEST(PrincipalPoint, GivesTheSameBitsForAnyNumberOfThreads) {
  Random random(testSeed(), 969);
  for (const Case which : {Case::Pinhole, Case::Radial}) {
    const HybridScene scene = makeScene(random, which);
    HybridRansacOptions options = optionsFor(which, scene, kDeviation);
    const HybridRansacResult one = hybridRansac(scene.adapter(), options);
    options.threads = 3;
    const HybridRansacResult three = hybridRansac(scene.adapter(), options);
    EXPECT_EQ(one.covariance, three.covariance);
    EXPECT_EQ(one.focalLengthStandardDeviation, three.focalLengthStandardDeviation);
  }
}

// The focal length is not determined if the principal point may be anywhere.
TEST(PrincipalPoint, IsPartOfTheDeviationThatASuccessMayHave) {
  Random random(testSeed(), 970);
  const HybridScene scene = makeScene(random, Case::Pinhole);
  for (const double deviation : {1e6, 1e150, 1e300}) {
    const HybridRansacResult result = hybridRansac(scene.adapter(), optionsFor(Case::Pinhole, scene, deviation));
    EXPECT_FALSE(result.success) << deviation;
    EXPECT_EQ(result.failureReason, sac::FailureReason::UndeterminedPose);
    for (const double entry : result.covariance) EXPECT_FALSE(std::isnan(entry)) << deviation;
    EXPECT_GT(result.focalLengthStandardDeviation, scene.truth.focalLength);
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

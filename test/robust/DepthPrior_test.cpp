#include "robust/DepthPrior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "HybridScene.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A camera at the origin that looks along z, points about `depth` away, and a rig camera beside it whose rays meet those of the query at
// the given depths.
struct Scene {
  Scene(test::Random& random, double depth, int points, const std::vector<double>& depthsOfRays) {
    scene.truth.rotation.setIdentity();
    scene.truth.position.setZero();
    scene.truth.focalLength = 1000;
    scene.offsets.push_back({1, 0.5, 0.2});
    scene.rotations.push_back(Eigen::Matrix3d::Identity());
    for (int i = 0; i < points; ++i) {
      const Eigen::Vector3d point = pointAt(random, depth * random.uniform(0.8, 1.25));
      scene.points.push_back(point);
      scene.image2d3d.push_back(test::noisyImagePoint(random, test::project(scene.truth, point), 0));
    }
    for (const double depthOfRay : depthsOfRays) {
      const Eigen::Vector3d point = pointAt(random, depthOfRay);
      scene.image2d2d.push_back(test::noisyImagePoint(random, test::project(scene.truth, point), 0));
      scene.bearings.push_back((point - scene.offsets[0]).normalized());
      scene.cameras.push_back(0);
    }
  }
  static Eigen::Vector3d pointAt(test::Random& random, double depth) {
    const double x = random.uniform(-0.4, 0.4), y = random.uniform(-0.4, 0.4);
    return depth * Eigen::Vector3d(x, y, 1);
  }

  test::HybridScene scene;
};

// Everything is an inlier, rays only if they are told to be.
struct Tested {
  Tested(const Scene& of, bool raysCount = false, double deviation = 1)
      : adapter(of.scene.adapter()),
        arrays(adapter, correspondences::allIndices(of.scene.bearings.size()),
               correspondences::allIndices(of.scene.points.size())),
        prior(arrays, arrays.normalization().apply(of.scene.truth),
              {std::vector<double>(of.scene.bearings.size(), raysCount ? 0 : kInfinity),
               std::vector<double>(of.scene.points.size(), 0)},
              noise(deviation)) {}
  static PerKind<ErrorMixture> noise(double deviation) {
    ErrorMixture mixture;
    mixture.deviation = deviation;
    mixture.boundary = 3 * deviation;
    return {mixture, mixture};
  }

  NoncentralHybridAdapter adapter;
  correspondences::CorrespondenceArrays arrays;
  DepthPrior prior;
};

TEST(DepthPrior, FallsOffFromTheDepthOfThePointsAndFasterTowardsTheCameras) {
  test::Random random(test::testSeed(), 130);
  for (const double unit : {1e-3, 1., 1e4}) {
    Scene scene(random, 20, 15, {20, 10, 40, 5, 80, 1, 0.1});
    for (Eigen::Vector3d& point : scene.scene.points) point *= unit;
    scene.scene.offsets[0] *= unit;
    const Tested tested(scene, false, 0.01);
    const auto g = [&](std::size_t ray) { return tested.prior.plausibility(ray); };
    EXPECT_GT(g(0), 0.8);
    EXPECT_LT(g(1), g(2));
    EXPECT_LT(g(2), g(0));
    EXPECT_LT(g(3), g(1));
    EXPECT_LT(g(4), g(2));
    EXPECT_LT(g(5), 0.01);
    EXPECT_LT(g(6), 1e-4);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_TRUE(g(i) > 0 && g(i) <= 1) << g(i);
  }
}

TEST(DepthPrior, HonestForegroundStaysPlausible) {
  test::Random random(test::testSeed(), 131);
  const Tested tested(Scene(random, 20, 15, {12, 15, 28, 35}), false, 0.01);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(tested.prior.plausibility(i), 0.2);
}

// With points from 1 to 1000, no depth between is strange.
TEST(DepthPrior, IsAsWideAsTheScene) {
  test::Random random(test::testSeed(), 132);
  Scene scene(random, 30, 0, {3, 300});
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d point = Scene::pointAt(random, std::pow(10, random.uniform(0, 3)));
    scene.scene.points.push_back(point);
    scene.scene.image2d3d.push_back(test::noisyImagePoint(random, test::project(scene.scene.truth, point), 0));
  }
  const Tested tested(scene, false, 1e-3);
  EXPECT_GT(tested.prior.plausibility(0), 0.02);
  EXPECT_GT(tested.prior.plausibility(1), 0.3);
}

TEST(DepthPrior, WithFewPointsTheRaysTellTheDepth) {
  test::Random random(test::testSeed(), 133);
  const Tested tested(Scene(random, 20, 2, {20, 19, 21, 20, 22, 18, 20, 0.5}), true, 0.01);
  EXPECT_GT(tested.prior.plausibility(0), 0.8);
  EXPECT_LT(tested.prior.plausibility(7), 0.01);
}

// A ray that meets its viewing ray nowhere in front of the query, or so far away that noise decides, is as far as noise can tell.
TEST(DepthPrior, BeyondInfinityIsFarAway) {
  test::Random random(test::testSeed(), 134);
  Scene scene(random, 20, 15, {1e9, 20, 20});
  scene.scene.bearings[1] = Eigen::Vector3d(0.9, 0, 1).normalized();
  scene.scene.image2d2d[1] = {0, 0, 1};  // diverges from it
  scene.scene.bearings[2] = Eigen::Vector3d(0.001, 0, 1).normalized();
  scene.scene.image2d2d[2] = {1, 0, 1};  // parallel to it
  const Tested tested(scene);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(tested.prior.plausibility(i), 0) << i;
    EXPECT_LT(tested.prior.plausibility(i), 0.2) << i;
  }
}

TEST(DepthPrior, WithoutInliersEveryDepthIsPlausible) {
  test::Random random(test::testSeed(), 135);
  const Tested tested(Scene(random, 20, 0, {0.1, 20, 1e6}));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(tested.prior.plausibility(i), 1);
}

// A ray from the query's own position meets every viewing ray there.
TEST(DepthPrior, ARayThroughTheQueryIsANumber) {
  test::Random random(test::testSeed(), 136);
  Scene scene(random, 20, 10, {20});
  scene.scene.offsets[0].setZero();
  scene.scene.bearings[0] = scene.scene.points[0].normalized();
  scene.scene.image2d2d[0] = scene.scene.image2d3d[0];
  const double g = Tested(scene).prior.plausibility(0);
  EXPECT_TRUE(g >= 0 && g <= 1) << g;
}

}  // namespace
}  // namespace hybridgv

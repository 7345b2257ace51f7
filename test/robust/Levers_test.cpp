#include "robust/Levers.hpp"

#include <gtest/gtest.h>

#include "HybridScene.hpp"
#include "robust/Leverage.hpp"
#include "robust/LocalOptimizer.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr Loss kLosses[] = {Loss::Quadratic, Loss::Truncated, Loss::Mixture};

// Random points, and one ray whose error is 0 without any rounding: all that enters it lies in the plane y = 0.
test::HybridScene makeScene(test::Random& random) {
  test::HybridScene scene;
  scene.truth.rotation.setIdentity();
  scene.truth.position = {0, 0, -20};
  scene.truth.focalLength = 1000;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d point = random.vector(-5, 5);
    scene.points.push_back(point);
    scene.image2d3d.push_back(test::noisyImagePoint(random, test::project(scene.truth, point), 0));
  }
  scene.offsets.push_back({6, 0, -18});
  scene.rotations.push_back(Eigen::Matrix3d::Identity());
  scene.image2d2d.push_back({0, 0, 1});
  scene.bearings.push_back(Eigen::Vector3d(-6, 0, 19).normalized());
  scene.cameras.push_back(0);
  return scene;
}

// The points are so noisy that the ray decides alone.
LeastSquaresProblem problemOf(const correspondences::CorrespondenceArrays& arrays, Loss loss) {
  return makeProblem(arrays, {Loss::Quadratic, 1, 1e-8}, {loss, 1, 1, 50});
}

correspondences::CorrespondenceArrays readAll(const NoncentralHybridAdapter& adapter) {
  return {adapter, correspondences::allIndices(adapter.getNumberCorrespondences2d2d()),
          correspondences::allIndices(adapter.getNumberCorrespondences2d3d())};
}

TEST(Levers, ARefusedRayWithoutErrorDoesNotCount) {
  test::Random random(test::testSeed(), 96);
  const test::HybridScene scene = makeScene(random);
  const correspondences::CorrespondenceArrays arrays = readAll(scene.adapter());
  const QueryPose pose = arrays.normalization().apply(scene.truth);
  ASSERT_EQ(PoseScorer(arrays, {1, 1}, sac::Scoring::Msac).squaredRayErrors(pose)[0], 0);
  RayTreatment treatment(1);
  treatment.refuse({0});
  const correspondences::PaddedValues narrowing = treatment.narrowing();
  for (const Loss loss : kLosses) {
    LeastSquaresProblem problem = problemOf(arrays, loss);
    EXPECT_GT(rayLeverages(problem, pose)[0], 0.9);
    problem.rays.narrowing = narrowing.pointer();
    EXPECT_EQ(rayLeverages(problem, pose)[0], 0);
    LeastSquaresProblem withoutRays = problem;
    withoutRays.kinds.rays = false;
    EXPECT_EQ(information(problem, pose), information(withoutRays, pose));
    EXPECT_EQ(minimize(problem, pose).cost, minimize(withoutRays, pose).cost);
  }
}

TEST(Levers, AreFoundOnceIfTheyHaveNoError) {
  test::Random random(test::testSeed(), 97);
  const test::HybridScene scene = makeScene(random);
  const correspondences::CorrespondenceArrays arrays = readAll(scene.adapter());
  const QueryPose pose = arrays.normalization().apply(scene.truth);
  for (const Loss loss : kLosses)
    EXPECT_EQ(leversOf(problemOf(arrays, loss), pose, RayTreatment(1)).rays, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace hybridgv

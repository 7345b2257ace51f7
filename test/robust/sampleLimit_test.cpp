// How many samples few correspondences have, and that a search ends where they do.
#include "robust/sampleLimit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "HybridScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using correspondences::allIndices;

// Five rays of camera 0, two of camera 1, one of camera 2; three points.
Sampler makeSampler() { return {{0, 0, 0, 0, 0, 1, 1, 2}, allIndices(8), allIndices(3), false}; }

TEST(SampleLimit, CountsTheDifferentSamples) {
  const Sampler sampler = makeSampler();
  EXPECT_EQ(numberOfSamples(sampler, {1, 3, RayDraw::Uniform}), 8);
  EXPECT_EQ(numberOfSamples(sampler, {3, 2, RayDraw::Uniform}), 56 * 3);
  EXPECT_EQ(numberOfSamples(sampler, {5, 1, RayDraw::OneCamera}), 3);
  EXPECT_EQ(numberOfSamples(sampler, {6, 1, RayDraw::AllButOne}), 3 * 3);
  EXPECT_EQ(numberOfSamples(sampler, {0, 4, RayDraw::Uniform}), 0);
}

sac::HybridRansacResult localize(int rays, int points, std::uint64_t stream) {
  test::Random random(test::testSeed(), stream);
  test::SceneOptions options;
  options.rays = rays;
  options.points = points;
  return sac::hybridRansac(test::makeHybridScene(random, options).adapter());
}

TEST(SampleLimit, ASearchThatCannotSucceedEndsAfterAFewSamples) {
  for (const auto& [rays, points] : {std::pair{5, 1}, std::pair{3, 2}, std::pair{1, 3}, std::pair{0, 4}, std::pair{2, 4}}) {
    const sac::HybridRansacResult result = localize(rays, points, 97);
    EXPECT_FALSE(result.success);
    EXPECT_EQ(result.stopReason, sac::StopReason::NoMoreSamples) << rays << " + " << points;
    EXPECT_LE(result.iterations, 24);
    EXPECT_GT(result.score, 0) << "there is a pose to look at";
  }
  EXPECT_EQ(localize(5, 1, 98).iterations, 1);
}

// H70f of rays from several cameras, or P3P.
std::vector<Strategy> strategiesOf(Solver solver) {
  return makeStrategies({{solver, 1}}, Sampler({0, 1, 2, 3, 4, 5, 6}, allIndices(7), allIndices(7), false));
}

CorrespondenceArrays arraysOf(int rays, int points) {
  test::Random random(test::testSeed(), 95);
  test::SceneOptions options;
  options.rays = rays;
  options.points = points;
  const test::HybridScene scene = test::makeHybridScene(random, options);
  CorrespondenceArrays arrays(scene.adapter(), allIndices(scene.bearings.size()), allIndices(scene.points.size()));
  arrays.fixUnknownFocalLengths(1);
  return arrays;
}

TEST(LeastSupports, AreMetSoonerTheFewerCorrespondencesThereAre) {
  double before = 0;
  for (const int points : {8, 12, 20, 40}) {
    const CorrespondenceArrays arrays = arraysOf(0, points);
    const ChanceModel chance(arrays, 6, 12);
    const Sampler sampler({}, {}, allIndices(static_cast<std::size_t>(points)), false);
    const LeastSupports supports(sampler, strategiesOf(Solver::P3P), 1, chance, 7, 0);
    EXPECT_EQ(supports.missProbability({0}), 1);
    const double miss = supports.missProbability({100});
    EXPECT_GT(miss, before) << points;
    EXPECT_LT(miss, 1) << points;
    EXPECT_NEAR(supports.missProbability({200}), miss * miss, 1e-9);
    const LeastSupports ofThreeLenses(sampler, strategiesOf(Solver::P3P), 3, chance, 7, 0);
    EXPECT_GT(ofThreeLenses.missProbability({100}), miss);
    before = miss;
  }
}

// A solver for which they are too few does not meet them.
TEST(LeastSupports, AreNotMetByAnotherSolver) {
  const CorrespondenceArrays arrays = arraysOf(20, 20);
  const ChanceModel chance(arrays, 6, 12);
  std::vector<int> cameras(20);
  for (std::size_t i = 0; i < cameras.size(); ++i) cameras[i] = static_cast<int>(i);
  const Sampler sampler(cameras, allIndices(20), allIndices(20), false);
  std::vector<Strategy> both = strategiesOf(Solver::P3P);
  for (const Strategy& strategy : strategiesOf(Solver::H70f)) both.push_back(strategy);
  ASSERT_EQ(both.size(), 2u);
  const LeastSupports supports(sampler, both, 1, chance, 7, 0);
  EXPECT_GT(supports.missProbability({1000000, 0}), 0.99);
  EXPECT_GT(supports.missProbability({0, 1000000}), 0.99);
  EXPECT_LT(supports.missProbability({1000000, 1000000}), 0.01);
}

TEST(SampleLimit, FewRaysAloneAreGivenUpWhenNothingCanHaveBeenMissed) {
  test::Random random(test::testSeed(), 94);
  test::SceneOptions options;
  options.rays = 20;
  options.points = 0;
  options.outlierShareRays = 1;
  test::HybridScene scene = test::makeHybridScene(random, options);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) scene.cameras[i] = static_cast<int>(i % scene.offsets.size());
  ASSERT_LE(scene.cameras.size(), 5 * scene.offsets.size());
  const sac::HybridRansacResult result = sac::hybridRansac(scene.adapter());
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.stopReason, sac::StopReason::NoMoreSamples);
  EXPECT_LT(result.iterations, 1000);
}

// Each sample of rays from several cameras takes milliseconds.
TEST(SampleLimit, SoDoesOneOfRaysAloneThatAreTooFewToBeReliedOn) {
  for (const int rays : {8, 10, 13, 15}) {
    test::Random random(test::testSeed(), 96);
    test::SceneOptions options;
    options.rays = rays;
    options.points = 0;
    options.outlierShareRays = 1;
    const sac::HybridRansacResult result = sac::hybridRansac(test::makeHybridScene(random, options).adapter());
    EXPECT_FALSE(result.success);
    EXPECT_EQ(result.stopReason, sac::StopReason::NoMoreSamples) << rays;
    EXPECT_LE(result.iterations, 24);
  }
}

// Inliers are not spread over cameras and kinds as LeastSupports takes them to be; still it ends no search that would have found something.
TEST(SampleLimit, WhatLongerSearchesFindIsNotGivenUp) {
  int found = 0, lost = 0, sooner = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    test::Random random(test::testSeed() + i, 93);
    test::SceneOptions scene;
    scene.rays = 10 + random.below(30);
    scene.points = random.below(10);
    scene.cameras = 2 + random.below(6);
    scene.imageNoise = random.uniform(0.02, 0.5);
    scene.outlierShareRays = random.uniform(0.1, 0.7);
    scene.outlierSharePoints = random.uniform(0, 1);
    const test::HybridScene data = test::makeHybridScene(random, scene);
    sac::HybridRansacOptions options;
    options.knownFocalLengthPx = data.truth.focalLength;
    const sac::HybridRansacResult result = sac::hybridRansac(data.adapter(), options);
    options.successProbability = 1 - 1e-15;
    const sac::HybridRansacResult longer = sac::hybridRansac(data.adapter(), options);
    found += longer.success;
    lost += longer.success && !result.success;
    sooner += !longer.success && result.iterations < longer.iterations;
  }
  EXPECT_GT(found, 40);
  EXPECT_LE(lost, 1);
  EXPECT_GT(sooner, 10);
}

TEST(SampleLimit, EnoughCorrespondencesAreNotLimited) {
  const sac::HybridRansacResult result = localize(20, 20, 99);
  EXPECT_TRUE(result.success);
  EXPECT_EQ(result.stopReason, sac::StopReason::Confident);
}

}  // namespace
}  // namespace hybridgv

// How many samples few correspondences have, and that a search ends where they do.
#include "robust/sampleLimit.hpp"

#include <gtest/gtest.h>

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

TEST(SampleLimit, EnoughCorrespondencesAreNotLimited) {
  const sac::HybridRansacResult result = localize(20, 20, 99);
  EXPECT_TRUE(result.success);
  EXPECT_EQ(result.stopReason, sac::StopReason::Confident);
}

}  // namespace
}  // namespace hybridgv

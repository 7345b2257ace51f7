#include "robust/Lens.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "WideScene.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using correspondences::CorrespondenceArrays;

CorrespondenceArrays read(const test::HybridScene& scene) {
  return {scene.adapter(), correspondences::allIndices(scene.bearings.size()), correspondences::allIndices(scene.points.size())};
}

TEST(Lens, IsMeasuredByTheImagesRadius) {
  test::Random random(test::testSeed(), 150);
  const CorrespondenceArrays arrays = read(test::makeWideScene(random, {}));
  sac::HybridRansacOptions options;
  EXPECT_FALSE(makeLens(arrays, options).isUnknown);
  options.queryCamera = sac::QueryCamera::Radial;
  double largest = 0;
  for (const auto& match : arrays.rays()) largest = std::max(largest, std::hypot(match.u, match.v));
  for (const auto& match : arrays.points()) largest = std::max(largest, std::hypot(match.u, match.v));
  EXPECT_EQ(arrays.imageRadius(), largest);
  for (const double given : {0., 2000.}) {
    options.imageRadiusPx = given;
    const double radius = given > 0 ? given : largest;
    const Lens lens = makeLens(arrays, options);
    EXPECT_TRUE(lens.isUnknown);
    EXPECT_NEAR(lens.prior.scale * radius * radius, options.distortionScale, 1e-12);
    EXPECT_NEAR(lens.least * radius * radius, kLeastDistortion, 1e-12);
    EXPECT_NEAR(lens.largest * radius * radius, kLargestDistortion, 1e-12);
    ASSERT_EQ(lens.hypotheses.size(), options.distortionHypotheses.size());
    EXPECT_NEAR(lens.hypotheses[2] * radius * radius, options.distortionHypotheses[2], 1e-12);
  }
}

TEST(Lens, OfImagePointsAtTheCentreOrNoneIsAPinhole) {
  sac::HybridRansacOptions options;
  options.queryCamera = sac::QueryCamera::Radial;
  test::HybridScene scene;
  EXPECT_FALSE(makeLens(read(scene), options).isUnknown);
  scene.points.assign(5, {1, 2, 3});
  scene.image2d3d.assign(5, {0, 0, 1});
  EXPECT_EQ(read(scene).imageRadius(), 0);
  EXPECT_FALSE(makeLens(read(scene), options).isUnknown);
  for (const double coordinate : {1e200, 1e-200}) {  // their squares are no numbers
    scene.image2d3d.assign(5, {coordinate, 0, 1});
    EXPECT_FALSE(makeLens(read(scene), options).isUnknown);
  }
}

TEST(Lens, AFewImagePointsFarAwayDoNotDecideItsUnit) {
  test::Random random(test::testSeed(), 151);
  test::HybridScene scene = test::makeWideScene(random, {});
  const double radius = read(scene).imageRadius();
  scene.image2d3d[3] = {1e7, 0, 1};
  EXPECT_LT(read(scene).imageRadius(), 2 * radius);
}

// The prior's density over the posterior's at 0. The posterior is likelihood times prior, here for a likelihood so sharp that the
// prior is even across it.
TEST(Lens, EvidenceIsTheRatioOfTheDensitiesAtZero) {
  const DistortionPrior prior{2e-8, 1};
  const double deviation = 1e-10, pi = 3.14159265358979323846;
  for (const double distortion : {0., 1e-10, 4e-10}) {
    const double priorAtZero = 1 / (pi * prior.scale);
    const double posteriorAtZero =
        std::exp(-distortion * distortion / (2 * deviation * deviation)) / (deviation * std::sqrt(2 * pi));
    EXPECT_NEAR(logEvidence(distortion, deviation, prior), std::log(priorAtZero / posteriorAtZero), 1e-9);
  }
  EXPECT_LT(logEvidence(0, deviation, prior), 0);
  EXPECT_GT(logEvidence(1e-9, deviation, prior), 10);
}

TEST(Lens, DataThatSayLessThanThePriorAreNoEvidence) {
  const DistortionPrior prior{2e-8, 1};
  for (const double timesPrior : {1., 3., 10., 1e6})
    for (const double z : {0., 0.1, 0.5}) {
      const double deviation = timesPrior * prior.scale;
      EXPECT_LT(logEvidence(z * deviation, deviation, prior), 0) << timesPrior << ", " << z;
    }
}

TEST(DistortionPrior, WeightIsHalfTheSlopeOfTheCostOverTheDistortion) {
  for (const DistortionPrior& prior : {DistortionPrior{1e-7, 1}, DistortionPrior{1e-8, 0.05}})
    for (const double c : {-3e-7, -1e-8, 1e-9, 1e-7}) {
      const double h = 1e-4 * std::abs(c);
      const double slope = (prior.cost(c + h) - prior.cost(c - h)) / (2 * h);
      EXPECT_NEAR(2 * prior.weight(c) * c, slope, 1e-5 * std::abs(slope));
    }
  EXPECT_EQ(DistortionPrior{}.cost(1e-7), 0);
  EXPECT_EQ(DistortionPrior{}.weight(1e-7), 0);
}

}  // namespace
}  // namespace hybridgv

#include "robust/Thresholds.hpp"

#include <gtest/gtest.h>

#include "HybridScene.hpp"
#include "robust/imageBox.hpp"

namespace hybridgv {
namespace robust {
namespace {

RobustBox::Size imageOf(double halfSize) {
  test::Random random(test::testSeed(), 9900);
  test::SceneOptions options;
  options.halfSize = halfSize;
  const test::HybridScene scene = test::makeHybridScene(random, options);
  return imageBox({scene.adapter(), correspondences::allIndices(scene.image2d2d.size()),
                   correspondences::allIndices(scene.image2d3d.size())});
}

TEST(ThresholdBounds, AreTheOnesThatAreGiven) {
  const Thresholds bounds = thresholdBounds({3, 5}, 1000, imageOf(5));
  EXPECT_EQ(bounds.rays, 3);
  EXPECT_EQ(bounds.points, 5);
  EXPECT_EQ(thresholdBounds({3, 0}, 0, imageOf(5)).rays, 3);
  EXPECT_EQ(thresholdBounds({0, 5}, 0, imageOf(5)).points, 5);
}

TEST(ThresholdBounds, GrowWithTheImageThatTheImagePointsFill) {
  const Thresholds large = thresholdBounds({}, 0, imageOf(5)), small = thresholdBounds({}, 0, imageOf(0.5));
  EXPECT_GT(large.rays, 5 * small.rays);
  EXPECT_NEAR(large.points / large.rays, 5, 1e-12);
  EXPECT_NEAR(small.points / small.rays, 5, 1e-12);
}

TEST(ThresholdBounds, OfASmallObjectFollowTheFocalLengthThatIsKnown) {
  constexpr double kFocalLength = 1000;
  const Thresholds unknown = thresholdBounds({}, 0, imageOf(0.5)), known = thresholdBounds({}, kFocalLength, imageOf(0.5));
  EXPECT_GT(known.rays, unknown.rays);
  EXPECT_NEAR(known.rays, 0.004 * kFocalLength, 1e-12);
  EXPECT_GE(known.points, known.rays);
  const Thresholds large = thresholdBounds({}, 0, imageOf(5));
  EXPECT_EQ(thresholdBounds({}, kFocalLength, imageOf(5)).rays, large.rays);
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

// What CorrespondenceArrays take for the size of the query's image.
#include <gtest/gtest.h>

#include <cmath>

#include "HybridScene.hpp"
#include "correspondences/CorrespondenceArrays.hpp"

namespace hybridgv {
namespace correspondences {
namespace {

CorrespondenceArrays arraysOf(const std::vector<Eigen::Vector3d>& imagePoints) {
  test::HybridScene scene;
  scene.image2d3d = imagePoints;
  scene.points.assign(imagePoints.size(), {1, 2, 3});
  return {scene.adapter(), {}, allIndices(imagePoints.size())};
}

std::vector<Eigen::Vector3d> evenImagePoints(test::Random& random, int count) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back({random.uniform(-500, 500), random.uniform(-500, 500), 1});
  return points;
}

TEST(ImageSize, IsTheWidthOfAnImageThatIsFilledEvenly) {
  test::Random random(test::testSeed(), 9870);
  const CorrespondenceArrays arrays = arraysOf(evenImagePoints(random, 4000));
  EXPECT_NEAR(arrays.imageSize(), 1000, 50);
  EXPECT_NEAR(arrays.leastImageSize(), 1000, 50);
  EXPECT_NEAR(arrays.imageRadius(), 707, 40);
}

TEST(ImageSize, AnEighthOfTheImagePointsFarAwayDoesNotDecide) {
  test::Random random(test::testSeed(), 9871);
  for (int i = 0; i < 100; ++i)
    for (const int strays : {1, 2, 10}) {
      std::vector<Eigen::Vector3d> points = evenImagePoints(random, 7 * strays + 7);
      for (int k = 0; k < strays; ++k) points.push_back({k % 2 == 0 ? 1e6 : 0, 1e6, 1});
      EXPECT_LT(arraysOf(points).imageSize(), 4000) << strays;
      EXPECT_LT(arraysOf(points).leastImageSize(), 1420) << strays;
      EXPECT_LT(arraysOf(points).imageRadius(), 5700) << strays;
    }
}

TEST(ImageSize, TheLeastIsNoLargerWhereImagePointsAreAtTheBorder) {
  test::Random random(test::testSeed(), 9872);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 60; ++i) points.push_back({random.uniform(380, 500), random.uniform(-500, 500), 1});
  EXPECT_LE(arraysOf(points).leastImageSize(), arraysOf(points).imageSize());
  EXPECT_NEAR(arraysOf(points).imageSize(), 1000, 30);
}

TEST(ImageSize, CountsBothKinds) {
  test::Random random(test::testSeed(), 9873);
  test::SceneOptions options;
  options.rays = options.points = 50;
  test::HybridScene scene = test::makeHybridScene(random, options);
  for (Eigen::Vector3d& point : scene.image2d2d) point = {random.uniform(400, 500), 0, 1};
  for (Eigen::Vector3d& point : scene.image2d3d) point = {random.uniform(0, 100), 0, 1};
  const CorrespondenceArrays arrays(scene.adapter(), allIndices(50), allIndices(50));
  EXPECT_NEAR(arrays.imageSize(), 980, 30);
  EXPECT_NEAR(arrays.leastImageSize(), 2 * std::sqrt(2.) * 100, 60);
}

TEST(ImageSize, OfImagePointsAtTheCentreOrNoneIsNothing) {
  for (const std::size_t count : {0, 1, 5}) {
    const CorrespondenceArrays arrays = arraysOf(std::vector<Eigen::Vector3d>(count, Eigen::Vector3d::UnitZ()));
    EXPECT_EQ(arrays.imageSize(), 0);
    EXPECT_EQ(arrays.leastImageSize(), 0);
    EXPECT_EQ(arrays.imageRadius(), 0);
  }
}

}  // namespace
}  // namespace correspondences
}  // namespace hybridgv

#include "robust/Evidence.hpp"

#include <gtest/gtest.h>

#include "HybridScene.hpp"

namespace hybridgv {
namespace test {
namespace {

using correspondences::allIndices;
using correspondences::CorrespondenceArrays;
using robust::Evidence;
using robust::InlierMasks;
using robust::Support;

HybridScene sceneOf(int rays, int points) {
  Random random(testSeed() + 9200);
  SceneOptions options;
  options.rays = rays;
  options.points = points;
  return makeHybridScene(random, options);
}

CorrespondenceArrays arraysOf(const HybridScene& scene) {
  return {scene.adapter(), allIndices(scene.bearings.size()), allIndices(scene.points.size())};
}

InlierMasks allInliers(const HybridScene& scene) {
  return {std::vector<char>(scene.bearings.size(), 1), std::vector<char>(scene.points.size(), 1)};
}

Support supportOf(const HybridScene& scene) { return Evidence(arraysOf(scene)).support(allInliers(scene)); }

void expectSupport(const Support& support, int rays, int points) {
  EXPECT_EQ(support.rays, rays);
  EXPECT_EQ(support.points, points);
  EXPECT_EQ(support.allRays, rays);
  EXPECT_EQ(support.allPoints, points);
}

// Moves every image point of the kind to a cell of its own, so that nothing is near by accident.
void spreadImagePoints(HybridScene& scene) {
  double u = -5000;
  for (auto* image : {&scene.image2d2d, &scene.image2d3d})
    for (Eigen::Vector3d& p : *image) p = Eigen::Vector3d(u += 10, 0, 1);
}

TEST(Evidence, CountsDifferentCorrespondencesAsTheyAre) {
  HybridScene scene = sceneOf(30, 20);
  spreadImagePoints(scene);
  expectSupport(supportOf(scene), 30, 20);
}

TEST(Evidence, CountsARepeatedCorrespondenceOnce) {
  HybridScene scene = sceneOf(10, 12);
  spreadImagePoints(scene);
  const HybridScene once = scene;
  for (std::size_t i = 0; i < once.points.size(); ++i) {
    scene.points.push_back(once.points[i]);
    scene.image2d3d.push_back(once.image2d3d[i] + Eigen::Vector3d(4, 3, 0));  // another keypoint of the same thing
  }
  for (std::size_t i = 0; i < once.bearings.size(); ++i) {
    scene.bearings.push_back(once.bearings[i]);
    scene.cameras.push_back(once.cameras[i]);
    scene.image2d2d.push_back(once.image2d2d[i]);
  }
  expectSupport(supportOf(scene), 10, 12);
}

TEST(Evidence, CountsAFeatureWithManyMatchesOnce) {
  HybridScene scene = sceneOf(40, 20);
  spreadImagePoints(scene);
  for (std::size_t i = 0; i < 40; ++i) scene.image2d2d[i] = scene.image2d2d[i - i % 4];
  for (std::size_t i = 0; i < 20; ++i) scene.image2d3d[i] = scene.image2d3d[i - i % 4];
  expectSupport(supportOf(scene), 10, 5);
}

// Every four correspondences of a kind are of one feature, which is seen at slightly different places.
TEST(Evidence, CountsAFeatureOnceByItsNumberAlsoWhereItsImagePointsDiffer) {
  HybridScene scene = sceneOf(40, 20);
  spreadImagePoints(scene);
  NoncentralHybridAdapter adapter = scene.adapter();
  std::vector<int> ofRays, ofPoints;
  for (int i = 0; i < 40; ++i) ofRays.push_back(i / 4);
  for (int i = 0; i < 20; ++i) ofPoints.push_back(100 + i / 4);
  adapter.setFeatures(ofRays, ofPoints);
  const CorrespondenceArrays arrays(adapter, allIndices(40), allIndices(20));
  expectSupport(Evidence(arrays).support(allInliers(scene)), 10, 5);
}

TEST(Evidence, CountsFeaturesAtOnePlaceOnceWhateverTheirNumbers) {
  HybridScene scene = sceneOf(0, 20);
  spreadImagePoints(scene);
  for (std::size_t i = 1; i < 20; i += 2) scene.image2d3d[i] = scene.image2d3d[i - 1] + Eigen::Vector3d(0, 0.5, 0);
  NoncentralHybridAdapter adapter = scene.adapter();
  adapter.setFeatures({}, allIndices(20));
  const CorrespondenceArrays arrays(adapter, {}, allIndices(20));
  expectSupport(Evidence(arrays).support(allInliers(scene)), 0, 10);
}

TEST(Evidence, DoesNotCountARayOfAFeatureThatAnInlierPointHasUsed) {
  HybridScene scene = sceneOf(20, 20);
  spreadImagePoints(scene);
  for (std::size_t i = 0; i < 5; ++i) scene.image2d2d[i] = scene.image2d3d[i];
  const CorrespondenceArrays arrays = arraysOf(scene);
  InlierMasks inliers = allInliers(scene);
  EXPECT_EQ(Evidence(arrays).support(inliers).rays, 15);
  EXPECT_EQ(Evidence(arrays).support(inliers).allRays, 15);
  inliers.points.assign(20, 0);
  EXPECT_EQ(Evidence(arrays).support(inliers).rays, 20);
}

TEST(Evidence, LeavesOutTheRaysOfACamera) {
  HybridScene scene = sceneOf(30, 0);  // five cameras, six rays each
  spreadImagePoints(scene);
  InlierMasks inliers = allInliers(scene);
  inliers.rays[1] = 0;
  const Support support = Evidence(arraysOf(scene)).supportWithoutCamera(inliers, 0);
  EXPECT_EQ(support.rays, 23);
  EXPECT_EQ(support.allRays, 24);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

#include "robust/QueryFeatures.hpp"

#include <gtest/gtest.h>

#include "HybridScene.hpp"
#include "robust/numberEqual.hpp"

namespace hybridgv {
namespace {

using correspondences::allIndices;
using correspondences::CorrespondenceArrays;
using robust::QueryFeatures;

constexpr int kRays = 6, kPoints = 4;

test::HybridScene makeScene() {
  test::Random random(test::testSeed(), 9400);
  test::SceneOptions options;
  options.rays = kRays;
  options.points = kPoints;
  return test::makeHybridScene(random, options);
}

CorrespondenceArrays arraysOf(const NoncentralHybridAdapter& adapter) {
  return {adapter, allIndices(kRays), allIndices(kPoints)};
}

TEST(NumberEqual, NumbersInTheOrderOfTheFirstOccurrence) {
  const robust::Numbering numbering = robust::numberEqual({70, 5, 70, 1, 5, 5});
  EXPECT_EQ(numbering.numbers, (std::vector<int>{0, 1, 0, 2, 1, 1}));
  EXPECT_EQ(numbering.count, 3);
  EXPECT_EQ(robust::numberEqual({}).count, 0);
}

TEST(NumberEqual, KeysAreEqualForEqualNumbers) {
  const auto keyOf = [](double a, double b) { return robust::keyOf(std::array<double, 2>{a, b}); };
  EXPECT_EQ(keyOf(0.1, -3), keyOf(0.1, -3));
  EXPECT_EQ(keyOf(0.0, 1), keyOf(-0.0, 1));
  EXPECT_NE(keyOf(0.1, -3), keyOf(-3, 0.1));
  EXPECT_NE(keyOf(0.1, -3), keyOf(0.1, 3));
}

TEST(QueryFeatures, DifferentImagePointsAreDifferentFeatures) {
  const CorrespondenceArrays arrays = arraysOf(makeScene().adapter());
  const QueryFeatures features(arrays);
  EXPECT_FALSE(features.areShared());
  EXPECT_EQ(features.numbers(), allIndices(kRays + kPoints));
  EXPECT_EQ(features.ofPoint(1), kRays + 1);
  EXPECT_EQ(features.places()[2].u, arrays.rays()[2].u);
}

TEST(QueryFeatures, EqualImagePointsAreOneFeatureOfBothKinds) {
  test::HybridScene scene = makeScene();
  scene.image2d2d[3] = scene.image2d2d[1];
  scene.image2d3d[2] = scene.image2d2d[1];
  const QueryFeatures features(arraysOf(scene.adapter()));
  EXPECT_TRUE(features.areShared());
  EXPECT_EQ(features.ofRay(3), features.ofRay(1));
  EXPECT_EQ(features.ofPoint(2), features.ofRay(1));
  EXPECT_EQ(features.places().size(), kRays + kPoints - 2u);
}

TEST(QueryFeatures, EqualNumbersAreOneFeatureAtTheFirstOnesPlace) {
  const test::HybridScene scene = makeScene();
  NoncentralHybridAdapter adapter = scene.adapter();
  adapter.setFeatures({-1, -1, 8, -1, 8, -5}, {3, -1, 8, -1});
  const QueryFeatures features(arraysOf(adapter));
  EXPECT_EQ(features.ofRay(4), features.ofRay(2));
  EXPECT_EQ(features.ofPoint(2), features.ofRay(2));
  EXPECT_EQ(features.places().size(), kRays + kPoints - 2u);
  EXPECT_EQ(features.places()[static_cast<std::size_t>(features.ofPoint(2))].u, scene.image2d2d[2][0]);
}

TEST(QueryFeatures, DifferentNumbersAtOnePlaceAreOneFeature) {
  test::HybridScene scene = makeScene();
  scene.image2d2d[5] = scene.image2d2d[0];
  NoncentralHybridAdapter adapter = scene.adapter();
  adapter.setFeatures(allIndices(kRays), {100, 5, 101, 102});
  const QueryFeatures features(arraysOf(adapter));
  EXPECT_EQ(features.ofRay(5), features.ofRay(0));
  EXPECT_EQ(features.ofPoint(1), features.ofRay(0));
}

TEST(QueryFeatures, ASubsetKeepsItsNumbers) {
  NoncentralHybridAdapter adapter = makeScene().adapter();
  adapter.setFeatures({0, 1, 2, 1, 4, 5}, {1, 7, 8, 9});
  const CorrespondenceArrays part = arraysOf(adapter).subset({3, 5, 1}, {0});
  EXPECT_EQ(part.rayFeatures(), (std::vector<int>{1, 5, 1}));
  EXPECT_EQ(part.pointFeatures(), std::vector<int>{1});
  EXPECT_TRUE(arraysOf(makeScene().adapter()).subset({3, 5, 1}, {0}).rayFeatures().empty());
}

}  // namespace
}  // namespace hybridgv

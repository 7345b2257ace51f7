#include "robust/LookAlikes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "HybridScene.hpp"
#include "correspondences/readCorrespondence.hpp"

namespace hybridgv {
namespace robust {
namespace {

struct Data {
  explicit Data(std::uint64_t stream, const test::SceneOptions& options)
      : random(test::testSeed(), stream), scene(test::makeHybridScene(random, options)) {
    const NoncentralHybridAdapter adapter = scene.adapter();
    arrays = CorrespondenceArrays(adapter, correspondences::allIndices(scene.image2d2d.size()),
                                  correspondences::allIndices(scene.image2d3d.size()));
    arrays.fixUnknownFocalLengths();
    truth = arrays.normalization().applyTo(QueryPose(scene.truth));
  }
  PoseScorer scorer() const { return {arrays, {10, 10}, sac::Scoring::Msac}; }

  test::Random random;
  test::HybridScene scene;
  CorrespondenceArrays arrays;
  QueryPose truth;
};

test::SceneOptions flat(double halfSize, int rays, int points) {
  test::SceneOptions options;
  options.coplanar = true;
  options.halfSize = halfSize;
  options.rays = rays;
  options.points = points;
  return options;
}

std::optional<QueryPose> mirroredPose(const PoseScorer& scorer, const QueryPose& pose) {
  const LookAlikes others = lookAlikes(scorer, pose);
  return others.mirrored.empty() ? std::nullopt : std::optional<QueryPose>(others.mirrored[0]);
}

double angleBetween(const QueryPose& a, const QueryPose& b) {
  return Eigen::AngleAxisd(a.rotation.transpose() * b.rotation).angle();
}

// `width`: beside the line, of standard deviation.
Data thinScene(std::uint64_t stream, double length, double width) {
  Data data(stream, flat(1, 0, 40));
  const Eigen::Vector3d line = data.random.direction();
  for (std::size_t i = 0; i < data.scene.points.size(); ++i) {
    const Eigen::Vector3d beside(data.random.normal(), data.random.normal(), data.random.normal());
    data.scene.points[i] = data.random.uniform(-length, length) * line + width * beside;
    data.scene.image2d3d[i] = test::noisyImagePoint(data.random, test::project(data.scene.truth, data.scene.points[i]), 0);
  }
  data.arrays = CorrespondenceArrays(data.scene.adapter(), {}, correspondences::allIndices(40));
  data.truth = data.arrays.normalization().applyTo(QueryPose(data.scene.truth));
  return data;
}

// The perspective errors of an object of relative size s fall with s^2, those of its image with s.
TEST(LookAlikes, AFlatObjectLooksTheSameTheSmallerItIs) {
  for (const auto& counts : {std::pair<int, int>{20, 20}, {20, 0}, {0, 20}})
    for (std::uint64_t i = 0; i < 20; ++i) {
      const Data data(9700 + i, flat(0.01, counts.first, counts.second));
      const PoseScorer scorer = data.scorer();
      const std::optional<QueryPose> mirrored = mirroredPose(scorer, data.truth);
      if (!mirrored) continue;  // it is seen at a right angle
      EXPECT_NEAR((mirrored->rotation.transpose() * mirrored->rotation - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
      EXPECT_GT(mirrored->rotation.determinant(), 0);
      EXPECT_EQ(mirrored->focalLength, data.truth.focalLength);
      for (const double error : scorer.squaredPointErrors(*mirrored)) EXPECT_LT(error, 0.1 * 0.1) << "scene " << i;
      for (const double error : scorer.squaredRayErrors(*mirrored)) EXPECT_LT(error, 0.1 * 0.1) << "scene " << i;
    }
}

TEST(LookAlikes, MirroredTwiceIsTheSame) {
  int found = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Data data(9730 + i, flat(0.5, 0, 30));
    const PoseScorer scorer = data.scorer();
    const std::optional<QueryPose> once = mirroredPose(scorer, data.truth);
    if (!once) continue;
    const std::optional<QueryPose> twice = mirroredPose(scorer, *once);
    if (!twice) continue;
    ++found;
    EXPECT_NEAR(angleBetween(*twice, data.truth), 0, 1e-9);
    EXPECT_NEAR((twice->position - data.truth.position).norm(), 0, 1e-9 * data.truth.position.norm());
  }
  EXPECT_GT(found, 10);
}

TEST(LookAlikes, ASceneWithReliefHasNone) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    test::SceneOptions options;
    options.rays = options.points = 30;
    const Data data(9760 + i, options);
    const std::optional<QueryPose> mirrored = mirroredPose(data.scorer(), data.truth);
    EXPECT_LT(mirrored ? angleBetween(*mirrored, data.truth) : 0, 0.1) << "scene " << i << " has more than nearly the same pose";
  }
}

TEST(LookAlikes, FewerThanThreeInliersHaveNone) {
  for (const int points : {0, 1, 2}) {
    const Data data(9790, flat(0.5, 0, points));
    const LookAlikes others = lookAlikes(data.scorer(), data.truth);
    EXPECT_TRUE(others.mirrored.empty() && others.turned.empty()) << points;
  }
}

TEST(LookAlikes, AThinObjectLooksAboutTheSameAllAroundTheLine) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Data data = thinScene(9800 + i, 0.5, 1e-3);
    const PoseScorer scorer = data.scorer();
    const LookAlikes others = lookAlikes(scorer, data.truth);
    ASSERT_GE(others.turned.size(), 7u) << "scene " << i;
    double farthest = 0;
    for (const QueryPose& other : others.turned) {
      EXPECT_GT(other.rotation.determinant(), 0);
      EXPECT_NEAR((other.rotation.transpose() * other.rotation - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
      for (const double error : scorer.squaredPointErrors(other)) EXPECT_LT(error, 3 * 3) << "scene " << i;
      farthest = std::max(farthest, angleBetween(other, data.truth));
    }
    EXPECT_GT(farthest, 3) << "scene " << i;
  }
}

TEST(LookAlikes, WhatIsNotThinIsNotTurned) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Data data(9830 + i, flat(1, 20, 20));
    EXPECT_TRUE(lookAlikes(data.scorer(), data.truth).turned.empty()) << "scene " << i;
  }
}

// Where it is seen at a right angle, the mirrored pose is the same.
TEST(LookAlikes, APlaneParallelToTheImageHasNone) {
  test::Random random(test::testSeed(), 9795);
  test::HybridScene scene = test::makeHybridScene(random, flat(1, 0, 30));
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d inQuery(random.uniform(-1, 1), random.uniform(-1, 1), 20);
    scene.points[i] = scene.truth.position + scene.truth.rotation * inQuery;
    scene.image2d3d[i] = scene.truth.focalLength * inQuery / inQuery[2];
    scene.image2d3d[i][2] = 1;
  }
  // Centred, so that the centre is seen at a right angle, too.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : scene.points) shift += point / 30;
  shift -= scene.truth.position + 20 * scene.truth.rotation.col(2);
  for (std::size_t i = 0; i < scene.points.size(); ++i) scene.points[i] -= shift;
  CorrespondenceArrays arrays(scene.adapter(), {}, correspondences::allIndices(30));
  const QueryPose truth = arrays.normalization().applyTo(QueryPose(scene.truth));
  EXPECT_FALSE(mirroredPose(PoseScorer(arrays, {1e3, 1e3}, sac::Scoring::Msac), truth));
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

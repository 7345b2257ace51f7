#include "robust/PoseScorer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "HybridScene.hpp"

namespace hybridgv {
namespace {

using namespace robust;

struct Data {
  Data(test::Random& random, int rays, int points, double outliers)
      : adapter(make(random, rays, points, outliers)),
        arrays(adapter, correspondences::allIndices(scene.bearings.size()), correspondences::allIndices(scene.points.size())) {}
  NoncentralHybridAdapter make(test::Random& random, int rays, int points, double outliers) {
    test::SceneOptions options;
    options.rays = rays;
    options.points = points;
    options.imageNoise = 2;
    options.outlierShareRays = options.outlierSharePoints = outliers;
    scene = test::makeHybridScene(random, options);
    return scene.adapter();
  }
  FocalPose truth() const { return arrays.normalization().apply(scene.truth); }
  test::HybridScene scene;
  NoncentralHybridAdapter adapter;
  correspondences::CorrespondenceArrays arrays;
};

TEST(PoseScorer, ScoreIsTheSumOverBothKindsWithTheirOwnThresholds) {
  test::Random random(test::testSeed(), 60);
  const Data data(random, 150, 333, 0.3);
  const PoseScorer msac(data.arrays, {5, 11}, sac::Scoring::Msac), inliers(data.arrays, {5, 11}, sac::Scoring::InlierCount);
  const FocalPose pose = data.truth();
  double expected = 0;
  int count = 0;
  const auto add = [&](const std::vector<double>& squared, double threshold) {
    for (const double e : squared)
      if (e < threshold * threshold) {
        expected += 1 - e / (threshold * threshold);
        ++count;
      }
  };
  add(msac.squaredRayErrors(pose), 5);
  add(msac.squaredPointErrors(pose), 11);
  EXPECT_NEAR(msac.evaluate(pose).score, expected, 1e-9 * expected);
  EXPECT_EQ(inliers.evaluate(pose).score, count);
  EXPECT_EQ(msac.evaluate(pose).rays + msac.evaluate(pose).points, count);
  const PerKind<std::vector<char>> masks = msac.inliers(pose);
  EXPECT_EQ(std::accumulate(masks.rays.begin(), masks.rays.end(), 0), msac.evaluate(pose).rays);
  EXPECT_EQ(std::accumulate(masks.points.begin(), masks.points.end(), 0), msac.evaluate(pose).points);
}

TEST(PoseScorer, InliersAreWithinTheBoundsAndWithinGoesBeyond) {
  test::Random random(test::testSeed(), 66);
  const Data data(random, 150, 333, 0.3);
  PoseScorer scorer(data.arrays, {5, 11}, sac::Scoring::Msac);
  scorer.setThresholds({3, 8});
  const FocalPose pose = data.truth();
  const auto count = [](const PerKind<std::vector<char>>& masks) {
    return PerKind<int>{std::accumulate(masks.rays.begin(), masks.rays.end(), 0),
                        std::accumulate(masks.points.begin(), masks.points.end(), 0)};
  };
  const auto countBelow = [](const std::vector<double>& squared, double threshold) {
    return std::count_if(squared.begin(), squared.end(), [&](double e) { return e < threshold * threshold; });
  };
  const std::vector<double> rays = scorer.squaredRayErrors(pose), points = scorer.squaredPointErrors(pose);
  const PerKind<int> capped = count(scorer.inliers(pose, 10)), wide = count(scorer.within({30, 80}, pose));
  EXPECT_EQ(capped.rays, countBelow(rays, 5));
  EXPECT_EQ(capped.points, countBelow(points, 11));
  EXPECT_EQ(wide.rays, countBelow(rays, 30));
  EXPECT_EQ(wide.points, countBelow(points, 80));
  EXPECT_GT(wide.points, capped.points);
}

TEST(PoseScorer, APoseThatCannotWinIsGivenUpAndOneThatCanIsNot) {
  test::Random random(test::testSeed(), 61);
  const Data data(random, 300, 300, 0.3);
  const PoseScorer scorer(data.arrays, {6, 12}, sac::Scoring::Msac);
  const double score = scorer.evaluate(data.truth()).score;
  Expectation expectation;
  expectation.score = 0.99 * score;
  EXPECT_TRUE(scorer.evaluate(data.truth(), expectation).complete);
  expectation.score = 1.01 * score;
  EXPECT_FALSE(scorer.evaluate(data.truth(), expectation).complete);
}

TEST(PoseScorer, SequentialTestKeepsGoodPosesAndGivesUpChanceOnesEarly) {
  test::Random random(test::testSeed(), 62);
  int goodKept = 0, betterKept = 0, badKept = 0;
  const int count = 200;
  for (int i = 0; i < count; ++i) {
    const Data data(random, 300, 300, 0.6);
    const PoseScorer scorer(data.arrays, {6, 12}, sac::Scoring::Msac);
    const PerKind<double> chance{0.03, 0.03};
    goodKept += scorer.evaluate(data.truth(), Expectation({0.4, 0.4}, chance)).complete;
    const Expectation halfOfIt({0.2, 0.2}, chance);
    betterKept += scorer.evaluate(data.truth(), halfOfIt).complete;
    badKept += scorer.evaluate(test::perturbed(random, data.truth(), 2, 2, 1), halfOfIt).complete;
  }
  EXPECT_GE(goodKept, count * (1 - 1.5 * kFalseRejection));
  EXPECT_GE(betterKept, count * (1 - 2 * kFalseRejection * kFalseRejection));
  EXPECT_LE(badKept, 0.05 * count);
}

// A wrong pose through its own sample has these inliers, which say nothing.
TEST(PoseScorer, OwnCorrespondencesAreNoEvidence) {
  test::Random random(test::testSeed(), 63);
  const Data data(random, 0, 300, 0);
  const PoseScorer scorer(data.arrays, {6, 12}, sac::Scoring::Msac);
  Expectation expectation({0, 0.6}, {0, 0.01});
  expectation.score = -1;
  FocalPose wrong = data.truth();
  wrong.rotation.rightCols<2>() *= -1;  // looks away: no inlier at all
  EXPECT_FALSE(scorer.evaluate(wrong, expectation).complete);
  EXPECT_FALSE(scorer.pointsLeaveHope(wrong, 1, expectation, {}));
  std::vector<int> all(300);
  std::iota(all.begin(), all.end(), 0);
  const OwnCorrespondences own{{nullptr, all.data()}, {0, 300}};
  EXPECT_TRUE(scorer.evaluate(wrong, expectation, own).complete);
  EXPECT_TRUE(scorer.pointsLeaveHope(wrong, 1, expectation, own));
  EXPECT_TRUE(scorer.pointsLeaveHope(data.truth(), 1, expectation, {}));
}

}  // namespace
}  // namespace hybridgv

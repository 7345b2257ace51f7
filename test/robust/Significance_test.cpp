#include "robust/Significance.hpp"

#include <gtest/gtest.h>

#include "HybridScene.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using sac::FailureReason;

constexpr double kFocalLength = 1000;

// 150 rays of five cameras, 100 points.
class SignificanceTest : public testing::Test {
 protected:
  static constexpr int kRays = 150, kPoints = 100, kCameras = 5;

  static NoncentralHybridAdapter makeAdapter() {
    test::Random random(test::testSeed(), 130);
    test::SceneOptions options;
    options.rays = kRays;
    options.points = kPoints;
    options.cameras = kCameras;
    return test::makeHybridScene(random, options).adapter();
  }
  std::vector<int> cameras() const {
    std::vector<int> result;
    for (const correspondences::RayMatch& ray : arrays.rays()) result.push_back(ray.camera);
    return result;
  }
  static Evaluation inliers(int rays, int points) {
    Evaluation result;
    result.rays = rays;
    result.points = points;
    return result;
  }
  FailureReason verdict(const InlierCounts& counts, bool isRegular = true) const {
    return significance.verdict(inliers(counts.rays, counts.points), kFocalLength, counts, isRegular);
  }

  NoncentralHybridAdapter adapter = makeAdapter();
  correspondences::CorrespondenceArrays arrays{adapter, correspondences::allIndices(kRays), correspondences::allIndices(kPoints)};
  Sampler sampler{cameras(), correspondences::allIndices(kRays), correspondences::allIndices(kPoints), false};
  ChanceModel chance{arrays, 4, 6};
  Significance significance{chance, sampler, 7};
};

TEST_F(SignificanceTest, GrowsWithTheInliersOfEitherKind) {
  double before = 1;
  for (const int points : {0, 20, 40, 80}) {
    const double now = significance.logChance(inliers(50, points), kFocalLength);
    EXPECT_LT(now, before);
    before = now;
  }
  EXPECT_LT(significance.logChance(inliers(100, 40), kFocalLength), significance.logChance(inliers(50, 40), kFocalLength));
}

TEST_F(SignificanceTest, OfTheSameInliersIsLessTheMoreSamplesWereDrawn) {
  const double logChance = -7;
  EXPECT_TRUE(significance.isSignificant(logChance));
  significance.setSamples(9);
  EXPECT_FALSE(significance.isSignificant(logChance)) << "ten poses, each with probability 1e-7, are expected 1e-6 times";
  EXPECT_TRUE(significance.isPromising(logChance));
  significance.setSamples(100000000);
  EXPECT_FALSE(significance.isPromising(logChance));
}

TEST_F(SignificanceTest, VerdictSaysWhyAPoseCannotBeTrusted) {
  InlierCounts good;
  good.points = 60;
  good.rays = 100;
  good.raysPerCamera = {20, 20, 20, 20, 20};
  EXPECT_EQ(verdict(good), FailureReason::None);
  EXPECT_EQ(verdict(good, false), FailureReason::UndeterminedPose);

  InlierCounts few;
  few.points = 4;
  few.raysPerCamera = {0, 0, 0, 0, 0};
  EXPECT_EQ(verdict(few), FailureReason::InliersMayBeChance);
  EXPECT_EQ(verdict(few, false), FailureReason::InliersMayBeChance) << "the graver reason";
}

TEST_F(SignificanceTest, RaysOfOneCameraAloneDoNotFixTheScale) {
  InlierCounts counts;
  counts.rays = 30;
  counts.raysPerCamera = {30, 0, 0, 0, 0};
  ASSERT_LT(significance.logChance(inliers(30, 0), kFocalLength), 0);
  counts.points = 12;
  const FailureReason withPoints = verdict(counts);
  counts.points = 1;
  EXPECT_NE(verdict(counts), FailureReason::None);
  EXPECT_EQ(withPoints, FailureReason::None);
}

}  // namespace
}  // namespace hybridgv

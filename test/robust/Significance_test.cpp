#include "robust/Significance.hpp"

#include <gtest/gtest.h>

#include "HybridScene.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using sac::FailureReason;

// 150 rays of five cameras, 100 points, most of them right.
class SignificanceTest : public testing::Test {
 protected:
  static constexpr int kRays = 150, kPoints = 100;

  static test::HybridScene makeScene() {
    test::Random random(test::testSeed(), 130);
    test::SceneOptions options;
    options.rays = kRays;
    options.points = kPoints;
    options.imageNoise = 1;
    options.outlierShareRays = options.outlierSharePoints = 0.2;
    return test::makeHybridScene(random, options);
  }
  static Evaluation inliers(int rays, int points) {
    Evaluation result;
    result.rays = rays;
    result.points = points;
    return result;
  }
  QueryPose truth() const { return arrays.normalization().apply(scene.truth); }
  QueryPose wrongPose() const {
    QueryPose pose = truth();
    pose.rotation = pose.rotation * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()).toRotationMatrix();
    return pose;
  }
  FailureReason verdict(const QueryPose& pose, bool isDetermined = true) {
    const PerKind<std::vector<char>> masks = scorer.inliers(pose);
    return significance.verdict(pose, scorer.evaluate(pose), sampler.count(masks.rays, masks.points), isDetermined);
  }

  test::HybridScene scene = makeScene();
  NoncentralHybridAdapter adapter = scene.adapter();
  correspondences::CorrespondenceArrays arrays{adapter, correspondences::allIndices(kRays), correspondences::allIndices(kPoints)};
  PoseScorer scorer{arrays, {4, 6}, sac::Scoring::Msac};
  Sampler sampler{scene.cameras, correspondences::allIndices(kRays), correspondences::allIndices(kPoints), false};
  ChanceModel chance{arrays, 4, 6};
  QueryFeatures features{arrays};
  WorkerPool workers{1};
  Significance significance{scorer, chance, sampler, features, workers, 7, 1};
};

TEST_F(SignificanceTest, ChanceIsLargerWhereWrongPosesHaveMoreInliers) {
  const Shares even = chance.levelShares();
  EXPECT_DOUBLE_EQ(significance.logChance(inliers(50, 20), even), significance.logChance(inliers(50, 20)));
  Shares crowded = even;
  crowded.points[0] = 2 * even.points[0];
  EXPECT_GT(significance.logChance(inliers(50, 20), crowded), significance.logChance(inliers(50, 20)) + 1);
}

TEST_F(SignificanceTest, GrowsWithTheInliersOfEitherKind) {
  double before = 2;  // log10 of the number of choices of levels
  for (const int points : {0, 20, 40, 80}) {
    const double now = significance.logChance(inliers(50, points));
    EXPECT_LT(now, before);
    before = now;
  }
  EXPECT_LT(significance.logChance(inliers(100, 40)), significance.logChance(inliers(50, 40)));
}

TEST_F(SignificanceTest, OfTheSameInliersIsLessTheMoreSamplesWereDrawn) {
  EXPECT_TRUE(significance.isPromising(-7)) << "a pose with probability 1e-7 is not expected to be chance";
  significance.setSamples(100000000);
  EXPECT_FALSE(significance.isPromising(-7));
}

TEST_F(SignificanceTest, OfTheTrueAndOfAWrongPose) {
  EXPECT_TRUE(significance.isSignificant(truth()));
  EXPECT_FALSE(significance.isSignificant(wrongPose()));
}

TEST_F(SignificanceTest, OfTheTruePoseAloneIsPromisingByOtherPairsToo) {
  const auto isPromising = [&](const QueryPose& pose) { return significance.isPromising(pose); };
  EXPECT_TRUE(isPromising(truth()));
  EXPECT_FALSE(isPromising(wrongPose()));
  significance.setSamples(1000000);
  EXPECT_TRUE(isPromising(truth()));
}

// Half of the image points crowd at the left, half at the right, whatever the points are. From far away, all points are at the left.
TEST(Significance, APoseThatHitsACrowdIsNotPromising) {
  test::Random random(test::testSeed(), 131);
  test::SceneOptions options;
  options.rays = 0;
  options.points = 100;
  test::HybridScene scene = test::makeHybridScene(random, options);
  for (std::size_t i = 0; i < scene.image2d3d.size(); ++i) {
    const double middle = i % 2 == 0 ? -400 : 400;
    scene.image2d3d[i] = {middle + random.uniform(-20, 20), random.uniform(-20, 20), 1};
  }
  const NoncentralHybridAdapter adapter = scene.adapter();
  const correspondences::CorrespondenceArrays arrays(adapter, {}, correspondences::allIndices(100));
  const PoseScorer scorer(arrays, {10, 30}, sac::Scoring::Msac);
  const Sampler sampler({}, {}, correspondences::allIndices(100), false);
  const ChanceModel chance(arrays, 10, 30);
  const QueryFeatures features(arrays);
  WorkerPool workers(1);
  Significance significance(scorer, chance, sampler, features, workers, 7, 1);

  QueryPose pose;
  pose.focalLength = 1000;
  pose.position = {400, 0, -1000};  // points are about 1 from the origin
  const Evaluation evaluation = scorer.evaluate(pose);
  ASSERT_GE(evaluation.points, 45);
  EXPECT_TRUE(significance.isPromising(significance.logChance(evaluation)));
  EXPECT_FALSE(significance.isPromising(pose));
}

TEST_F(SignificanceTest, VerdictSaysWhyAPoseCannotBeTrusted) {
  EXPECT_EQ(verdict(truth()), FailureReason::None);
  EXPECT_EQ(verdict(truth(), false), FailureReason::UndeterminedPose);
  EXPECT_EQ(verdict(wrongPose()), FailureReason::InliersMayBeChance);
  EXPECT_EQ(verdict(wrongPose(), false), FailureReason::InliersMayBeChance) << "the graver reason";
}

// Every correspondence of one rig camera, and of the others and of the points none that is right.
TEST_F(SignificanceTest, RaysOfOneCameraAloneDoNotFixTheScale) {
  test::Random random(test::testSeed(), 131);
  for (std::size_t i = 0; i < scene.bearings.size(); ++i)
    if (scene.cameras[i] != 0) scene.image2d2d[i] = test::randomImagePoint(random);
  for (Eigen::Vector3d& image : scene.image2d3d) image = test::randomImagePoint(random);
  const NoncentralHybridAdapter onlyOneCamera = scene.adapter();
  const correspondences::CorrespondenceArrays oneCamera(onlyOneCamera, correspondences::allIndices(kRays),
                                                        correspondences::allIndices(kPoints));
  const PoseScorer oneCameraScorer(oneCamera, {4, 6}, sac::Scoring::Msac);
  const QueryFeatures oneCameraFeatures(oneCamera);
  WorkerPool oneWorker(1);
  Significance ofOneCamera(oneCameraScorer, chance, sampler, oneCameraFeatures, oneWorker, 7, 1);
  const QueryPose pose = oneCamera.normalization().apply(scene.truth);
  const PerKind<std::vector<char>> masks = oneCameraScorer.inliers(pose);
  EXPECT_NE(ofOneCamera.verdict(pose, oneCameraScorer.evaluate(pose), sampler.count(masks.rays, masks.points), true),
            FailureReason::None);
}

}  // namespace
}  // namespace hybridgv

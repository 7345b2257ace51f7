#include "robust/ChanceModel.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "HybridScene.hpp"
#include "robust/PoseScorer.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr int kParameters = correspondences::kFocalPoseParameters;

double binomialTail(int n, int k, double p) {
  double sum = 0;
  for (int i = k; i <= n; ++i)
    sum +=
        std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * std::log(p) + (n - i) * std::log1p(-p));
  return sum;
}

TEST(ChanceModel, LogTailBoundsTheBinomialTailClosely) {
  for (const int n : {3, 20, 200})
    for (const double p : {0.001, 0.02, 0.3})
      for (int k = 0; k <= n; k += std::max(1, n / 7)) {
        const double exact = std::log(binomialTail(n, k, p)), bound = logTail(n, k, p);
        EXPECT_GE(bound, exact - 1e-9);
        if (std::isinf(exact)) continue;
        EXPECT_LE(bound, exact * 0.5 + 4) << n << " " << k << " " << p;
      }
  EXPECT_EQ(logTail(0, 0, 0.1), 0);
}

struct Outliers {
  explicit Outliers(test::Random& random)
      : adapter(make(random)), arrays(adapter, correspondences::allIndices(300), correspondences::allIndices(300)) {
    arrays.fixUnknownFocalLengths();
  }
  NoncentralHybridAdapter make(test::Random& random) {
    test::SceneOptions options;
    options.rays = options.points = 300;
    options.outlierShareRays = options.outlierSharePoints = 1;
    scene = test::makeHybridScene(random, options);
    return scene.adapter();
  }
  test::HybridScene scene;
  NoncentralHybridAdapter adapter;
  correspondences::CorrespondenceArrays arrays;
};

TEST(ChanceModel, WrongPosesHaveNoLargerSharesOfInliersOnAverage) {
  test::Random random(test::testSeed(), 50);
  double rays = 0, points = 0, expectedRays = 0, expectedPoints = 0;
  for (int i = 0; i < 100; ++i) {
    const Outliers data(random);
    const ChanceModel chance(data.arrays, 6, 60);
    const PoseScorer scorer(data.arrays, {6, 60}, sac::Scoring::Msac);
    const FocalPose pose = data.arrays.normalization().apply(data.scene.truth);
    const Evaluation evaluation = scorer.evaluate(pose);
    rays += evaluation.rays / 300.;
    points += evaluation.points / 300.;
    expectedRays += chance.rayShare();
    expectedPoints += chance.pointShare();
  }
  EXPECT_LT(rays, expectedRays);
  EXPECT_LT(points, 1.2 * expectedPoints);
  EXPECT_GT(rays, 0.1 * expectedRays) << "the bound says something";
  EXPECT_GT(points, 0.5 * expectedPoints);
}

TEST(ChanceModel, MoreInliersAreLessLikelyChanceAndFittedOnesProveNothing) {
  test::Random random(test::testSeed(), 51);
  const Outliers data(random);
  const ChanceModel chance(data.arrays, 6, 12);
  const auto logProbability = [&](const Support& support) {
    return ChanceModel::logProbability(support, chance.rayShare(), chance.pointShare(), kParameters);
  };
  double last = 1;
  for (const int inliers : {10, 20, 40, 80}) {
    const double alarms = logProbability({inliers, 200, inliers, 200});
    EXPECT_LT(alarms, last);
    last = alarms;
  }
  EXPECT_LT(last, -50);
  EXPECT_GE(logProbability({4, 4, 0, 0}), 0) << "four points are fitted by any of their poses";
  EXPECT_GE(logProbability({3, 3, 1, 1}), 0);
  EXPECT_GE(logProbability({1, 1, 5, 5}), 0);
  EXPECT_LT(logProbability({12, 12, 0, 0}), -6);
  EXPECT_LT(logProbability({3, 3, 40, 60}), -6) << "rays alone may do";
}

}  // namespace
}  // namespace hybridgv

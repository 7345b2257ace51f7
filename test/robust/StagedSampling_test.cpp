// Six rays of one camera first, a ray of another one only where it is worth while.
#include "robust/StagedSampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "FocalPoseNear.hpp"
#include "HybridScene.hpp"

namespace hybridgv {
namespace {

using namespace robust;

class Staged : public testing::Test {
 protected:
  static constexpr double kThreshold = 4;
  static constexpr SampleSize kSize{7, 0, RayDraw::AllButOne, 1};

  explicit Staged(double outliers = 0.3) {
    test::Random random(test::testSeed(), 300);
    test::SceneOptions options;
    options.rays = 200;
    options.points = 0;
    options.outlierShareRays = outliers;
    scene_ = test::makeHybridScene(random, options);
    WorkerPool workers(1);
    data_.emplace(readSearchData(scene_.adapter(), {}, workers));
  }

  int solve(const StagedSampling& staged, std::uint64_t number, StagedSampling::OwnScores& scores) {
    RandomStream random(test::testSeed(), number);
    const DrawnSample sample = data_->sampler.draw(kSize, 1, random);
    return staged.solve(sample, SampleReader(data_->arrays, 0), kThreshold, random, poses_.data(), scores);
  }
  bool foundTruth(int count) const {
    const FocalPose truth = data_->arrays.normalization().apply(scene_.truth);
    const FocalPoses poses(poses_.begin(), poses_.begin() + count);
    return test::hasFocalPoseNear(poses, truth, 1e-6);
  }

  test::HybridScene scene_;
  std::optional<SearchData> data_;
  std::array<FocalPose, StagedSampling::kMaxPoses> poses_;
};

// Without noise and outliers among the six: 0.7^6 of the samples, but for the draw without replacement; one of eight seventh rays is
// right as good as always.
TEST_F(Staged, FindsTheTruthAsOftenAsSixRaysAreGood) {
  const StagedSampling staged(*data_);
  StagedSampling::OwnScores scores = staged.noScores();
  constexpr int kCount = 2000;
  int found = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) found += foundTruth(solve(staged, i, scores));
  std::vector<char> masks;
  for (const int index : data_->rayIndices) masks.push_back(scene_.inliers2d2d[static_cast<std::size_t>(index)]);
  const double expected = data_->sampler.allInlierProbability({7, 0, RayDraw::AllButOne, StagedSampling::kSeventhRays},
                                                              data_->sampler.count(masks, {}));
  EXPECT_NEAR(found, kCount * expected, 5 * std::sqrt(kCount * expected));
}

// Once a good motion is known, hardly any other gets a seventh ray, and the good ones still do.
TEST_F(Staged, KnownScoresKeepWrongMotionsFromTheSecondStage) {
  StagedSampling staged(*data_);
  StagedSampling::OwnScores scores = staged.noScores();
  constexpr int kCount = 1000;
  int posesBefore = 0, posesAfter = 0, foundBefore = 0, foundAfter = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    StagedSampling::OwnScores unused = staged.noScores();
    const int count = solve(staged, i, unused);
    posesBefore += count;
    foundBefore += foundTruth(count);
    for (std::size_t k = 0; k < scores.size(); ++k) scores[k] = std::max(scores[k], unused[k]);
  }
  staged.learn(scores);
  for (std::uint64_t i = 0; i < kCount; ++i) {
    StagedSampling::OwnScores unused = staged.noScores();
    const int count = solve(staged, i, unused);
    posesAfter += count;
    foundAfter += foundTruth(count);
  }
  EXPECT_EQ(foundAfter, foundBefore);
  EXPECT_LT(posesAfter, 0.6 * posesBefore);
}

TEST_F(Staged, ScoresAreThoseOfTheSamplesCamera) {
  const StagedSampling staged(*data_);
  StagedSampling::OwnScores scores = staged.noScores();
  ASSERT_EQ(scores.size(), 5u);
  int found = 0;
  for (std::uint64_t i = 0; found == 0; ++i) found = solve(staged, i, scores);
  EXPECT_EQ(std::count_if(scores.begin(), scores.end(), [](double score) { return score > 0; }), 1);
}

}  // namespace
}  // namespace hybridgv

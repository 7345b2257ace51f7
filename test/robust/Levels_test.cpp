#include "robust/Levels.hpp"

#include <gtest/gtest.h>

namespace hybridgv {
namespace robust {
namespace {

LevelShares powers(double base) {
  LevelShares shares;
  double power = 1;
  for (double& share : shares) share = power *= base;
  return shares;
}

TEST(Levels, AreFoundByTheirThreshold) {
  for (int level = 0; level < kLevels; ++level) EXPECT_EQ(levelOf(thresholdAt(1, level)), static_cast<std::size_t>(level));
}

TEST(Levels, SharesAreComparedAndAveragedLevelByLevel) {
  Shares a{powers(0.5), powers(0.1)}, b{powers(0.3), powers(0.2)};
  b.rays[3] = 0.9;
  const Shares most = largest(a, b), mean = meanOf({a, b});
  for (std::size_t level = 0; level < kLevels; ++level) {
    EXPECT_EQ(most.rays[level], level == 3 ? 0.9 : a.rays[level]);
    EXPECT_EQ(most.points[level], b.points[level]);
    EXPECT_DOUBLE_EQ(mean.rays[level], (a.rays[level] + b.rays[level]) / 2);
    EXPECT_DOUBLE_EQ(mean.points[level], (a.points[level] + b.points[level]) / 2);
  }
}

TEST(Levels, TheClearestIsWhereInliersExceedChanceMost) {
  const LevelShares chance = powers(0.25);
  EXPECT_EQ(clearestLevel({50, 48, 46, 44, 10, 3, 1}, 200, chance, 0), 3);
  EXPECT_EQ(clearestLevel({50, 12, 3, 0, 0, 0, 0}, 200, chance, 0), 0) << "chance at all levels";
  EXPECT_EQ(clearestLevel({60, 9, 5, 5, 5, 5, 5}, 200, chance, 5), 0) << "five are there by construction";
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

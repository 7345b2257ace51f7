#include "robust/NearestCandidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "Random.hpp"

namespace hybridgv {
namespace test {
namespace {

using robust::Candidates;
using robust::Nearest;
using Positions = std::vector<Eigen::Vector3d>;

Positions randomPositions(std::size_t count, std::uint64_t stream) {
  Random random(testSeed() + 9400, stream);
  Positions positions;
  while (positions.size() < count) positions.push_back(random.vector(-1, 1));
  return positions;
}

Candidates candidatesAt(const Positions& positions) {
  Candidates candidates;
  for (std::size_t k = 0; k < positions.size(); ++k) candidates.add(k, positions[k]);
  return candidates;
}

template <class Counts>
std::vector<std::size_t> found(const Positions& positions, const Eigen::Vector3d& from, const Counts& counts) {
  const Nearest nearest(candidatesAt(positions), from, counts);
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < nearest.size(); ++k) result.push_back(nearest[k]);
  return result;
}

template <class Counts>
std::vector<std::size_t> sorted(const Positions& positions, const Eigen::Vector3d& from, const Counts& counts) {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (counts(k)) result.push_back(k);
  std::sort(result.begin(), result.end(), [&](std::size_t a, std::size_t b) {
    return (positions[a] - from).squaredNorm() < (positions[b] - from).squaredNorm();
  });
  if (result.size() > Nearest::kMost) result.resize(Nearest::kMost);
  return result;
}

TEST(NearestCandidates, AreThoseThatSortingFinds) {
  for (std::size_t count = 0; count < 140; count += count < 60 ? 1 : 17) {
    const Positions positions = randomPositions(count, count);
    for (const Eigen::Vector3d& from : positions) {
      const auto isAnother = [&](std::size_t k) { return positions[k] != from; };
      EXPECT_EQ(found(positions, from, isAnother), sorted(positions, from, isAnother)) << count;
    }
  }
}

TEST(NearestCandidates, AreFoundAmongAsManyAsThereMayBe) {
  const Positions positions = randomPositions(Candidates::kMost, 100);
  const auto all = [](std::size_t) { return true; };
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(found(positions, positions[i], all), sorted(positions, positions[i], all));
}

TEST(NearestCandidates, ThatDoNotCountMakeRoomForOthers) {
  const Positions positions = randomPositions(100, 101);
  for (const std::size_t step : {2, 3, 10, 40}) {
    const auto counts = [=](std::size_t k) { return k % step == 0; };
    EXPECT_EQ(found(positions, positions[1], counts), sorted(positions, positions[1], counts)) << step;
  }
  EXPECT_TRUE(found(positions, positions[1], [](std::size_t) { return false; }).empty());
}

TEST(NearestCandidates, InOnePlaceAreAllFound) {
  const Positions positions(5, Eigen::Vector3d(1, 2, 3));
  std::vector<std::size_t> all = found(positions, positions[0], [](std::size_t) { return true; });
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(NearestCandidates, AreFoundHoweverFarAwayTheRestIs) {
  Positions positions = randomPositions(6, 102);
  for (int k = 0; k < 10; ++k) positions.push_back(1e200 * Eigen::Vector3d(1, k, 1));
  const std::vector<std::size_t> all = found(positions, positions[0], [](std::size_t) { return true; });
  ASSERT_EQ(all.size(), Nearest::kMost);
  EXPECT_EQ(all[0], 0u);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_LT(all[k], 6u);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

#include "sac_problems/hybrid_pose/drawSample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "Random.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {
namespace {

std::function<int()> numbers() {
  return [random = test::Random(test::testSeed())]() mutable { return static_cast<int>(random.next() >> 33); };
}

TEST(DrawIndex, CoversItsRangeAndNoMore) {
  EXPECT_EQ(drawIndex(7, [] { return 0; }), 0u);
  EXPECT_EQ(drawIndex(7, [] { return 0x7fffffff; }), 6u);
}

// With 35 subsets of 3 out of 7 and 35000 draws, each is expected 1000 times, with a standard deviation of 32.
TEST(DrawSubset, EverySubsetIsEquallyLikely) {
  const auto random = numbers();
  std::map<std::set<int>, int> counts;
  for (int i = 0; i < 35000; ++i) {
    const std::vector<int> subset = drawSubset({10, 11, 12, 13, 14, 15, 16}, 3, random);
    ++counts[std::set<int>(subset.begin(), subset.end())];
  }
  ASSERT_EQ(counts.size(), 35u);
  for (const auto& entry : counts) {
    EXPECT_EQ(entry.first.size(), 3u);
    EXPECT_NEAR(entry.second, 1000, 160);
  }
}

// 6 orders of 3 entries, 6000 draws, standard deviation 29.
TEST(DrawSubset, EveryOrderIsEquallyLikely) {
  const auto random = numbers();
  std::map<std::vector<int>, int> counts;
  for (int i = 0; i < 6000; ++i) ++counts[drawSubset({5, 6, 7}, 3, random)];
  ASSERT_EQ(counts.size(), 6u);
  for (const auto& entry : counts) EXPECT_NEAR(entry.second, 1000, 145);
}

TEST(DrawSubset, OfAllIsAPermutation) {
  std::vector<int> all = drawSubset({3, 1, 2}, 3, numbers());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector<int>{1, 2, 3}));
}

// Camera 0 has one entry, too few; camera 1 has two and camera 2 has three: probabilities 2/5 and 3/5.
TEST(DrawCamera, IsWeightedByTheNumberOfMatches) {
  const auto random = numbers();
  const std::vector<int> list{0, 1, 3, 4, 5, 6}, cameras{2, 1, 2, 0, 2, 1, 2};  // entry 2 is not in the list
  int ofCamera1 = 0;
  for (int i = 0; i < 10000; ++i) {
    const std::vector<int> drawn = drawCamera(list, cameras, 2, random);
    if (drawn == std::vector<int>{1, 5})
      ++ofCamera1;
    else
      ASSERT_EQ(drawn, (std::vector<int>{0, 4, 6}));
  }
  EXPECT_NEAR(ofCamera1, 4000, 250);
}

TEST(DrawCamera, IsTheWholeListIfNoCameraHasEnough) {
  const std::vector<int> list{0, 1, 2};
  EXPECT_EQ(drawCamera(list, {0, 1, 0}, 3, numbers()), list);
}

}  // namespace
}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv

#include "math/nthSmallest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "Random.hpp"

namespace hybridgv {
namespace test {
namespace {

double expected(std::vector<double> values, std::size_t n) {
  std::sort(values.begin(), values.end());
  return values[n];
}

TEST(NthSmallest, IsTheValueAtThatPlaceInOrder) {
  Random random(testSeed(), 70);
  for (int trial = 0; trial < 500; ++trial) {
    const int size = 1 + random.below(300), different = 1 + random.below(400);  // often repeated values
    std::vector<double> values;
    for (int i = 0; i < size; ++i) values.push_back(random.below(different));
    const auto n = static_cast<std::size_t>(random.below(size));
    const std::vector<double> before = values;
    EXPECT_EQ(math::nthSmallest(values, n), expected(before, n)) << size << " values, place " << n;
    EXPECT_TRUE(std::is_permutation(values.begin(), values.end(), before.begin()));
  }
}

TEST(NthSmallest, TakesSortedEqualAndInfiniteValues) {
  std::vector<double> rising, equal(1000, 3), falling;
  for (int i = 0; i < 1000; ++i) {
    rising.push_back(i);
    falling.push_back(1000 - i);
  }
  rising.back() = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& values : {rising, equal, falling})
    for (const std::size_t n : {0, 1, 499, 998, 999}) {
      std::vector<double> copy = values;
      EXPECT_EQ(math::nthSmallest(copy, n), expected(values, n)) << n;
    }
}

TEST(NthSmallest, TakesManyValuesInPatterns) {
  constexpr std::size_t kSize = 100000;
  std::vector<double> pipes, saw, twoValues;
  for (std::size_t i = 0; i < kSize; ++i) {
    pipes.push_back(static_cast<double>(std::min(i, kSize - i)));
    saw.push_back(static_cast<double>(i % 317));
    twoValues.push_back(static_cast<double>(i % 2));
  }
  for (const std::vector<double>& values : {pipes, saw, twoValues}) {
    std::vector<double> copy = values;
    EXPECT_EQ(math::nthSmallest(copy, kSize / 3), expected(values, kSize / 3));
  }
}

TEST(NthSmallest, OfNaNEnds) {
  std::vector<double> values(100, std::numeric_limits<double>::quiet_NaN());
  values[3] = 1;
  math::nthSmallest(values, 50);
}

TEST(NthSmallest, MedianOfNoneIsZeroAndOfTwoTheLarger) {
  std::vector<double> none, two{2, 1}, three{5, 1, 3};
  EXPECT_EQ(math::median(none), 0);
  EXPECT_EQ(math::median(two), 2);
  EXPECT_EQ(math::median(three), 3);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

#include "robust/FocalLengthGuess.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "Random.hpp"

namespace hybridgv {
namespace robust {
namespace {

std::vector<double> guesses(const FocalLengthGuess& guess) {
  std::vector<double> result;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    math::RandomStream random(test::testSeed(), i);
    result.push_back(guess.draw(random));
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(FocalLengthGuess, LeansToLongOnesAroundTheImageSize) {
  const std::vector<double> drawn = guesses(FocalLengthGuess::around(1000, 0, 1e9));
  EXPECT_NEAR(drawn.front(), 1000 / std::sqrt(2), 5);
  EXPECT_NEAR(drawn[drawn.size() / 2], 1000 * std::sqrt(2), 50);
  EXPECT_NEAR(drawn.back(), 2000 * std::sqrt(2), 5);
}

TEST(FocalLengthGuess, StaysInTheRangeOfTheOptions) {
  const std::vector<double> drawn = guesses(FocalLengthGuess::around(1000, 1200, 1500));
  EXPECT_EQ(drawn.front(), 1200);
  EXPECT_EQ(drawn.back(), 1500);
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

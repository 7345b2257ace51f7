#include "robust/FocalLengthPrior.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridgv {
namespace robust {
namespace {

const FocalLengthPrior kPrior{1000, 0.1};

TEST(FocalLengthPrior, WeightIsTheDerivativeOfHalfTheCost) {
  for (const double f : {300.0, 900.0, 1000.0, 1100.0, 4000.0}) {
    const double step = 1e-6, derivative = (kPrior.cost(f * std::exp(step)) - kPrior.cost(f * std::exp(-step))) / (2 * step);
    EXPECT_NEAR(kPrior.weight(f) * kPrior.logDifference(f), derivative / 2, 1e-6) << f;
    EXPECT_GE(kPrior.weight(f), 0);
  }
  EXPECT_EQ(kPrior.cost(1000), 0);
}

// A normal prior would cost 480 for a focal length that is 9 times too large.
TEST(FocalLengthPrior, GivesWayToTheData) { EXPECT_LT(kPrior.cost(9000), 21); }

TEST(FocalLengthPrior, SpeaksForAPoseByAboutOneInlierAndAgainstItByLessThanTwo) {
  EXPECT_GT(kPrior.logOdds(1000), 1);
  EXPECT_LT(kPrior.logOdds(1000), 1.2);
  EXPECT_NEAR(kPrior.logOdds(9000), std::log10(0.05), 1e-12);
}

// Student's density of x, of an integral of 1.
TEST(FocalLengthPrior, OddsAreOfADensity) {
  double sum = 0;
  const double step = 0.001;
  for (double x = -200; x < 200; x += step) sum += step * std::exp(-kPrior.cost(1000 * std::exp(0.1 * x)) / 2);
  EXPECT_NEAR(std::pow(10, kPrior.logOdds(1000)), std::log(30) / 0.1 / sum, 1e-3);
}

TEST(FocalLengthPrior, WithoutOneNothingIsAdded) {
  const FocalLengthPrior none;
  for (const double f : {1e-3, 1.0, 1e6}) {
    EXPECT_EQ(none.cost(f), 0);
    EXPECT_EQ(none.weight(f), 0);
    EXPECT_EQ(none.logOdds(f), 0);
  }
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

#include "robust/InlierBelief.hpp"

#include <gtest/gtest.h>

namespace hybridgv {
namespace {

using robust::InlierBelief;

const std::vector<InlierBelief::SampleKind> kThreePointsFourPointsSixRays = {{0, 3, 1}, {0, 4, 1}, {6, 0, 1}};

TEST(InlierBelief, IsThePriorsMeanAtFirst) {
  const std::vector<double> p = InlierBelief(kThreePointsFourPointsSixRays).successProbabilities({0, 0, 0});
  EXPECT_NEAR(p[0], 1 / 4., 2e-3);  // the mean of w^3
  EXPECT_NEAR(p[1], 1 / 5., 2e-3);
  EXPECT_NEAR(p[2], 1 / 7., 3e-3);
}

TEST(InlierBelief, FailuresSpeakForSmallSamples) {
  const InlierBelief belief(kThreePointsFourPointsSixRays);
  std::vector<double> before = belief.successProbabilities({0, 0, 0});
  for (const int failures : {10, 100, 1000, 10000}) {
    const std::vector<double> after = belief.successProbabilities({failures, 0, 0});
    EXPECT_LT(after[0], before[0]);
    EXPECT_LT(after[1], before[1]);
    EXPECT_LT(after[1] / after[0], before[1] / before[0]) << "four points have lost more than three";
    before = after;
  }
}

// Failures of one kind are half believed to be the other's as well.
TEST(InlierBelief, FailuresOfPointsLeaveMoreHopeInRays) {
  const InlierBelief belief(kThreePointsFourPointsSixRays);
  const std::vector<double> before = belief.successProbabilities({0, 0, 0}), after = belief.successProbabilities({1000, 0, 0});
  EXPECT_LT(after[0], 0.01 * before[0]);
  EXPECT_GT(after[2], 0.2 * before[2]);
  EXPECT_LT(after[2], before[2]);
}

// With an inlier share of 0.1 one sample of three points in a thousand succeeds.
TEST(InlierBelief, ComesNearTheTruthWhereSamplesFailAsOftenAsItSays) {
  const double afterTwoThousand = InlierBelief({{0, 3, 1}}).successProbabilities({2000})[0];
  EXPECT_GT(afterTwoThousand, 1e-5);
  EXPECT_LT(afterTwoThousand, 1e-3);
}

}  // namespace
}  // namespace hybridgv

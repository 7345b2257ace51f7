#include "robust/SolverChoice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <string>

namespace hybridgv {
namespace {

using namespace robust;

int noSolution(const correspondences::RayMatch*, const correspondences::PointMatch*, FocalPose*) { return 0; }

Strategy mock(double prior, double cost) {
  return {{Solver::P4Pf, "mock", 0, 4, RayDraw::Uniform, 0, cost, 1, 0, false, {}, &noSolution}, prior};
}

// Shares of the draws, on an even grid of random numbers.
std::vector<double> shares(const SolverChoice& choice) {
  std::vector<double> result(choice.strategies().size(), 0);
  const int count = 100000;
  for (int i = 0; i < count; ++i) result[choice.choose((i + 0.5) / count)] += 1. / count;
  return result;
}

TEST(SolverChoice, BeforeAPoseIsKnownAllGetTheSameTimeTimesTheirPrior) {
  const SolverChoice choice({mock(1, 2), mock(1, 20), mock(3, 6)});
  const std::vector<double> share = shares(choice);
  EXPECT_NEAR(share[0] * 2, share[1] * 20, 1e-3);
  EXPECT_NEAR(share[0] * 2 * 3, share[2] * 6, 1e-3);
  EXPECT_EQ(choice.missProbability(), 1);
}

TEST(SolverChoice, WeightIsPriorTimesWhatASampleAddsToCertaintyOverCostHoweverOftenItWasDrawn) {
  SolverChoice choice({mock(1, 2), mock(2, 3), mock(1, 5)});
  const double prior[] = {1, 2, 1}, cost[] = {2, 3, 5};
  const std::vector<double> P = {0.03, 0.02, 0.08};
  choice.setAllInlierProbabilities(P);
  choice.addDraws(0, 1000);
  double weight[3], sum = 0;
  for (std::size_t s = 0; s < 3; ++s) sum += weight[s] = prior[s] * -std::log(1 - P[s]) / cost[s];
  const std::vector<double> share = shares(choice);
  for (std::size_t s = 0; s < 3; ++s) EXPECT_NEAR(share[s], weight[s] / sum, 1e-4);
}

// A sample that fails once in a million says as much as 131 that have inliers only once in ten.
TEST(SolverChoice, ASlowSolverIsDrawnWhereItsSamplesAreAlmostSure) {
  SolverChoice choice({mock(1, 1), mock(1, 20)});
  choice.setAllInlierProbabilities({0.1, 1 - 1e-6});
  EXPECT_EQ(shares(choice)[0], 0);
  choice.setAllInlierProbabilities({0.9, 1 - 1e-6});
  EXPECT_EQ(shares(choice)[1], 0);
}

Strategy mockOfPoints(int points, double cost) {
  Strategy strategy = mock(1, cost);
  strategy.solver.points = points;
  return strategy;
}

TEST(SolverChoice, ManyFailuresSpeakForSmallSamplesThatTakeLittleTime) {
  SolverChoice choice({mockOfPoints(3, 1), mockOfPoints(4, 1), mockOfPoints(3, 100)});
  const std::vector<double> before = shares(choice);
  choice.addDraws(0, 100);
  choice.learnFromFailures();
  EXPECT_EQ(shares(choice), before) << "too few";
  choice.addDraws(0, 1000);
  choice.addDraws(1, 1000);
  choice.learnFromFailures();
  const std::vector<double> after = shares(choice);
  EXPECT_GT(after[0], before[0]);
  EXPECT_GT(after[0], 2 * after[1]);
  EXPECT_EQ(after[2], 0) << "as good, and a hundred times slower";
}

TEST(SolverChoice, WhatIsKnownCountsMoreThanFailures) {
  SolverChoice choice({mockOfPoints(3, 1), mockOfPoints(4, 1)});
  choice.addDraws(0, 1000);
  choice.setAllInlierProbabilities({0.02, 0.02});
  const std::vector<double> known = shares(choice);
  choice.learnFromFailures();
  EXPECT_EQ(shares(choice), known);
}

TEST(SolverChoice, HopelessStrategiesAreNotDrawn) {
  SolverChoice choice({mock(1, 2), mock(1, 2), mock(1, 1000)});
  choice.setAllInlierProbabilities({0.01, 0, 0.05});
  const std::vector<double> share = shares(choice);
  EXPECT_EQ(share[1], 0) << "no inliers of its kind";
  EXPECT_EQ(share[2], 0) << "a hundred times slower";
}

TEST(SolverChoice, IsDefinedWhenNoStrategyHasAChance) {
  SolverChoice choice({mock(1, 2), mock(1, 2)});
  choice.setAllInlierProbabilities({0, 0});
  EXPECT_EQ(choice.missProbability(), 1);
  EXPECT_NEAR(shares(choice)[0], 0.5, 1e-4);
}

TEST(SolverChoice, MissProbabilityIsTheProductOverAllDraws) {
  SolverChoice choice({mock(1, 2), mock(1, 20)});
  choice.addDraws(0, 3);
  choice.addDraws(1, 2);
  choice.setAllInlierProbabilities({0.5, 0.1});
  EXPECT_NEAR(choice.missProbability(), std::pow(0.5, 3) * std::pow(0.9, 2), 1e-12);
}

TEST(SolverChoice, SaysHowManySamplesBringTheMissProbabilityToATarget) {
  SolverChoice choice({mock(1, 2)});
  EXPECT_EQ(choice.samplesUntil(1e-4), 0) << "nothing is known yet";
  choice.setAllInlierProbabilities({0.1});
  choice.addDraws(0, 10);
  const double more = choice.samplesUntil(1e-4);
  EXPECT_NEAR(more, std::log(1e-4) / std::log(0.9) - 10, 1e-6);
  choice.addDraws(0, static_cast<int>(std::ceil(more)));
  EXPECT_LT(choice.missProbability(), 1e-4);
  EXPECT_EQ(choice.samplesUntil(1e-4), 0);
}

// Drawing until the miss probability is below 1e-2 misses in about one of a hundred runs, whichever solvers were drawn.
TEST(SolverChoice, StoppingAtTheMissProbabilityMissesAsOftenAsItSays) {
  const std::vector<double> P = {0.03, 0.05, 0.2};
  int missed = 0;
  const int runs = 5000;
  for (int run = 0; run < runs; ++run) {
    SolverChoice choice({mock(1, 1), mock(1, 2), mock(1, 8)});
    choice.setAllInlierProbabilities(P);
    RandomStream random(9, static_cast<std::uint64_t>(run));
    bool found = false;
    while (choice.missProbability() > 0.01) {
      const std::size_t s = choice.choose(random.uniform());
      choice.addDraws(s, 1);
      found = found || random.uniform() < P[s];
    }
    missed += !found;
  }
  EXPECT_LT(missed, 0.01 * runs + 4 * std::sqrt(0.01 * runs));
  EXPECT_GT(missed, 0.006 * runs - 4 * std::sqrt(0.006 * runs));
}

TEST(SolverChoice, StrategiesWithoutEnoughDataAreLeftOut) {
  const std::vector<sac::SolverPrior> all = {{Solver::P4Pf, 1}, {Solver::H13f, 2}, {Solver::H51f, 1}, {Solver::H70f, 1}};
  const std::map<RayDraw, std::string> marks = {
      {RayDraw::Uniform, " "}, {RayDraw::OneCamera, "[5] "}, {RayDraw::AllButOne, "[6+1] "}, {RayDraw::Spread, "* "}};
  const auto names = [&](int cameras, int raysPerCamera, int points) {
    std::vector<int> cameraOfRay, rays(static_cast<std::size_t>(cameras * raysPerCamera)), list(static_cast<std::size_t>(points));
    for (int i = 0; i < cameras * raysPerCamera; ++i) cameraOfRay.push_back(i % cameras);
    std::iota(rays.begin(), rays.end(), 0);
    std::iota(list.begin(), list.end(), 0);
    std::string result;
    for (const Strategy& strategy : makeStrategies(all, Sampler(cameraOfRay, rays, list, false)))
      result += strategy.solver.name + marks.at(strategy.solver.draw);
    return result;
  };
  EXPECT_EQ(names(5, 10, 10), "p4pf h13f h51f[5] h51f* h70f[6+1] h70f* ");
  EXPECT_EQ(names(1, 10, 10), "p4pf h13f h51f[5] ");
  EXPECT_EQ(names(5, 2, 3), "h13f h51f* h70f* ");
  EXPECT_EQ(names(1, 0, 4), "p4pf ");
  EXPECT_EQ(names(5, 10, 0), "h70f[6+1] h70f* ");
  EXPECT_EQ(names(5, 1, 0), "");
}

}  // namespace
}  // namespace hybridgv

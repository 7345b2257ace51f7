#include "robust/ErrorMixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Random.hpp"

namespace hybridgv {
namespace {

using namespace robust;

constexpr double kThreshold = 10, kChanceShare = 0.05;

InlierCount half(std::size_t all) { return {all / 2, all, kThreshold, kThreshold, kChanceShare}; }

double oddsAt(const ErrorMixture& mixture, double error) { return mixture.oddsAt(error * error); }

// The integral of f from 0 to infinity, with x = t / (1 - t).
template <class Function>
double integral(Function f) {
  const int steps = 100000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    sum += f(t / (1 - t)) / ((1 - t) * (1 - t));
  }
  return sum / steps;
}

// With as many inliers as outliers the odds are the ratio of the densities; an outlier's is chanceShare / (2 threshold) on a
// line, chanceShare / (pi threshold^2) in the plane.
TEST(ErrorMixture, DensitiesOfInliersHaveIntegral1) {
  const ErrorMixture rays = rayMixture(0.7, half(100)), points = pointMixture(0.7, half(100));
  EXPECT_NEAR(2 * integral([&](double e) { return oddsAt(rays, e) * kChanceShare / (2 * kThreshold); }), 1, 1e-5);
  EXPECT_NEAR(
      integral([&](double e) { return oddsAt(points, e) * kChanceShare / (M_PI * kThreshold * kThreshold) * 2 * M_PI * e; }), 1,
      1e-5);
}

TEST(ErrorMixture, InliersHaveTheMedianOfNormalErrors) {
  const ErrorMixture rays = rayMixture(1, half(100)), points = pointMixture(1, half(100));
  const double median = 0.6744897501960817, median2 = 1.1774100225154747;
  EXPECT_NEAR(2 * integral([&](double e) { return e < median ? oddsAt(rays, e) * kChanceShare / (2 * kThreshold) : 0; }), 0.5,
              1e-4);
  EXPECT_NEAR(integral([&](double e) { return e < median2 ? oddsAt(points, e) * kChanceShare / 100 * 2 * e : 0; }), 0.5, 1e-4);
}

TEST(ErrorMixture, AtTheBoundaryInlierAndOutlierAreEquallyLikely) {
  for (const auto& mixture : {rayMixture(0.3, half(100)), pointMixture(0.3, half(100))}) {
    EXPECT_LT(mixture.boundary, kThreshold);
    EXPECT_NEAR(oddsAt(mixture, mixture.boundary), 1, 1e-9);
  }
  EXPECT_EQ(rayMixture(8, half(100)).boundary, kThreshold);
  EXPECT_EQ(rayMixture(1, {1, 1000, kThreshold, kThreshold, 0.5}).boundary, 2.5);
}

TEST(ErrorMixture, TheBoundaryMayBeTwiceTheThresholdButNotAboveTheBound) {
  const auto boundary = [](double threshold, double bound) {
    return rayMixture(1, {99, 100, threshold, bound, kChanceShare}).boundary;
  };
  const double unlimited = boundary(100, 100);
  EXPECT_GT(unlimited, 2.5);
  EXPECT_EQ(boundary(1, 100), 2);
  EXPECT_EQ(boundary(1, 1.5), 1.5);
}

// What the least-squares problem adds up is -2 times the log of the likelihood, up to a constant.
TEST(ErrorMixture, TheLossIsTheLikelihoods) {
  const ErrorMixture mixture = pointMixture(0.5, half(40));
  const KindLoss loss = mixture.loss();
  const auto cost = [&](double squared) {
    const double x = squared / (loss.scale * loss.scale);
    return loss.precision * loss.scale * loss.scale * std::log((1 + loss.odds) / (1 + loss.odds * std::pow(1 + x, -8)));
  };
  for (const double squared : {0.01, 0.3, 4., 1e3})
    EXPECT_NEAR(cost(squared) - cost(0), -2 * (mixture.logLikelihood({squared}) - mixture.logLikelihood({0})), 1e-9);
  EXPECT_NEAR(mixture.logLikelihood({INFINITY}), std::log(mixture.outlierShare), 1e-12);
}

TEST(ErrorMixture, TheRightNoiseIsTheLikeliest) {
  test::Random random(test::testSeed(), 130);
  std::vector<double> squared;
  for (int i = 0; i < 400; ++i) squared.push_back(std::pow(i % 2 ? random.normal() : random.uniform(0, 200), 2));
  const double right = rayMixture(1, half(400)).logLikelihood(squared);
  for (const double deviation : {0.5, 0.7, 1.5, 2.}) EXPECT_LT(rayMixture(deviation, half(400)).logLikelihood(squared), right);
}

TEST(ErrorMixture, NoInliersAndNoCorrespondencesAreHarmless) {
  for (const std::size_t all : {0, 1, 50}) {
    const ErrorMixture mixture = rayMixture(1, {0, all, kThreshold, kThreshold, kChanceShare});
    EXPECT_TRUE(std::isfinite(mixture.odds) && mixture.odds > 0 && mixture.boundary > 0);
    EXPECT_TRUE(std::isfinite(mixture.logLikelihood(std::vector<double>(all, 4))));
  }
}

}  // namespace
}  // namespace hybridgv

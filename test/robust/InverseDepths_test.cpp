#include "robust/InverseDepths.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "Random.hpp"

namespace hybridgv {
namespace {

using namespace robust;

// Of a scene with this mean and deviation, seen with errors of up to `noise`.
InverseDepths makeDepths(test::Random& random, int count, double mean, double deviation, double noise) {
  InverseDepths depths;
  for (int i = 0; i < count; ++i) {
    const double ofError = noise * random.uniform();
    depths.values.push_back(mean + deviation * random.normal() + ofError * random.normal());
    depths.variances.push_back(ofError * ofError);
  }
  return depths;
}

// The errors are up to 20 times the scene's deviation; what is exact tells most.
TEST(InverseDepths, TheSceneIsFoundBeneathTheErrors) {
  test::Random random(test::testSeed(), 170);
  for (const double unit : {1e-6, 1., 1e6})
    for (const double noise : {0., 0.5, 4.}) {
      double mean = 0, variance = 0;
      constexpr int kRepetitions = 50;
      for (int i = 0; i < kRepetitions; ++i) {
        const DepthDistribution found = depthDistribution(makeDepths(random, 400, 5 * unit, 0.2 * unit, noise * unit));
        mean += found.mean / unit / kRepetitions;
        variance += found.variance / unit / unit / kRepetitions;
      }
      EXPECT_NEAR(mean, 5, 0.02) << noise;
      EXPECT_NEAR(std::sqrt(variance), 0.2, noise > 1 ? 0.08 : 0.03) << noise;
    }
}

TEST(InverseDepths, AFewThatAreElsewhereDoNotCount) {
  test::Random random(test::testSeed(), 171);
  InverseDepths depths = makeDepths(random, 100, 5, 0.2, 0.3);
  for (int i = 0; i < 20; ++i) {
    depths.values.push_back(random.uniform(20, 100));
    depths.variances.push_back(0.01);
  }
  const DepthDistribution found = depthDistribution(depths);
  EXPECT_NEAR(found.mean, 5, 0.1);
  EXPECT_NEAR(std::sqrt(found.variance), 0.2, 0.1);
  for (int i = 100; i < 120; ++i)
    EXPECT_TRUE(found.isOneOfFew(depths.values[static_cast<std::size_t>(i)], depths.variances[static_cast<std::size_t>(i)]));
}

TEST(InverseDepths, AValueIsTrustedAsFarAsItIsMoreExactThanTheSceneIsDeep) {
  const DepthDistribution scene{5, 0.04};
  EXPECT_EQ(scene.trust(5.1, 0), 1);
  EXPECT_DOUBLE_EQ(scene.trust(5.1, 0.04), 0.5);
  EXPECT_LT(scene.trust(5.1, 4), 0.01);
  // One that lies elsewhere, by what it is itself more exact than far away.
  EXPECT_GT(scene.trust(50, 4), 0.99);
}

TEST(InverseDepths, EqualAndFewValuesGiveNumbers) {
  for (const int count : {1, 2, 10}) {
    const auto size = static_cast<std::size_t>(count);
    const DepthDistribution found = depthDistribution({std::vector<double>(size, 5.), std::vector<double>(size, 0.)});
    EXPECT_DOUBLE_EQ(found.mean, 5);
    EXPECT_GT(found.variance, 0);
    EXPECT_LT(std::sqrt(found.variance), 0.01);
  }
}

}  // namespace
}  // namespace hybridgv

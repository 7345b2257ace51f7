#include "math/roots/Bernstein.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "Random.hpp"

namespace hybridgv {
namespace test {
namespace {

constexpr int kDegree = 7;

// Smallest and largest number of sign changes over all choices of the uncertain signs.
math::SignChanges signChangesByEnumeration(const double (&b)[kDegree + 1], double tolerance) {
  math::SignChanges changes{kDegree + 1, 0};
  for (int choice = 0; choice < 1 << (kDegree + 1); ++choice) {
    bool positive[kDegree + 1];
    bool possible = true;
    for (int i = 0; i <= kDegree; ++i) {
      positive[i] = choice >> i & 1;
      possible = possible && (std::abs(b[i]) <= tolerance || positive[i] == (b[i] > 0));
    }
    if (!possible) continue;
    int count = 0;
    for (int i = 1; i <= kDegree; ++i) count += positive[i] != positive[i - 1];
    changes.least = std::min(changes.least, count);
    changes.most = std::max(changes.most, count);
  }
  return changes;
}

TEST(SignChanges, AreThoseOfAllChoicesOfTheUncertainSigns) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Random random(testSeed(), i);
    double b[kDegree + 1];
    for (double& coefficient : b) coefficient = random.uniform(-1, 1);
    const double tolerance = random.uniform();
    const math::SignChanges expected = signChangesByEnumeration(b, tolerance);
    const math::SignChanges changes = math::signChanges<kDegree>(b, tolerance);
    EXPECT_EQ(changes.least, expected.least) << "instance " << i;
    EXPECT_EQ(changes.most, expected.most) << "instance " << i;
  }
}

double value(const double (&b)[kDegree + 1], double x) {
  double sum = 0, binomial = 1;
  for (int i = 0; i <= kDegree; ++i) {
    sum += b[i] * binomial * std::pow(x, i) * std::pow(1 - x, kDegree - i);
    binomial = binomial * (kDegree - i) / (i + 1);
  }
  return sum;
}

TEST(Halve, GivesTheSamePolynomialOnBothHalves) {
  Random random(testSeed());
  double b[kDegree + 1], left[kDegree + 1], right[kDegree + 1];
  for (double& coefficient : b) coefficient = random.uniform(-1, 1);
  math::halve<kDegree>(b, left, right);
  for (double x = 0; x <= 1; x += 0.125) {
    EXPECT_NEAR(value(left, x), value(b, x / 2), 1e-14);
    EXPECT_NEAR(value(right, x), value(b, (1 + x) / 2), 1e-14);
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

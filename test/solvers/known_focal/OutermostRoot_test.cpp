#include "solvers/known_focal/OutermostRoot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Random.hpp"

namespace hybridgv {
namespace test {
namespace {

// To the rounding of the inflection point, to which it is relative, and near to the one that is meant, which is less exact where others are near to it.
void expectRoot(double x, double b, double c, double d, double expected) {
  const double scale = std::abs(x) + std::abs(b), size = (scale * scale + std::abs(c)) * scale + std::abs(d);
  EXPECT_LE(std::abs(((x + b) * x + c) * x + d), 2e-15 * size) << b << ", " << c << ", " << d;
  EXPECT_NEAR(x, expected, 1e-5 * (1 + std::abs(expected))) << b << ", " << c << ", " << d;
}

// In a single lane and in one of two, the other of which holds something else.
void expectRoot(double b, double c, double d, double expected) {
  using namespace solvers::known_focal::ordinary;
  expectRoot(cubicRoot<double>(b, c, d), b, c, d, expected);
  expectRoot(cubicRoot<math::Pair>(math::Pair{1, b}, math::Pair{-7, c}, math::Pair{3, d})[1], b, c, d, expected);
}

TEST(OutermostRoot, IsTheOneFarthestFromTheInflectionPointOfThree) {
  Random random(testSeed(), 47);
  for (int i = 0; i < 2000; ++i) {
    double x[3] = {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    std::sort(x, x + 3);
    const double middle = (x[0] + x[1] + x[2]) / 3;
    if (std::abs((x[2] - middle) - (middle - x[0])) < 1e-3) continue;  // both are as far
    const double expected = x[2] - middle > middle - x[0] ? x[2] : x[0];
    expectRoot(-x[0] - x[1] - x[2], x[0] * x[1] + x[0] * x[2] + x[1] * x[2], -x[0] * x[1] * x[2], expected);
  }
}

// (x - a) ((x - m)^2 + h^2), from a nearly triple root to complex ones far away.
TEST(OutermostRoot, IsTheOnlyRealOne) {
  Random random(testSeed(), 48);
  for (int i = 0; i < 2000; ++i) {
    const double a = random.uniform(-2, 2), m = a + std::pow(10, random.uniform(-1, 2)) * random.uniform(-1, 1),
                 h = std::abs(m - a) * std::pow(10, random.uniform(0, 2)), square = m * m + h * h;
    expectRoot(-a - 2 * m, square + 2 * a * m, -a * square, a);
  }
}

TEST(OutermostRoot, OfATripleOneIsThatOne) {
  for (const double a : {0., 1., -3.}) expectRoot(-3 * a, 3 * a * a, -a * a * a, a);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

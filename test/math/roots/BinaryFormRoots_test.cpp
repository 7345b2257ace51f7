#include "math/roots/BinaryFormRoots.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "Random.hpp"

namespace hybridgv {
namespace math {
namespace {

using test::Random;
using test::testSeed;

constexpr double kPi = Random::kPi;

// A form as the product of its real roots (c : s) = (cos a : sin a) and of definite quadratic factors.
struct Form {
  std::vector<double> angles;
  int definiteFactors = 0;
  double scale = 1;

  double operator()(double c, double s) const {
    double value = scale;
    for (double angle : angles) value *= c * std::sin(angle) - s * std::cos(angle);
    for (int i = 0; i < definiteFactors; ++i) value *= c * c + 0.3 * (i + 1) * c * s + s * s;
    return value;
  }
};

double angleBetween(const Direction& direction, double angle) {
  return std::abs(std::asin(std::sin(std::atan2(direction.s, direction.c) - angle)));
}

template <int D, class F>
std::vector<Direction> roots(const F& form) {
  Direction found[BinaryFormRoots<D>::kMaxRoots];
  const int count = BinaryFormRoots<D>::find(form, found);
  EXPECT_GE(count, 0);
  EXPECT_LE(count, BinaryFormRoots<D>::kMaxRoots);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(std::hypot(found[i].c, found[i].s), 1, 1e-14);
  return {found, found + std::max(count, 0)};
}

double distanceToNearest(const std::vector<Direction>& found, double angle) {
  double best = kPi;
  for (const Direction& direction : found) best = std::min(best, angleBetween(direction, angle));
  return best;
}

// Every root is found to `accuracy`, and everything found is that close to a root.
template <int D>
void expectRoots(const Form& form, double accuracy) {
  const std::vector<Direction> found = roots<D>(form);
  for (double angle : form.angles) EXPECT_LT(distanceToNearest(found, angle), accuracy) << "lost the root " << angle;
  for (const Direction& direction : found) {
    double best = kPi;
    for (double angle : form.angles) best = std::min(best, angleBetween(direction, angle));
    EXPECT_LT(best, accuracy) << "no root there: " << std::atan2(direction.s, direction.c);
  }
}

template <int D>
void expectWellSeparatedRootsAreFoundOnce(int realRoots) {
  Random random(testSeed(), static_cast<std::uint64_t>(100 * D + realRoots));
  for (int trial = 0; trial < 300; ++trial) {
    Form form;
    form.definiteFactors = (D - realRoots) / 2;
    form.scale = random.uniform() < 0.5 ? 1 : -1;
    const double offset = random.uniform(0, kPi);
    for (int i = 0; i < realRoots; ++i) form.angles.push_back(offset + kPi * (i + random.uniform(-0.3, 0.3)) / realRoots);
    SCOPED_TRACE(trial);
    EXPECT_EQ(roots<D>(form).size(), form.angles.size());
    expectRoots<D>(form, 1e-8);
  }
}

TEST(BinaryFormRoots, FindsWellSeparatedRootsOnceInEvenDegree) {
  for (int realRoots : {2, 4, 8, 12}) expectWellSeparatedRootsAreFoundOnce<12>(realRoots);
  for (int realRoots : {2, 10}) expectWellSeparatedRootsAreFoundOnce<10>(realRoots);
  for (int realRoots : {2, 6}) expectWellSeparatedRootsAreFoundOnce<6>(realRoots);
}

TEST(BinaryFormRoots, FindsWellSeparatedRootsOnceInOddDegree) {
  for (int realRoots : {1, 3, 9}) expectWellSeparatedRootsAreFoundOnce<9>(realRoots);
  for (int realRoots : {1, 5}) expectWellSeparatedRootsAreFoundOnce<5>(realRoots);
}

TEST(BinaryFormRoots, FindsRandomRootsHoweverTheyLie) {
  Random random(testSeed(), 1);
  for (int trial = 0; trial < 2000; ++trial) {
    Form form{std::vector<double>(4), 4};
    for (double& angle : form.angles) angle = random.uniform(0, kPi);
    SCOPED_TRACE(trial);
    // Two roots 1e-4 apart are determined to about 1e-12 / 1e-4.
    expectRoots<12>(form, 1e-5);
  }
}

TEST(BinaryFormRoots, FindsRootsAtTheSampleDirections) {
  for (int j = 0; j < 13; ++j) expectRoots<12>({{j * kPi / 13, 1.0}, 5}, 1e-5);
  for (int j = 0; j < 10; ++j) expectRoots<9>({{j * kPi / 10}, 4}, 1e-8);
}

TEST(BinaryFormRoots, DoesNotLoseDoubleRoots) {
  Random random(testSeed(), 2);
  for (int trial = 0; trial < 2000; ++trial) {
    const double angle = random.uniform(0, kPi);
    SCOPED_TRACE(trial);
    expectRoots<12>({{angle, angle}, 5}, 3e-5);
    expectRoots<9>({{angle, angle, angle + 1}, 3}, 3e-5);
  }
}

// Two roots a little apart, which inaccurate coefficients hide. They are determined to about 1e-15 / separation.
template <int D>
void expectClosePairsAreFound() {
  Random random(testSeed(), 20 + D);
  for (const double separation : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
    for (int trial = 0; trial < 200; ++trial) {
      const double angle = random.uniform(0, kPi);
      SCOPED_TRACE(separation);
      Form form{{angle, angle + separation}, (D - 2) / 2};
      if (D % 2 == 1) form.angles.push_back(angle + 1);
      const std::vector<Direction> found = roots<D>(form);
      const double accuracy = std::max(1e-10 / separation, 1e-10);
      for (const double root : form.angles) EXPECT_LT(distanceToNearest(found, root), accuracy) << "degree " << D;
    }
}

TEST(BinaryFormRoots, FindsCloseRootsInEveryDegree) {
  expectClosePairsAreFound<9>();
  expectClosePairsAreFound<10>();
  expectClosePairsAreFound<12>();
  expectClosePairsAreFound<14>();
  expectClosePairsAreFound<16>();
  expectClosePairsAreFound<20>();
}

// The Bernstein coefficients of a form that is a power of one linear form are known.
TEST(BinaryFormRoots, BernsteinCoefficientsAreExactToRounding) {
  for (int degree = 4; degree <= 20; ++degree) {
    const int first = 1 - (degree + 1) / 2, count = degree + 1;
    std::vector<double> matrix(static_cast<std::size_t>(count * count));
    bernsteinMatrix(degree, first, matrix.data());
    const double w = kPi / count;
    for (const double angle : {0.3, 1.2, 2.9})
      for (int i = 0; i < count; ++i) {
        double coefficient = 0;
        for (int k = 0; k < count; ++k)
          coefficient += matrix[static_cast<std::size_t>(i * count + k)] * std::pow(std::cos((first + k) * w - angle), degree);
        const double expected = std::pow(std::cos(angle), degree - i) * std::pow(std::cos(w - angle), i);
        EXPECT_NEAR(coefficient, expected, 2e-14) << degree << " " << i;
      }
  }
}

template <int D>
void expectRootsBetween(const Form& form, double from, double to) {
  Direction found[BinaryFormRoots<D>::kMaxRoots];
  const int count = BinaryFormRoots<D>::findSampledBetween(
      [&](const double* c, const double* s, double* p) {
        for (int j = 0; j < BinaryFormRoots<D>::kSamples; ++j) p[j] = form(c[j], s[j]);
      },
      {std::cos(from), std::sin(from)}, {std::cos(to), std::sin(to)}, found);
  const std::vector<Direction> list(found, found + count);
  int inside = 0;
  for (const double angle : form.angles) {
    if (std::min(std::abs(angle - from), std::abs(angle - to)) < 1e-6) return;  // either is right
    if (angle < from || angle > to) continue;
    ++inside;
    EXPECT_LT(distanceToNearest(list, angle), 1e-6) << "lost the root " << angle;
  }
  EXPECT_EQ(count, inside);
}

TEST(BinaryFormRoots, FindsTheRootsOfAnArcAndNoOthers) {
  Random random(testSeed(), 7);
  for (int trial = 0; trial < 1000; ++trial) {
    const double from = random.uniform(0, 1), to = from + random.uniform(0.05, 2);
    Form form{{}, 6};
    for (int i = 0; i < 4; ++i) form.angles.push_back(kPi * (i + random.uniform(0.05, 0.95)) / 4);
    SCOPED_TRACE(trial);
    expectRootsBetween<16>(form, from, to);
    form.definiteFactors = 3;
    expectRootsBetween<10>(form, from, to);
  }
}

TEST(BinaryFormRoots, FindsAllRootsOfASquare) {
  Random random(testSeed(), 3);
  for (int trial = 0; trial < 500; ++trial) {
    Form form{{}, 2};
    const double offset = random.uniform(0, kPi);
    for (int i = 0; i < 8; ++i) form.angles.push_back(offset + i / 2 * kPi / 4);
    SCOPED_TRACE(trial);
    expectRoots<12>(form, 1e-4);
  }
}

TEST(BinaryFormRoots, FindsRootsOfHighMultiplicityApproximately) {
  Random random(testSeed(), 4);
  for (int trial = 0; trial < 200; ++trial) {
    const double angle = random.uniform(0, kPi);
    SCOPED_TRACE(trial);
    expectRoots<12>({{angle, angle, angle, angle}, 4}, 1e-2);
    expectRoots<6>({{angle, angle, angle, angle, angle, angle}, 0}, 0.1);
  }
}

// All roots within `width`: the samples span many orders of magnitude.
TEST(BinaryFormRoots, FindsClusteredRoots) {
  Random random(testSeed(), 5);
  for (double width : {0.3, 0.1, 0.03}) {
    for (int trial = 0; trial < 200; ++trial) {
      Form form{{}, 0};
      const double offset = random.uniform(0, kPi);
      for (int i = 0; i < 12; ++i) form.angles.push_back(offset + width * (i - 5.5) / 5.5);
      SCOPED_TRACE(trial);
      expectRoots<12>(form, 0.1 * width);
      // In the tightest cluster rounding may show a root twice, never hide one.
      if (width > 0.05) {
        EXPECT_EQ(roots<12>(form).size(), 12u) << width;
      }
    }
  }
}

TEST(BinaryFormRoots, DoesNotDependOnTheScaleOfTheForm) {
  for (double scale : {1e-250, 1e-100, 1.0, -1e100, 1e250}) {
    expectRoots<12>({{0.1, 0.7, 1.9, 2.0}, 4, scale}, 1e-8);
    expectRoots<9>({{0.1, 0.7, 1.9}, 3, scale}, 1e-8);
  }
}

TEST(BinaryFormRoots, FindsNoneInADefiniteForm) {
  EXPECT_TRUE(roots<12>(Form{{}, 6}).empty());
  EXPECT_TRUE(roots<6>(Form{{}, 3, -1}).empty());
}

TEST(BinaryFormRoots, FindsNoneInTheZeroForm) {
  EXPECT_TRUE(roots<12>([](double, double) { return 0.0; }).empty());
  EXPECT_TRUE(roots<9>([](double, double) { return 0.0; }).empty());
}

TEST(BinaryFormRoots, ReturnsForAnyValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(roots<12>([&](double, double) { return nan; }).empty());
  const double awkward[] = {nan, infinity, -infinity, 1e308, -1e308, 5e-324, 0, 1, -1};
  Random random(testSeed(), 6);
  for (int trial = 0; trial < 2000; ++trial) {
    Direction found[BinaryFormRoots<12>::kMaxRoots];
    const int count = BinaryFormRoots<12>::find([&](double, double) { return awkward[random.index(9)]; }, found);
    EXPECT_LE(count, BinaryFormRoots<12>::kMaxRoots);
  }
}

TEST(BinaryFormRoots, SamplesInOneCallAsOneByOne) {
  const Form form{{0.2, 0.9, 2.5}, 3};
  const std::vector<Direction> expected = roots<9>(form);
  Direction found[BinaryFormRoots<9>::kMaxRoots];
  const int count = BinaryFormRoots<9>::findSampled(
      [&](const double* c, const double* s, double* p) {
        for (int j = 0; j < BinaryFormRoots<9>::kPadded; ++j) p[j] = form(c[j], s[j]);
      },
      found);
  ASSERT_EQ(static_cast<std::size_t>(count), expected.size());
  for (int i = 0; i < count; ++i) EXPECT_EQ(found[i].c, expected[static_cast<std::size_t>(i)].c);
}

}  // namespace
}  // namespace math
}  // namespace hybridgv

#include "math/roots/RationalChebyshev.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "Random.hpp"

namespace hybridgv {
namespace test {
namespace {

using math::RationalChebyshev;

TEST(RationalChebyshev, WithoutPolesHasTheChebyshevNodes) {
  const RationalChebyshev rational(10, 0, 0.8L, 0.5L);
  for (int k = 0; k < 10; ++k)
    EXPECT_NEAR(static_cast<double>(rational.nodes[static_cast<std::size_t>(9 - k)]),
                0.5 * std::cos((k + 0.5) * Random::kPi / 10), 1e-15);
}

// (x^2 + rho^2)^m times the node polynomial's reciprocal oscillates evenly: its extrema between the nodes have equal size.
TEST(RationalChebyshev, NodePolynomialOverThePolesOscillatesEvenly) {
  const RationalChebyshev rational(28, 13, 0.8L, 0.97L);
  std::vector<double> extrema;
  for (int k = 0; k <= 28; ++k) {
    double largest = 0;
    for (double t = 0; t <= 1; t += 1.0 / 64) {
      const long double x = rational.pointAtPhase((k - 0.5L + t) * 3.14159265358979323846L);
      if (k == 0 && t < 0.5) continue;
      if (k == 28 && t > 0.5) continue;
      long double value = 1;
      for (long double node : rational.nodes) value *= x - node;
      for (int i = 0; i < 13; ++i) value /= x * x + 0.64L;
      largest = std::max(largest, std::abs(static_cast<double>(value)));
    }
    extrema.push_back(largest);
  }
  const auto range = std::minmax_element(extrema.begin(), extrema.end());
  EXPECT_LT(*range.second / *range.first, 1.01);
}

// p(x) / (x^2 + rho^2)^m with deg p < n is reproduced at any point.
TEST(RationalChebyshev, InterpolationIsExactInItsSpace) {
  const RationalChebyshev rational(28, 13, 0.8L, 0.97L);
  for (int degree = 0; degree < 28; ++degree) {
    const auto function = [&](long double x) {
      return std::pow(x, static_cast<long double>(degree)) / std::pow(x * x + 0.64L, 13.0L);
    };
    for (const long double x : {0.0L, 0.123L, -0.5L, 0.9L, -1.0L}) {
      const std::vector<long double> cardinals = rational.cardinals(x);
      long double sum = 0, scale = 0;
      for (std::size_t k = 0; k < cardinals.size(); ++k) {
        sum += cardinals[k] * function(rational.nodes[k]);
        scale = std::max(scale, std::abs(function(rational.nodes[k])));
      }
      EXPECT_NEAR(static_cast<double>(sum), static_cast<double>(function(x)), 1e-12 * static_cast<double>(scale))
          << "degree " << degree << ", x = " << static_cast<double>(x);
    }
  }
}

TEST(RationalChebyshev, WeightsGiveTheLeadingCoefficient) {
  const RationalChebyshev rational(28, 13, 0.8L, 0.97L);
  for (const int degree : {26, 27}) {
    long double sum = 0;
    for (std::size_t k = 0; k < 28; ++k) {
      const long double x = rational.nodes[k];
      sum += rational.weights[k] * std::pow(x, static_cast<long double>(degree)) / std::pow(x * x + 0.64L, 13.0L);
    }
    EXPECT_NEAR(static_cast<double>(sum), degree == 27 ? 1 : 0, 1e-9);
  }
}

TEST(RationalChebyshev, AtANodeOneCardinalIsOneAndTheOthersZero) {
  const RationalChebyshev rational(28, 13, 0.8L, 0.97L);
  const std::vector<long double> cardinals = rational.cardinals(rational.nodes[5]);
  for (std::size_t k = 0; k < cardinals.size(); ++k) EXPECT_EQ(cardinals[k], k == 5 ? 1.0L : 0.0L);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

#include <gtest/gtest.h>

#include <cmath>

#include "Random.hpp"
#include "math/simd/logarithm.hpp"

namespace hybridgv {
namespace {

using math::Doubles;

double logarithm(double x) { return math::logarithm(math::broadcast<Doubles>(x))[0]; }

void expectLogarithm(double x) { EXPECT_NEAR(logarithm(x), std::log(x), 5e-16 * std::abs(std::log(x))) << "of " << x; }

TEST(Logarithm, IsThatOfTheStandardLibrary) {
  test::Random random(test::testSeed(), 0);
  for (int i = 0; i < 20000; ++i) expectLogarithm(std::exp(random.uniform(-700, 700)));
}

TEST(Logarithm, IsAccurateNearOne) {
  EXPECT_EQ(logarithm(1), 0);
  test::Random random(test::testSeed(), 1);
  for (int i = 0; i < 20000; ++i) expectLogarithm(1 + std::exp(random.uniform(-36, 0)));
}

TEST(Logarithm, IsRightWhereTheExponentChanges) {
  for (const double x : {std::sqrt(0.5), std::sqrt(2.0), 0.5, 2.0, 4.0, 1e288, 2.3e-308})
    for (const double nearby : {std::nextafter(x, 0), x, std::nextafter(x, 2 * x)}) expectLogarithm(nearby);
}

}  // namespace
}  // namespace hybridgv

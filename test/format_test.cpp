#include "hybridgv/detail/format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <locale>

#include "Random.hpp"

namespace hybridgv {
namespace detail {
namespace {

TEST(Format, IsShortAndShowsTheValue) {
  EXPECT_EQ(format(0.0), "0");
  EXPECT_EQ(format(12.0), "12");
  EXPECT_EQ(format(0.1), "0.1");
  EXPECT_EQ(format(-1e-9), "-1e-09");
  EXPECT_EQ(format(100000.0), "100000");
  EXPECT_EQ(format(1e300), "1e+300");
  EXPECT_EQ(format(1 - 1e-16), "0.9999999999999999");
  EXPECT_EQ(format(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(format(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(format(std::nan("")), "nan");
  EXPECT_EQ(format(-std::nan("")), "nan");
}

TEST(Format, PrintsIntegersWithoutADecimalPoint) {
  EXPECT_EQ(format(0), "0");
  EXPECT_EQ(format(std::numeric_limits<int>::min()), "-2147483648");
}

TEST(Format, PrintsVectorsAndMatrices) {
  EXPECT_EQ(format(Eigen::Vector3d(1, -0.5, 1e20)), "(1, -0.5, 1e+20)");
  Eigen::Matrix3d matrix;
  matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9.5;
  EXPECT_EQ(format(matrix), "[1, 2, 3; 4, 5, 6; 7, 8, 9.5]");
}

TEST(Format, ReadsBackAsTheSameNumber) {
  test::Random random(test::testSeed());
  for (int i = 0; i < 100000; ++i) {
    const double value = random.uniform(-1, 1) * std::pow(10.0, random.uniform(-320, 308));
    EXPECT_EQ(std::strtod(format(value).c_str(), nullptr), value);
    EXPECT_LE(format(value).size(), 24u);
  }
}

// Decimal commas and groups of digits, as in much of the world.
struct Commas : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Format, DoesNotDependOnTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  EXPECT_EQ(format(1234567.5), "1234567.5");
  EXPECT_EQ(format(1234567), "1234567");
  std::locale::global(before);
}

}  // namespace
}  // namespace detail
}  // namespace hybridgv

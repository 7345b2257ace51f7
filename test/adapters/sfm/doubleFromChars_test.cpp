#include "doubleFromChars.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>

#include "Random.hpp"

namespace hybridgv {
namespace sfm {
namespace {

struct Read {
  std::size_t length;
  std::errc error;
  double value;
};

using Function = std::from_chars_result (*)(const char*, const char*, double&);

Read read(Function function, const std::string& text) {
  double value = -7;
  const std::from_chars_result result = function(text.data(), text.data() + text.size(), value);
  return {static_cast<std::size_t>(result.ptr - text.data()), result.ec, value};
}

void expectRead(const std::string& text, std::size_t length, std::errc error, double value) {
  for (const Function function : {&doubleFromChars, &doubleFromCharsByStrtod}) {
    const Read actual = read(function, text);
    EXPECT_EQ(actual.length, length) << text;
    EXPECT_EQ(actual.error, error) << text;
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(actual.value)) << text;
    } else {
      EXPECT_EQ(actual.value, value) << text;
      EXPECT_EQ(std::signbit(actual.value), std::signbit(value)) << text;
    }
  }
}

void expectNumbersAreRead() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  expectRead("1", 1, {}, 1);
  expectRead("-1.25", 5, {}, -1.25);
  expectRead("-0", 2, {}, -0.0);
  expectRead(".5", 2, {}, 0.5);
  expectRead("5.", 2, {}, 5);
  expectRead("1e+5", 4, {}, 1e5);
  expectRead("1e", 1, {}, 1);
  expectRead("1,5", 1, {}, 1);
  expectRead("1.5 2", 3, {}, 1.5);
  expectRead("4.9e-324", 8, {}, 4.9e-324);
  expectRead("1e-310", 6, {}, 1e-310);
  expectRead("1.7976931348623157e308", 22, {}, 1.7976931348623157e308);
  expectRead("0e999999", 8, {}, 0);
  expectRead("inf", 3, {}, kInfinity);
  expectRead("-infinity", 9, {}, -kInfinity);
  expectRead("nan", 3, {}, NAN);
  expectRead("0x10", 1, {}, 0);
  expectRead("-0X1p3", 2, {}, -0.0);
}

TEST(DoubleFromChars, ReadsNumbersWithAndWithoutTheStandardLibrarysFunction) { expectNumbersAreRead(); }

TEST(DoubleFromChars, RefusesWhatDoesNotBeginWithANumber) {
  for (const char* text : {"", "-", "+1", "e5", " 1", "\t1", "x", "--1", "-+1", ",5"})
    expectRead(text, 0, std::errc::invalid_argument, -7);
}

TEST(DoubleFromChars, NumbersTooLargeOrTooSmallAreOutOfRange) {
  for (const char* text : {"1e400", "-1e400", "1.7976931348623159e308", "1e-400", "2e-324", "1e-99999999999999999999"})
    expectRead(text, std::strlen(text), std::errc::result_out_of_range, -7);
}

TEST(DoubleFromChars, ReadsTheSameInALocaleWithADecimalComma) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  bool found = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"}) found = found || std::setlocale(LC_ALL, name) != nullptr;
  if (!found) GTEST_SKIP() << "no such locale is installed";
  expectNumbersAreRead();
  std::setlocale(LC_ALL, before.c_str());
}

TEST(DoubleFromChars, DigitsThatAreEnoughGiveBackTheNumber) {
  test::Random random(test::testSeed());
  for (int i = 0; i < 10000; ++i) {
    const double value = random.normal() * std::pow(10, random.uniform(-300, 300));
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    expectRead(text, std::strlen(text), {}, value);
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

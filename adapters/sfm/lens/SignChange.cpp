#include "SignChange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridgv {
namespace sfm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = 1e50;  // up to here the sixth power is finite

double evaluate(const std::vector<double>& polynomial, double s) {
  double value = 0;
  for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) value = value * s + *c;
  return value;
}

// The zero between two arguments of different sign. The middle is a geometric mean as long as the ends differ in magnitude.
double bisect(const std::vector<double>& polynomial, double low, double high) {
  constexpr int kMaxIterations = 400;
  const bool isPositive = evaluate(polynomial, low) > 0;
  for (int i = 0; i < kMaxIterations; ++i) {
    const double middle = low > 0 && high > 4 * low ? std::sqrt(low) * std::sqrt(high) : low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    ((evaluate(polynomial, middle) > 0) == isPositive ? low : high) = middle;
  }
  return high;
}

// All changes of sign in (0, kLargest], in ascending order: between two neighbours among those of the derivative there is at
// most one.
std::vector<double> signChanges(const std::vector<double>& polynomial) {
  std::vector<double> result;
  if (polynomial.size() < 2) return result;
  std::vector<double> derivative;
  for (std::size_t i = 1; i < polynomial.size(); ++i) derivative.push_back(static_cast<double>(i) * polynomial[i]);
  std::vector<double> ends = signChanges(derivative);
  ends.push_back(kLargest);
  double low = 0;
  for (const double high : ends) {
    if ((evaluate(polynomial, low) > 0) != (evaluate(polynomial, high) > 0)) result.push_back(bisect(polynomial, low, high));
    low = high;
  }
  return result;
}

}  // namespace

double firstSignChange(const std::vector<double>& coefficients) {
  const std::vector<double> all = signChanges(coefficients);
  return all.empty() ? kInfinity : all.front();
}

}  // namespace sfm
}  // namespace hybridgv

#include "RadialProfile.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "SignChange.hpp"

namespace hybridgv {
namespace sfm {
namespace {

template <class Coefficients>
double evaluate(const Coefficients& c, std::size_t degree, double s) {
  double value = c[degree];
  for (std::size_t i = degree; i > 0; --i) value = c[i - 1] + s * value;
  return value;
}

template <class Coefficients>
double evaluateSlope(const Coefficients& c, std::size_t degree, double s) {
  double value = 0;
  for (std::size_t i = degree; i > 0; --i) value = static_cast<double>(i) * c[i] + s * value;
  return value;
}

// The square root of the smallest positive zero of g'(r) = 1 + 3 k1 s + 5 k2 s^2, s = r^2; infinite if there is none.
double largestRadiusOfTwoTerms(double k1, double k2) {
  const double discriminant = 9 * k1 * k1 - 20 * k2;
  if (discriminant < 0) return RadialProfile::kInfinity;
  // The zeros are 2 / (-3 k1 -+ sqrt(discriminant)), in this form also for k2 = 0; the larger denominator gives the smaller
  // one. It is -20 k2 / (3 k1 + sqrt(discriminant)), which does not cancel for k1 > 0.
  const double root = std::sqrt(discriminant);
  const double denominator = k1 > 0 ? -20 * k2 / (3 * k1 + root) : -3 * k1 + root;
  return denominator > 0 ? std::sqrt(2 / denominator) : RadialProfile::kInfinity;
}

}  // namespace

RadialProfile::RadialProfile(std::initializer_list<double> numerator, std::initializer_list<double> denominator, double limit) {
  std::copy(numerator.begin(), numerator.end(), numerator_.begin() + 1);
  std::copy(denominator.begin(), denominator.end(), denominator_.begin() + 1);
  for (std::size_t i = 1; i < numerator_.size(); ++i)
    if (numerator_[i] != 0) numeratorDegree_ = i;
  for (std::size_t i = 1; i < denominator_.size(); ++i)
    if (denominator_[i] != 0) denominatorDegree_ = i;
  largestRadius_ = std::min(limit, findLargestRadius());
}

double RadialProfile::findLargestRadius() const {
  if (denominatorDegree_ == 0 && numeratorDegree_ <= 2) return largestRadiusOfTwoTerms(numerator_[1], numerator_[2]);
  // D^2 d(r N / D)/dr = N D + 2 s (N' D - N D') = sum (1 + 2 (i - j)) n_i d_j s^(i + j)
  std::vector<double> slope(numeratorDegree_ + denominatorDegree_ + 1, 0.0);
  for (std::size_t i = 0; i <= numeratorDegree_; ++i)
    for (std::size_t j = 0; j <= denominatorDegree_; ++j)
      slope[i + j] += (1 + 2 * (static_cast<double>(i) - static_cast<double>(j))) * numerator_[i] * denominator_[j];
  const std::vector<double> denominator(denominator_.begin(),
                                        denominator_.begin() + static_cast<std::ptrdiff_t>(denominatorDegree_) + 1);
  constexpr double kBeforePole = 1 - 1e-9;  // where the value is huge, and still positive
  return std::sqrt(std::min(firstSignChange(slope), kBeforePole * firstSignChange(denominator)));
}

double RadialProfile::factor(double s) const {
  const double numerator = evaluate(numerator_, numeratorDegree_, s);
  return denominatorDegree_ == 0 ? numerator : numerator / evaluate(denominator_, denominatorDegree_, s);
}

double RadialProfile::factorSlope(double s) const {
  const double slope = evaluateSlope(numerator_, numeratorDegree_, s);
  if (denominatorDegree_ == 0) return slope;
  const double denominator = evaluate(denominator_, denominatorDegree_, s);
  return (slope - factor(s) * evaluateSlope(denominator_, denominatorDegree_, s)) / denominator;
}

double RadialProfile::derivative(double r) const {
  const double s = r * r;
  return factor(s) + 2 * s * factorSlope(s);
}

// Newton's method, kept inside a bracket.
double RadialProfile::inverse(double value) const {
  constexpr double kTolerance = 1e-15;
  constexpr int kMaxIterations = 200;  // bisection alone needs about 60
  double low = 0, high = largestRadius_;
  if (high == kInfinity) {
    for (high = std::max(value, 1e-6); (*this)(high) < value && high < kInfinity; high *= 2) low = high;
    if (high == kInfinity) return -1;
  } else if (!((*this)(high) >= value)) {
    return -1;
  }
  double r = std::min(std::max(value, low), high);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double residual = (*this)(r)-value;
    if (std::abs(residual) <= kTolerance * value) return r;
    (residual > 0 ? high : low) = r;
    const double newton = r - residual / derivative(r);
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    if (next == r) return r;  // the bracket is down to neighbouring numbers
    r = next;
  }
  return -1;
}

}  // namespace sfm
}  // namespace hybridgv

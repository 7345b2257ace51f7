// Distortion along a ray from the principal point.
#pragma once

#include <array>
#include <initializer_list>
#include <limits>

namespace hybridgv {
namespace sfm {

// r -> r N(r^2) / D(r^2) with N(s) = 1 + n1 s + n2 s^2 + .. and D(s) = 1 + d1 s + ..: grows on [0, largestRadius()], where it is
// inverted.
class RadialProfile {
 public:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  // The identity.
  RadialProfile() = default;
  // n1, n2, .. (at most six) and d1, d2, .. (at most three). Radii above `limit` are not of interest.
  RadialProfile(std::initializer_list<double> numerator, std::initializer_list<double> denominator, double limit);

  double operator()(double r) const { return r * factor(r * r); }
  double derivative(double r) const;
  // N / D at s = r^2, and its derivative with respect to s.
  double factor(double s) const;
  double factorSlope(double s) const;
  double largestRadius() const { return largestRadius_; }
  // The radius in [0, largestRadius] that is mapped onto `value` (not negative); negative if there is none.
  double inverse(double value) const;

 private:
  double findLargestRadius() const;

  std::array<double, 7> numerator_{1};
  std::array<double, 4> denominator_{1};
  std::size_t numeratorDegree_ = 0, denominatorDegree_ = 0;
  double largestRadius_ = kInfinity;
};

}  // namespace sfm
}  // namespace hybridgv

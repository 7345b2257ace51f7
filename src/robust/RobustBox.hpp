// The size of an image region that holds most of some points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "math/nthSmallest.hpp"

namespace hybridgv {
namespace robust {

// A few points far away must not decide: it is the box that leaves out a twentieth at each side, enlarged to about the size that it would
// have for evenly spread points. That of eight or more is at most twice as large as the one of all but the outermost at each side.
class RobustBox {
 public:
  void add(double u, double v) {
    u_.push_back(u);
    v_.push_back(v);
  }
  struct Size {
    double width, height;
    double area() const { return width * height; }
    double diagonal() const { return std::hypot(width, height); }
  };
  Size size() const { return {extent(u_), extent(v_)}; }

 private:
  // Where that is several times what three quarters in the middle suggest, it is still one of the few far away.
  static double extent(std::vector<double> values) {
    constexpr double kLeftOut = 0.05, kLeftOutOfInner = 0.125, kMostOfInner = 4, kMostOfOthers = 2;
    const std::size_t count = values.size();
    const auto placesOf = [&](double share) { return static_cast<std::size_t>(share * static_cast<double>(count)); };
    double outer = extentWithout(placesOf(kLeftOut), values);
    if (placesOf(kLeftOut) == 0 && count >= 8) outer = std::min(outer, kMostOfOthers * rangeWithout(1, values));
    const double inner = extentWithout(std::min(placesOf(kLeftOutOfInner) + 1, count / 3), values);
    return inner > 0 ? std::min(outer, kMostOfInner * inner) : outer;
  }
  static double extentWithout(std::size_t atEachSide, std::vector<double>& values) {
    if (values.empty()) return 0;
    return rangeWithout(atEachSide, values) / (1 - 2 * static_cast<double>(atEachSide) / static_cast<double>(values.size()));
  }
  static double rangeWithout(std::size_t atEachSide, std::vector<double>& values) {
    const double low = math::nthSmallest(values, atEachSide), high = math::nthSmallest(values, values.size() - 1 - atEachSide);
    return high - low;
  }
  std::vector<double> u_, v_;
};

}  // namespace robust
}  // namespace hybridgv

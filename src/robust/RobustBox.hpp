// The size of an image region that holds most of some points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "math/nthSmallest.hpp"

namespace hybridgv {
namespace robust {

// A few points far away must not decide: it is the box that leaves out a twentieth at each side, but one point at least, enlarged to the size that it would
// have for evenly spread points.
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
  static double extent(std::vector<double> values) {
    if (values.empty()) return 0;
    constexpr double kLeftOut = 0.05;
    constexpr std::size_t kEnoughForOne = 8;
    const std::size_t least = values.size() < kEnoughForOne ? 0 : 1;
    const std::size_t skip = std::max(least, static_cast<std::size_t>(kLeftOut * static_cast<double>(values.size())));
    const double low = math::nthSmallest(values, skip), high = math::nthSmallest(values, values.size() - 1 - skip);
    return (high - low) / (1 - 2 * static_cast<double>(skip) / static_cast<double>(values.size()));
  }
  std::vector<double> u_, v_;
};

}  // namespace robust
}  // namespace hybridgv

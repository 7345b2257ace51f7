// The direction in which a camera of focal length 1 sees an image point.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace solvers {
namespace known_focal {

// (u, v, 1), normalized, without overflow.
inline Eigen::Vector3d bearingOf(double u, double v) {
  const double square = u * u + v * v + 1;
  if (square < 1e300) {
    const double inverse = 1 / std::sqrt(square);
    return inverse * Eigen::Vector3d(u, v, 1);
  }
  const double largest = std::max(std::abs(u), std::abs(v));
  return Eigen::Vector3d(u / largest, v / largest, 1 / largest).normalized();
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

// Distortion of a plane: radial, tangential and thin-prism terms together.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "RadialProfile.hpp"

namespace hybridgv {
namespace sfm {

// With s = x^2 + y^2 and the radial factor g(s):
//
//     d(x, y) = g (x, y) + (2 p1 x y + p2 (s + 2 x^2) + sx1 s + sx2 s^2,  2 p2 x y + p1 (s + 2 y^2) + sy1 s + sy2 s^2)
//
// It is inverted on its unfolded part: the points within the radial profile's largest radius such that on the way to them from
// the axis the image never turns back (the determinant of the Jacobian stays positive).
struct PlaneDistortion {
  RadialProfile radial;
  double p1 = 0, p2 = 0, sx1 = 0, sx2 = 0, sy1 = 0, sy2 = 0;

  bool isRadial() const { return p1 == 0 && p2 == 0 && sx1 == 0 && sx2 == 0 && sy1 == 0 && sy2 == 0; }
  // Empty outside the unfolded part.
  std::optional<Eigen::Vector2d> apply(const Eigen::Vector2d& point) const;
  // The point of the unfolded part that `apply` maps onto `image`; empty if there is none.
  std::optional<Eigen::Vector2d> invert(const Eigen::Vector2d& image) const;

 private:
  Eigen::Vector2d evaluate(const Eigen::Vector2d& point) const;
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& point) const;
  bool isUnfolded(const Eigen::Vector2d& point) const;
};

}  // namespace sfm
}  // namespace hybridgv

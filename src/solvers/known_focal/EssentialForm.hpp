// The essential matrices in a four-dimensional space of matrices, as the roots of one binary form.
#pragma once

#include "math/simd/Lanes.hpp"
#include "solvers/NullSpace.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

// E = x B0 + y B1 + z B2 + w B3 is essential where (E E^T - tr(E E^T)/2 I) E = 0 and det E = 0: ten cubics. Linear combinations of
// them express each of the monomials xxz, xxw, xyz, xyw, yyz, yyw by such as are at most linear in x and y. From
// w <xxz> - z <xxw> = 0, and the same for xy and yy, follow three equations x a(z,w) + y b(z,w) + c(z,w) = 0, with forms of degree 3,
// 3 and 4. Their determinant is the form of degree 10 in (z : w).
class EssentialForm {
 public:
  static constexpr int kDegree = 10;

  // False if a pivot vanishes. `basis`: four matrices.
  bool set(const PaddedMatrix* basis);
  // The smallest pivot: where it is small, the form has lost digits.
  double leastPivot() const { return leastPivot_; }

  // The form, at two directions.
  math::Pair value(const math::Pair& z, const math::Pair& w) const;
  // (x, y, z, w) of a root (z : w).
  void coordinates(double z, double w, double (&result)[4]) const;

 private:
  struct Equation {
    double a[4], b[4], c[5];  // coefficients of zzz, zzw, zww, www and of z^4 .. w^4
  };
  template <class T>
  struct Row {
    T a, b, c;
  };
  template <class T>
  Row<T> row(int i, const T& z, const T& w) const;

  Equation equations_[3];
  double leastPivot_;
};

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

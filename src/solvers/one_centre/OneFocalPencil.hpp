// The three-parameter family of fundamental matrices that six correspondences leave, F = x B0 + y B1 + w B2, in the coordinates
// in which its common zeros of det F and Q are found; see OneFocalFundamental.hpp. Formulas are templates over a double or a pair
// of them, for two directions at once.
#pragma once

#include <cmath>

#include "math/Vec3.hpp"
#include "math/roots/BinaryFormRoots.hpp"
#include "solvers/one_centre/OneFocalFundamental.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

// A 3x3 matrix by its rows.
template <class T>
struct Rows {
  math::Vec3<T> f1, f2, f3;
};

template <class A, class B>
auto operator+(const Rows<A>& a, const Rows<B>& b) -> Rows<decltype(a.f1.x + b.f1.x)> {
  return {a.f1 + b.f1, a.f2 + b.f2, a.f3 + b.f3};
}
template <class A, class B>
auto operator*(const A& a, const Rows<B>& b) -> Rows<decltype(a * b.f1.x)> {
  return {a * b.f1, a * b.f2, a * b.f3};
}
template <class A, class B>
auto dot(const Rows<A>& a, const Rows<B>& b) -> decltype(a.f1.x * b.f1.x) {
  return dot(a.f1, b.f1) + dot(a.f2, b.f2) + dot(a.f3, b.f3);
}
// cof(A), the gradient of the determinant.
template <class T>
Rows<T> cofactors(const Rows<T>& a) {
  return {cross(a.f2, a.f3), cross(a.f3, a.f1), cross(a.f1, a.f2)};
}

// The longest of three (nearly) parallel vectors.
inline const math::Vec3<double>& longest(const math::Vec3<double>& a, const math::Vec3<double>& b, const math::Vec3<double>& c) {
  const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
  if (aa > bb) return aa > cc ? a : c;
  return bb > cc ? b : c;
}

class OneFocalPencil {
 public:
  // False if the six constraints are dependent or every matrix of the pencil is singular.
  bool build(const SixCorrespondences& correspondences);

  // The columns of M(c, s):  Q = x^2 r2 + x r1 + r0 modulo det F.
  template <class T>
  struct Quadratics {
    math::Vec3<T> r2, r1, r0;
  };
  template <class T>
  Quadratics<T> quadratics(T c, T s) const;

  // det M(c, s), a form of degree 9.
  template <class T>
  T form(T c, T s) const {
    const Quadratics<T> m = quadratics(c, s);
    return dot(m.r2, cross(m.r1, m.r0));
  }

  // F at (x, c, s), its derivatives with respect to x and to psi, (c, s) = (cos psi, sin psi).
  template <class T>
  Rows<T> at(T x, T c, T s) const {
    return x * b_ + c * y_ + s * w_;
  }
  const Rows<double>& derivativeX() const { return b_; }
  template <class T>
  Rows<T> derivativePsi(T c, T s) const {
    return c * w_ + (-s) * y_;
  }

  // The direction (c : s) of the matrix whose third row is 0, if there is one.
  math::Direction withoutThirdRow() const;

 private:
  Rows<double> b_, y_, w_;           // B0, B1, B2
  math::Vec3<double> v2_, w2_, q4_;  // b1 x b3, b2 x b3, Q(B0)
  double d2_, e2_;                   // b1.b3, b2.b3
  double inverseDeterminant_;        // 1 / det B0
};

template <class T>
OneFocalPencil::Quadratics<T> OneFocalPencil::quadratics(T c, T s) const {
  using math::Vec3;
  // F = x B0 + G. The coefficients of f1.f3 (d), f2.f3 (e), f1 x f3 (v), f2 x f3 (w) in x; the leading ones are constant.
  const Rows<T> g = c * y_ + s * w_;
  const T d1 = dot(b_.f1, g.f3) + dot(b_.f3, g.f1), d0 = dot(g.f1, g.f3);
  const T e1 = dot(b_.f2, g.f3) + dot(b_.f3, g.f2), e0 = dot(g.f2, g.f3);
  const Vec3<T> v1 = cross(b_.f1, g.f3) + cross(g.f1, b_.f3), v0 = cross(g.f1, g.f3);
  const Vec3<T> w1 = cross(b_.f2, g.f3) + cross(g.f2, b_.f3), w0 = cross(g.f2, g.f3);
  // Q = d v + e w = x^4 q4 + .. + q0
  const Vec3<T> q3 = d2_ * v1 + d1 * v2_ + (e2_ * w1 + e1 * w2_);
  const Vec3<T> q2 = d2_ * v0 + d1 * v1 + d0 * v2_ + (e2_ * w0 + e1 * w1 + e0 * w2_);
  const Vec3<T> q1 = d1 * v0 + d0 * v1 + (e1 * w0 + e0 * w1);
  const Vec3<T> q0 = d0 * v0 + e0 * w0;
  // det F / det B0 = f1.(f2 x f3) / det B0 = x^3 + k2 x^2 + k1 x + k0
  const T k2 = inverseDeterminant_ * (dot(b_.f1, w1) + dot(g.f1, w2_));
  const T k1 = inverseDeterminant_ * (dot(b_.f1, w0) + dot(g.f1, w1));
  const T k0 = inverseDeterminant_ * dot(g.f1, w0);
  // x^3 = -k2 x^2 - k1 x - k0,  x^4 = (k2^2 - k1) x^2 + (k2 k1 - k0) x + k2 k0
  return {q2 - k2 * q3 + (k2 * k2 - k1) * q4_, q1 - k1 * q3 + (k2 * k1 - k0) * q4_, q0 - k0 * q3 + (k2 * k0) * q4_};
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv

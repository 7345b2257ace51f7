// The quadratic forms through which a direction or a moment w enters the equations, and how they depend on the homotopy parameter.
//
// Let z = f (r1 + i r2), n = r3 be made of the rows of the query's rotation. z, its conjugate zb and n are isotropic and
// orthogonal, so
//
//   n = n0/(1+xy), n0 = (x+y, -i(x-y), 1-xy),   z = z0/(beta (1+xy)), z0  = (1-x^2,  i(1+x^2), -2x),
//                                               zb = z0b/(alpha (1+xy)), z0b = (1-y^2, -i(1+y^2), -2y),   f^2 = 1/(alpha beta)
//
// where y = conj x, alpha = conj beta for a real camera. With w+ = w1 + i w2, w- = w1 - i w2:
//
//   u(w) = z0.w  = w+ - 2 x w3 - x^2 w-,
//   v(w) = z0b.w = w- - 2 y w3 - y^2 w+,
//   s(w) = n0.w  = w3 + x w- + y w+ - x y w3.
//
// Compiled once per instruction set, see math/simd/Lanes.hpp.
#pragma once

#include "math/homotopy/PathSolver.hpp"
#include "solvers/complex_rays/ComplexRays.hpp"

namespace hybridgv {
namespace solvers {
namespace complex_rays {
inline namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;

// Values and derivatives of the coefficients at t.
template <class V, int Degree>
HYBRIDGV_INLINE Complex<V> valueAt(const Polynomial<Real<V>, Degree>& p, V t) {
  V re = t * p.re[Degree] + p.re[Degree - 1], im = t * p.im[Degree] + p.im[Degree - 1];
  for (int k = Degree - 2; k >= 0; --k) {
    re = re * t + p.re[k];
    im = im * t + p.im[k];
  }
  return {re, im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> derivativeAt(const Polynomial<Real<V>, 2>& p, V t) {
  const V twiceT = t + t;
  return {twiceT * p.re[2] + p.re[1], twiceT * p.im[2] + p.im[1]};
}
template <class V>
HYBRIDGV_INLINE Complex<V> slope(const Polynomial<Real<V>, 1>& p) {
  return {broadcast<V>(p.re[1]), broadcast<V>(p.im[1])};
}

template <class V>
struct ComplexVector {
  Complex<V> plus, minus, third;
};
template <class V>
HYBRIDGV_INLINE ComplexVector<V> valueAt(const VectorHomotopy<Real<V>>& w, V t) {
  return {valueAt(w.plus, t), valueAt(w.minus, t), valueAt(w.third, t)};
}
template <class V>
HYBRIDGV_INLINE ComplexVector<V> slope(const VectorHomotopy<Real<V>>& w) {
  return {slope<V>(w.plus), slope<V>(w.minus), slope<V>(w.third)};
}

// The forms of w at (x, y), and their derivatives: u_x = -2 minusHalfUx, v_y = -2 minusHalfVy.
template <class V>
struct Forms {
  Complex<V> minusHalfUx, u, minusHalfVy, v, sx, sy;

  HYBRIDGV_INLINE Forms(const ComplexVector<V>& w, const Complex<V>& x, const Complex<V>& y)
      : minusHalfUx(addProduct(w.third, x, w.minus)),
        u(subtractProduct(w.plus, x, w.third + minusHalfUx)),
        minusHalfVy(addProduct(w.third, y, w.plus)),
        v(subtractProduct(w.minus, y, w.third + minusHalfVy)),
        sx(subtractProduct(w.minus, y, w.third)),
        sy(subtractProduct(w.plus, x, w.third)) {}

  HYBRIDGV_INLINE Complex<V> s(const Complex<V>& y) const { return addProduct(minusHalfUx, y, sy); }
};

inline VectorHomotopy<float> narrowed(const VectorHomotopy<double>& vector) {
  return {narrowed(vector.plus), narrowed(vector.minus), narrowed(vector.third)};
}
inline void narrow(const RayHomotopy<double>& from, RayHomotopy<float>* to) {
  to->direction = narrowed(from.direction);
  to->moment = narrowed(from.moment);
  to->image = narrowed(from.image);
  to->imageBar = narrowed(from.imageBar);
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace complex_rays
}  // namespace solvers
}  // namespace hybridgv

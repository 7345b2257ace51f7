// The equations of H51f, their derivatives, and how they depend on the homotopy parameter t.
//
// Let z = f (r1 + i r2), n = r3 be made of the rows of the query's rotation, the origin of the rig be the 3D point, d its depth,
// pi0 = u0 + i v0 its image and pib0 the conjugate. z, its conjugate zb and n are isotropic and orthogonal, so
//
//   n = n0/(1+xy), n0 = (x+y, -i(x-y), 1-xy),   z = z0/(beta (1+xy)),  z0  = (1-x^2,  i(1+x^2), -2x),
//                                               zb = z0b/(alpha (1+xy)), z0b = (1-y^2, -i(1+y^2), -2y),   f^2 = 1/(alpha beta)
//
// where y = conj x, alpha = conj beta for a real camera. A ray of direction q and moment m = q x c that is seen at pi gives
//
//   2 s(m) + alpha pib u(m) + beta pi v(m) + i alpha d (pib0-pib) u(q) - i beta d (pi0-pi) v(q)
//          + i alpha beta d (pib pi0 - pi pib0) s(q) = 0,
//   u(w) = z0.w = w+ - 2 x w3 - x^2 w-,  v(w) = z0b.w = w- - 2 y w3 - y^2 w+,  s(w) = n0.w = w3 + x w- + y w+ - x y w3,  w+- = w1
//   +- i w2.
//
// Five rays, five unknowns x, y, alpha, beta, d. All data are interpolated linearly in t, from complex start to real target.
#pragma once

#include "math/homotopy/PathTracker.hpp"
#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace HYBRIDGV_INSTRUCTION_SET {

// Values and derivatives of the coefficients at t.
template <class V, int Degree>
HYBRIDGV_INLINE Complex<V> valueAt(const math::Polynomial<Real<V>, Degree>& p, V t) {
  V re = t * p.re[Degree] + p.re[Degree - 1], im = t * p.im[Degree] + p.im[Degree - 1];
  for (int k = Degree - 2; k >= 0; --k) re = re * t + p.re[k], im = im * t + p.im[k];
  return {re, im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> derivativeAt(const math::Polynomial<Real<V>, 2>& p, V t) {
  const V twiceT = t + t;
  return {twiceT * p.re[2] + p.re[1], twiceT * p.im[2] + p.im[1]};
}
template <class V>
HYBRIDGV_INLINE Complex<V> derivativeAt(const math::Polynomial<Real<V>, 1>& p, V) {
  return {broadcast<V>(p.re[1]), broadcast<V>(p.im[1])};
}

struct H51fSystem {
  static constexpr int kUnknowns = h51f::kUnknowns, kAbsolute = 2;
  enum Unknown { X, Y, Alpha, Beta, D, F, Ft };

  template <class Scalar>
  using Coefficients = h51f::SystemPath<Scalar>;

  // u(w), v(w), s(w) and their derivatives u_x = -2(w3 + x w-), v_y = -2(w3 + y w+), s_x = w- - y w3, s_y = w+ - x w3
  template <class V>
  struct Forms {
    Complex<V> u, v, s, ux, vy, sx, sy;
  };

  template <class V>
  static HYBRIDGV_INLINE Forms<V> forms(const Complex<V>& plus, const Complex<V>& minus, const Complex<V>& third,
                                        const Complex<V>& x, const Complex<V>& y) {
    const Complex<V> a = third + x * minus, c = third + y * plus;
    Forms<V> f;
    f.sx = minus - y * third, f.sy = plus - x * third;
    f.u = plus - x * (third + a), f.v = minus - y * (third + c), f.s = a + y * f.sy;
    f.ux = -twice(a), f.vy = -twice(c);
    return f;
  }

  template <bool derivative, class V>
  static HYBRIDGV_INLINE void evaluate(const Coefficients<Real<V>>& coefficients, V t, const Complex<V> (&x)[kUnknowns],
                                       Complex<V> (&rows)[kUnknowns][kUnknowns + 1 + derivative]) {
    const Complex<V> image0 = valueAt(coefficients.pointImage, t), imageBar0 = valueAt(coefficients.pointImageBar, t);
    const Complex<V> iAlphaD = timesI(x[Alpha] * x[D]), iBetaD = timesI(x[Beta] * x[D]), iAlphaBetaD = iAlphaD * x[Beta];
    for (int j = 0; j < h51f::kRays; ++j) {
      const h51f::RayPath<Real<V>>& ray = coefficients.ray[j];
      const Complex<V> image = valueAt(ray.image, t), imageBar = valueAt(ray.imageBar, t);
      const Forms<V> m =
          forms(valueAt(ray.moment.plus, t), valueAt(ray.moment.minus, t), valueAt(ray.moment.third, t), x[X], x[Y]);
      const Forms<V> q =
          forms(valueAt(ray.direction.plus, t), valueAt(ray.direction.minus, t), valueAt(ray.direction.third, t), x[X], x[Y]);
      // the coefficients of u(m), v(m), u(q), v(q), s(q)
      const Complex<V> kum = x[Alpha] * imageBar, kvm = x[Beta] * image, kuq = iAlphaD * (imageBar0 - imageBar),
                       kvq = iBetaD * (image - image0), ksq = iAlphaBetaD * valueAt(ray.cross, t);
      const Complex<V> um = kum * m.u, vm = kvm * m.v, uq = kuq * q.u, vq = kvq * q.v, sq = ksq * q.s;
      Complex<V>(&row)[kUnknowns + 1 + derivative] = rows[j];
      row[X] = twice(m.sx) + kum * m.ux + kuq * q.ux + ksq * q.sx;
      row[Y] = twice(m.sy) + kvm * m.vy + kvq * q.vy + ksq * q.sy;
      row[Alpha] = um + uq + sq;
      row[Beta] = vm + vq + sq;
      row[D] = uq + vq + sq;
      row[F] = twice(m.s) + um + vm + row[D];
      if constexpr (derivative) {
        const Forms<V> dm = forms(derivativeAt(ray.moment.plus, t), derivativeAt(ray.moment.minus, t),
                                  derivativeAt(ray.moment.third, t), x[X], x[Y]);
        const Forms<V> dq = forms(derivativeAt(ray.direction.plus, t), derivativeAt(ray.direction.minus, t),
                                  derivativeAt(ray.direction.third, t), x[X], x[Y]);
        const Complex<V> dImage = derivativeAt(ray.image, t), dImageBar = derivativeAt(ray.imageBar, t);
        const Complex<V> dImage0 = derivativeAt(coefficients.pointImage, t),
                         dImageBar0 = derivativeAt(coefficients.pointImageBar, t);
        row[Ft] = twice(dm.s) + kum * dm.u + kvm * dm.v + kuq * dq.u + kvq * dq.v + ksq * dq.s + x[Alpha] * (dImageBar * m.u) +
                  x[Beta] * (dImage * m.v) + iAlphaD * ((dImageBar0 - dImageBar) * q.u) + iBetaD * ((dImage - dImage0) * q.v) +
                  iAlphaBetaD * (derivativeAt(ray.cross, t) * q.s);
      }
    }
  }
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace hybridgv

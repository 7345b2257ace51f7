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
//   u(w) = z0.w  = w+ - 2 x w3 - x^2 w-,
//   v(w) = z0b.w = w- - 2 y w3 - y^2 w+,
//   s(w) = n0.w  = w3 + x w- + y w+ - x y w3,   w+ = w1 + i w2,   w- = w1 - i w2.
//
// Five rays, five unknowns x, y, alpha, beta, d. All data are interpolated linearly in t, from complex start to real target.
#pragma once

#include "math/homotopy/PathTracker.hpp"
#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {
namespace HYBRIDGV_INSTRUCTION_SET {

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
HYBRIDGV_INLINE Complex<V> derivativeAt(const Polynomial<Real<V>, 1>& p, V) {
  return {broadcast<V>(p.re[1]), broadcast<V>(p.im[1])};
}

struct H51fSystem {
  static constexpr int kUnknowns = h51f::kUnknowns, kAbsolute = 2, kRays = h51f::kRays;
  enum Unknown { X, Y, Alpha, Beta, D, F, Ft };

  template <class Scalar>
  using Homotopy = h51f::Homotopy<Scalar>;
  template <class Scalar>
  using VectorHomotopy = h51f::VectorHomotopy<Scalar>;

  // The data of the equations at some t.
  template <class V>
  struct Vector {
    Complex<V> plus, minus, third;
  };
  template <class V>
  struct Ray {
    Vector<V> direction, moment;
    Complex<V> image, imageBar, dImage, dImageBar, cross;  // pi, pib, pi - pi0, pib0 - pib, pib pi0 - pi pib0
  };
  template <class V>
  struct Data {
    Ray<V> ray[kRays];
  };

  template <class V>
  static HYBRIDGV_INLINE Vector<V> vectorAt(const VectorHomotopy<Real<V>>& w, V t) {
    return {valueAt(w.plus, t), valueAt(w.minus, t), valueAt(w.third, t)};
  }
  template <class V>
  static HYBRIDGV_INLINE void dataAt(const Homotopy<Real<V>>& homotopy, V t, Data<V>& data) {
    const Complex<V> pointImage = valueAt(homotopy.pointImage, t), pointImageBar = valueAt(homotopy.pointImageBar, t);
    for (int j = 0; j < kRays; ++j) {
      const RayHomotopy<Real<V>>& from = homotopy.ray[j];
      Ray<V>& to = data.ray[j];
      to.direction = vectorAt(from.direction, t);
      to.moment = vectorAt(from.moment, t);
      to.image = valueAt(from.image, t);
      to.imageBar = valueAt(from.imageBar, t);
      to.dImage = to.image - pointImage;
      to.dImageBar = pointImageBar - to.imageBar;
      to.cross = valueAt(from.cross, t);
    }
  }

  // [dF/dx | F], and dF/dt if derivative is true; the equations are divided by 2.
  template <bool derivative, class V>
  static HYBRIDGV_INLINE void evaluate(const Homotopy<Real<V>>& homotopy, V t, const Data<V>& data,
                                       const Complex<V> (&z)[kUnknowns],
                                       Complex<V> (&rows)[kUnknowns][kUnknowns + 1 + derivative]) {
    const V half = broadcast<V>(Real<V>(0.5));
    const Complex<V> x = z[X], y = z[Y], alpha = half * z[Alpha], beta = half * z[Beta];
    const Complex<V> iAlphaD = timesI(alpha * z[D]), iBetaD = timesI(beta * z[D]), iAlphaBetaD = iAlphaD * z[Beta];
    for (int j = 0; j < kRays; ++j) {
      Complex<V>(&row)[kUnknowns + 1 + derivative] = rows[j];
      const Ray<V>& ray = data.ray[j];
      Complex<V> dx, dy, value, dt;
      // 2 s(m) + alpha pib u(m) + beta pi v(m)
      {
        const Vector<V>& m = ray.moment;
        const Complex<V> ku = alpha * ray.imageBar, kv = beta * ray.image;
        const Complex<V> a = addProduct(m.third, x, m.minus), u = subtractProduct(m.plus, x, m.third + a);
        const Complex<V> c = addProduct(m.third, y, m.plus), v = subtractProduct(m.minus, y, m.third + c);
        const Complex<V> sx = subtractProduct(m.minus, y, m.third), sy = subtractProduct(m.plus, x, m.third);
        dx = subtractProduct(sx, twice(ku), a);
        dy = subtractProduct(sy, twice(kv), c);
        row[Alpha] = ku * u;
        row[Beta] = kv * v;
        value = addProduct(a, y, sy) + row[Alpha] + row[Beta];
        if constexpr (derivative) {
          dt = addProduct(addLinear(homotopy.ray[j].moment, x, y, ku, kv), alpha * slope<V>(homotopy.ray[j].imageBar), u);
          dt = addProduct(dt, beta * slope<V>(homotopy.ray[j].image), v);
        }
      }
      // i alpha d (pib0 - pib) u(q) - i beta d (pi0 - pi) v(q) + i alpha beta d (pib pi0 - pi pib0) s(q)
      {
        const Vector<V>& q = ray.direction;
        const Complex<V> ku = iAlphaD * ray.dImageBar, kv = iBetaD * ray.dImage, ks = iAlphaBetaD * ray.cross;
        const Complex<V> a = addProduct(q.third, x, q.minus), u = subtractProduct(q.plus, x, q.third + a);
        const Complex<V> c = addProduct(q.third, y, q.plus), v = subtractProduct(q.minus, y, q.third + c);
        const Complex<V> sx = subtractProduct(q.minus, y, q.third), sy = subtractProduct(q.plus, x, q.third);
        const Complex<V> s = addProduct(a, y, sy);
        row[X] = addProduct(subtractProduct(dx, twice(ku), a), ks, sx);
        row[Y] = addProduct(subtractProduct(dy, twice(kv), c), ks, sy);
        const Complex<V> tu = ku * u, tv = kv * v, ts = ks * s, tus = tu + ts;
        row[Alpha] = row[Alpha] + tus;
        row[Beta] = row[Beta] + tv + ts;
        row[D] = tus + tv;
        row[F] = value + row[D];
        if constexpr (derivative) {
          const Vector<V> slopes = slope<V>(homotopy.ray[j].direction);
          const Complex<V> slopeA = addProduct(slopes.third, x, slopes.minus);
          dt = addProduct(dt, ku, subtractProduct(slopes.plus, x, slopes.third + slopeA));
          dt = addProduct(dt, kv, subtractProduct(slopes.minus, y, slopes.third + addProduct(slopes.third, y, slopes.plus)));
          dt = addProduct(dt, ks, addProduct(slopeA, y, subtractProduct(slopes.plus, x, slopes.third)));
          dt = addProduct(dt, iAlphaD * (slope<V>(homotopy.pointImageBar) - slope<V>(homotopy.ray[j].imageBar)), u);
          dt = addProduct(dt, iBetaD * (slope<V>(homotopy.ray[j].image) - slope<V>(homotopy.pointImage)), v);
          row[Ft] = addProduct(dt, iAlphaBetaD * derivativeAt(homotopy.ray[j].cross, t), s);
        }
      }
    }
  }

  // s(w') + ku u(w') + kv v(w') for the slope w' of w
  template <class V>
  static HYBRIDGV_INLINE Complex<V> addLinear(const VectorHomotopy<Real<V>>& w, const Complex<V>& x, const Complex<V>& y,
                                              const Complex<V>& ku, const Complex<V>& kv) {
    const Vector<V> slopes = slope<V>(w);
    const Complex<V> a = addProduct(slopes.third, x, slopes.minus), c = addProduct(slopes.third, y, slopes.plus);
    Complex<V> sum = addProduct(a, y, subtractProduct(slopes.plus, x, slopes.third));
    sum = addProduct(sum, ku, subtractProduct(slopes.plus, x, slopes.third + a));
    return addProduct(sum, kv, subtractProduct(slopes.minus, y, slopes.third + c));
  }

  template <class V>
  static HYBRIDGV_INLINE Complex<V> slope(const Polynomial<Real<V>, 1>& p) {
    return {broadcast<V>(p.re[1]), broadcast<V>(p.im[1])};
  }
  template <class V>
  static HYBRIDGV_INLINE Vector<V> slope(const VectorHomotopy<Real<V>>& w) {
    return {slope<V>(w.plus), slope<V>(w.minus), slope<V>(w.third)};
  }
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

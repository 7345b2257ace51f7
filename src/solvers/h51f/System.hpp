// The equations of H51f, their derivatives, and how they depend on the homotopy parameter t.
//
// With the unknowns and forms of complex_rays/Forms.hpp, the origin of the rig at the 3D point, d its depth, pi0 = u0 + i v0 its
// image and pib0 the conjugate, a ray of direction q and moment m = q x c that is seen at pi gives
//
//   2 s(m) + alpha pib u(m) + beta pi v(m) + i alpha d (pib0-pib) u(q) - i beta d (pi0-pi) v(q)
//          + i alpha beta d (pib pi0 - pi pib0) s(q) = 0.
//
// Five rays, five unknowns x, y, alpha, beta, d. All data are interpolated linearly in t, from complex start to real target.
#pragma once

#include "solvers/complex_rays/Forms.hpp"
#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;
using namespace complex_rays;

struct H51fSystem {
  static constexpr int kUnknowns = h51f::kUnknowns, kAbsolute = 2, kRays = h51f::kRays;
  enum Unknown { X, Y, Alpha, Beta, D, F, Ft };

  template <class Scalar>
  using Homotopy = h51f::Homotopy<Scalar>;
  // The data of the equations at some t.
  template <class V>
  struct Ray {
    ComplexVector<V> direction, moment;
    Complex<V> image, imageBar, dImage, dImageBar, cross;  // pi, pib, pi - pi0, pib0 - pib, pib pi0 - pi pib0
  };
  template <class V>
  struct Data {
    Ray<V> ray[kRays];
  };

  template <class V>
  static HYBRIDGV_INLINE void dataAt(const Homotopy<Real<V>>& homotopy, V t, Data<V>& data) {
    const Complex<V> pointImage = valueAt(homotopy.pointImage, t), pointImageBar = valueAt(homotopy.pointImageBar, t);
    for (int j = 0; j < kRays; ++j) {
      const RayHomotopy<Real<V>>& from = homotopy.ray[j];
      Ray<V>& to = data.ray[j];
      to.direction = valueAt(from.direction, t);
      to.moment = valueAt(from.moment, t);
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
        const Forms<V> m(ray.moment, x, y);
        const Complex<V> ku = alpha * ray.imageBar, kv = beta * ray.image;
        dx = subtractProduct(m.sx, twice(ku), m.minusHalfUx);
        dy = subtractProduct(m.sy, twice(kv), m.minusHalfVy);
        row[Alpha] = ku * m.u;
        row[Beta] = kv * m.v;
        value = m.s(y) + row[Alpha] + row[Beta];
        if constexpr (derivative) {
          dt = addProduct(addLinear(homotopy.ray[j].moment, x, y, ku, kv), alpha * slope<V>(homotopy.ray[j].imageBar), m.u);
          dt = addProduct(dt, beta * slope<V>(homotopy.ray[j].image), m.v);
        }
      }
      // i alpha d (pib0 - pib) u(q) - i beta d (pi0 - pi) v(q) + i alpha beta d (pib pi0 - pi pib0) s(q)
      {
        const Forms<V> q(ray.direction, x, y);
        const Complex<V> ku = iAlphaD * ray.dImageBar, kv = iBetaD * ray.dImage, ks = iAlphaBetaD * ray.cross;
        const Complex<V> s = q.s(y);
        row[X] = addProduct(subtractProduct(dx, twice(ku), q.minusHalfUx), ks, q.sx);
        row[Y] = addProduct(subtractProduct(dy, twice(kv), q.minusHalfVy), ks, q.sy);
        const Complex<V> tu = ku * q.u, tv = kv * q.v, ts = ks * s, tus = tu + ts;
        row[Alpha] = row[Alpha] + tus;
        row[Beta] = row[Beta] + tv + ts;
        row[D] = tus + tv;
        row[F] = value + row[D];
        if constexpr (derivative) {
          const Forms<V> slopes(slope<V>(homotopy.ray[j].direction), x, y);
          dt = addProduct(dt, ku, slopes.u);
          dt = addProduct(dt, kv, slopes.v);
          dt = addProduct(dt, ks, slopes.s(y));
          dt = addProduct(dt, iAlphaD * (slope<V>(homotopy.pointImageBar) - slope<V>(homotopy.ray[j].imageBar)), q.u);
          dt = addProduct(dt, iBetaD * (slope<V>(homotopy.ray[j].image) - slope<V>(homotopy.pointImage)), q.v);
          row[Ft] = addProduct(dt, iAlphaBetaD * derivativeAt(homotopy.ray[j].cross, t), s);
        }
      }
    }
  }

  // s(w') + ku u(w') + kv v(w') for the slope w' of w
  template <class V>
  static HYBRIDGV_INLINE Complex<V> addLinear(const VectorHomotopy<Real<V>>& w, const Complex<V>& x, const Complex<V>& y,
                                              const Complex<V>& ku, const Complex<V>& kv) {
    const Forms<V> slopes(slope<V>(w), x, y);
    return addProduct(addProduct(slopes.s(y), ku, slopes.u), kv, slopes.v);
  }
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

// The equations of H70f, their derivatives, and how they depend on the homotopy parameter t.
//
// With the unknowns and forms of complex_rays/Forms.hpp and the translation X_query = R X + t, scaled as
//
//   tau = (t1 + i t2)/(f alpha),   taub = (t1 - i t2)/(f beta),   t3,
//
// a ray of direction q and moment m that is seen at pi gives, A = alpha pib, B = beta pi,
//
//   2 s(m) + A u(m) + B v(m) + i taub (u(q) - B s(q)) - i tau (v(q) - A s(q)) - i t3 (A u(q) - B v(q)) = 0.
//
// Seven rays, seven unknowns x, y, taub, tau, t3, alpha, beta. All data are interpolated linearly in t, from complex start to real
// target.
#pragma once

#include "solvers/complex_rays/Forms.hpp"
#include "solvers/h70f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;
using namespace complex_rays;

struct H70fSystem {
  static constexpr int kUnknowns = h70f::kUnknowns, kAbsolute = 5, kRays = h70f::kRays;
  enum Unknown { X, Y, TauBar, Tau, T3, Alpha, Beta, F, Ft };

  template <class Scalar>
  using Homotopy = h70f::Homotopy<Scalar>;

  // The data of the equations at some t.
  template <class V>
  struct Ray {
    ComplexVector<V> direction, moment;
    Complex<V> image, imageBar;
  };
  template <class V>
  struct Data {
    Ray<V> ray[kRays];
  };

  template <class V>
  static HYBRIDGV_INLINE void dataAt(const Homotopy<Real<V>>& homotopy, V t, Data<V>& data) {
    for (int j = 0; j < kRays; ++j) {
      const complex_rays::RayHomotopy<Real<V>>& from = homotopy.ray[j];
      data.ray[j] = {valueAt(from.direction, t), valueAt(from.moment, t), valueAt(from.image, t), valueAt(from.imageBar, t)};
    }
  }

  // [dF/dx | F], and dF/dt if derivative is true; the equations are divided by 2.
  template <bool derivative, class V>
  static HYBRIDGV_INLINE void evaluate(const Homotopy<Real<V>>& homotopy, V, const Data<V>& data,
                                       const Complex<V> (&z)[kUnknowns],
                                       Complex<V> (&rows)[kUnknowns][kUnknowns + 1 + derivative]) {
    const V half = broadcast<V>(Real<V>(0.5));
    const Complex<V> x = z[X], y = z[Y], alpha = half * z[Alpha], beta = half * z[Beta];
    const Complex<V> iTau = timesI(z[Tau]), iTauBar = timesI(z[TauBar]), iT3 = timesI(z[T3]);
    const Complex<V> halfITau = half * iTau, halfITauBar = half * iTauBar;
    for (int j = 0; j < kRays; ++j) {
      Complex<V>(&row)[kUnknowns + 1 + derivative] = rows[j];
      const Ray<V>& ray = data.ray[j];
      const Forms<V> m(ray.moment, x, y), q(ray.direction, x, y);
      const Complex<V> a = alpha * ray.imageBar, b = beta * ray.image;  // A/2, B/2
      const Complex<V> s = q.s(y);
      // The factors of u(q), v(q) and s(q).
      const Complex<V> ku = subtractProduct(halfITauBar, iT3, a), kv = iT3 * b - halfITau;
      const Complex<V> ks = subtractProduct(iTau * a, iTauBar, b);
      // What A/2 and B/2 are multiplied by.
      const Complex<V> ofA = subtractProduct(addProduct(m.u, iTau, s), iT3, q.u);
      const Complex<V> ofB = addProduct(subtractProduct(m.v, iTauBar, s), iT3, q.v);
      row[X] = addProduct(subtractProduct(subtractProduct(m.sx, twice(a), m.minusHalfUx), twice(ku), q.minusHalfUx), ks, q.sx);
      row[Y] = addProduct(subtractProduct(subtractProduct(m.sy, twice(b), m.minusHalfVy), twice(kv), q.minusHalfVy), ks, q.sy);
      row[TauBar] = timesI(subtractProduct(half * q.u, b, s));
      row[Tau] = timesI(a * s - half * q.v);
      row[T3] = timesI(subtractProduct(b * q.v, a, q.u));
      row[Alpha] = a * ofA;
      row[Beta] = b * ofB;
      row[F] = m.s(y) + row[Alpha] + row[Beta] + subtractProduct(halfITauBar * q.u, halfITau, q.v);
      if constexpr (derivative) {
        const complex_rays::RayHomotopy<Real<V>>& way = homotopy.ray[j];
        const Forms<V> dm(slope<V>(way.moment), x, y), dq(slope<V>(way.direction), x, y);
        Complex<V> dt = addProduct(addProduct(dm.s(y), a, dm.u), b, dm.v);
        dt = addProduct(addProduct(addProduct(dt, ku, dq.u), kv, dq.v), ks, dq.s(y));
        dt = addProduct(dt, alpha * slope<V>(way.imageBar), ofA);
        row[Ft] = addProduct(dt, beta * slope<V>(way.image), ofB);
      }
    }
  }
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv

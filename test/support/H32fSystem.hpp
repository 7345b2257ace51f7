// The equations of H32f as a system for the path tracker, in the unknowns x, y, d of H51f's (solvers/h51f/System.hpp).
//
// Origin of the rig's frame at the first point, the second one at (0, 0, 1), image points pi0 and pi1. The second point's
// equations determine alpha = V/B and beta = U/A:
//
//   U = -2x, V = -2y, A = pi1 (1-xy) - (pi0-pi1) d (1+xy), B = pib1 (1-xy) - (pib0-pib1) d (1+xy).
//
// That leaves, for each of three rays (c, q) with m = q x c and image point pi,
//
//   2AB s(m) + pib AV u(m) + pi BU v(m) + i d [(pib0-pib) AV u(q) - (pi0-pi) BU v(q) + (pib pi0 - pi pib0) UV s(q)] = 0.
//
// All derivatives by automatic differentiation: for tests, where simplicity counts.
#pragma once

#include <vector>

#include "MinimalProblem.hpp"
#include "math/homotopy/PathTracker.hpp"
#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace test {

using namespace math;

// A complex number and its derivatives with respect to x, y, log d and t.
template <class V>
struct Dual {
  Complex<V> value{}, d[4] = {};
};
template <class V>
Dual<V> operator+(Dual<V> a, const Dual<V>& b) {
  a.value = a.value + b.value;
  for (int k = 0; k < 4; ++k) a.d[k] = a.d[k] + b.d[k];
  return a;
}
template <class V>
Dual<V> operator*(const Dual<V>& a, const Dual<V>& b) {
  Dual<V> product{a.value * b.value};
  for (int k = 0; k < 4; ++k) product.d[k] = a.d[k] * b.value + a.value * b.d[k];
  return product;
}
template <class V>
Dual<V> operator*(const solvers::h51f::ComplexNumber& a, const Dual<V>& b) {
  return Dual<V>{{V{} + static_cast<Real<V>>(a.re), V{} + static_cast<Real<V>>(a.im)}} * b;
}
template <class V>
Dual<V> operator-(const Dual<V>& a, const Dual<V>& b) {
  return a + solvers::h51f::ComplexNumber{-1, 0} * b;
}

struct H32fSystem {
  static constexpr int kUnknowns = 3, kAbsolute = 2, kRays = 3;
  enum Unknown { X, Y, D, F, Ft };
  enum RayParameter { Direction, Centre = 3, Image = 6, ImageBar };
  enum Parameter { PointImages = 8 * kRays, PointImagesBar = PointImages + 2, kParameters = PointImagesBar + 2 };

  using Parameters = std::vector<solvers::h51f::ComplexNumber>;

  template <class Scalar>
  struct Homotopy {
    math::Polynomial<Scalar, 1> parameter[kParameters];
  };
  static Homotopy<double> straightHomotopy(const Parameters& start, const Parameters& target) {
    Homotopy<double> homotopy;
    for (std::size_t i = 0; i < kParameters; ++i)
      homotopy.parameter[i] = {{start[i].re, target[i].re - start[i].re}, {start[i].im, target[i].im - start[i].im}};
    return homotopy;
  }

  template <class V>
  struct Data {
    Dual<V> parameter[kParameters];
  };
  template <class V>
  static void dataAt(const Homotopy<Real<V>>& homotopy, V t, Data<V>& data) {
    for (int i = 0; i < kParameters; ++i) {
      const auto& p = homotopy.parameter[i];
      data.parameter[i].value = {t * p.re[1] + p.re[0], t * p.im[1] + p.im[0]};
      data.parameter[i].d[3] = {V{} + p.re[1], V{} + p.im[1]};
    }
  }

  template <bool derivative, class V>
  static void evaluate(const Homotopy<Real<V>>&, V, const Data<V>& data, const Complex<V> (&unknowns)[kUnknowns],
                       Complex<V> (&rows)[kUnknowns][kUnknowns + 1 + derivative]) {
    constexpr solvers::h51f::ComplexNumber kI{0, 1}, kTwo{2, 0}, kMinusTwo{-2, 0};
    const Complex<V> unity{V{} + 1, V{}};
    Dual<V> one{unity}, x{unknowns[X]}, y{unknowns[Y]}, d{unknowns[D]};
    x.d[X] = y.d[Y] = unity;
    d.d[D] = unknowns[D];
    const auto &pi0 = data.parameter[PointImages], &pi1 = data.parameter[PointImages + 1];
    const auto &pib0 = data.parameter[PointImagesBar], &pib1 = data.parameter[PointImagesBar + 1];
    const Dual<V> xy = x * y, U = kMinusTwo * x, V_ = kMinusTwo * y;
    const Dual<V> A = pi1 * (one - xy) - (pi0 - pi1) * d * (one + xy), B = pib1 * (one - xy) - (pib0 - pib1) * d * (one + xy);
    const Dual<V> AB = A * B, AV = A * V_, BU = B * U, UV = U * V_, id = kI * d;
    for (int j = 0; j < kRays; ++j) {
      const Dual<V>*ray = data.parameter + 8 * j, *q = ray + Direction, *c = ray + Centre;
      const Dual<V> m[3] = {q[1] * c[2] - q[2] * c[1], q[2] * c[0] - q[0] * c[2], q[0] * c[1] - q[1] * c[0]};
      const Dual<V>&pi = ray[Image], &pib = ray[ImageBar];
      const auto u = [&](const Dual<V>* w) { return w[0] + kI * w[1] - kTwo * x * w[2] - x * x * (w[0] - kI * w[1]); };
      const auto v = [&](const Dual<V>* w) { return w[0] - kI * w[1] - kTwo * y * w[2] - y * y * (w[0] + kI * w[1]); };
      const auto s = [&](const Dual<V>* w) { return w[2] + x * (w[0] - kI * w[1]) + y * (w[0] + kI * w[1]) - xy * w[2]; };
      const Dual<V> equation = kTwo * AB * s(m) + pib * AV * u(m) + pi * BU * v(m) +
                               id * ((pib0 - pib) * AV * u(q) - (pi0 - pi) * BU * v(q) + (pib * pi0 - pi * pib0) * UV * s(q));
      for (int k = 0; k < kUnknowns; ++k) rows[j][k] = equation.d[k];
      rows[j][F] = equation.value;
      if constexpr (derivative) rows[j][Ft] = equation.d[3];
    }
  }
};

}  // namespace test
}  // namespace hybridgv

// The Dixon resultant matrix of three polynomials f_1, f_2, f_3 of degree 2 in tau and of degree 2 in delta.
//
// Collect the three equations in one vector, f(tau, delta) = sum p[a][b] tau^a delta^b with coefficient vectors p[a][b] in R^3.
// The polynomial
//
//     D(tau, delta; sigma, epsilon) = det[ f(tau, delta), f(sigma, delta), f(sigma, epsilon) ] / ((tau-sigma) (delta-epsilon))
//
// vanishes for every (sigma, epsilon) where (tau, delta) is a common root of the f_i. It has degrees (1, 3; 3, 1), so that
//
//     D = - (sigma^s epsilon^p)_{s<4, p<2}^T  M  (tau^a delta^b)_{a<2, b<4}
//
// with an 8x8 matrix M: a common root makes M singular, and (tau^a delta^b) is then its right null vector.
//
// M in closed form. Write f(tau, delta) = P0 + P1 tau + P2 tau^2 with P_a(delta) in R^3[delta], and define for f, g in R^3[delta]
//
//     Z(f, g) = (f(epsilon) x g(delta) + g(epsilon) x f(delta)) / (delta - epsilon),      Z(f) = Z(f, f) / 2,
//
// the polynomial z01 + z02 (delta + epsilon) + z12 delta epsilon with z_ij = f_i x g_j + g_i x f_j (Z(f): f_i x f_j). Then
// D = - f(tau, delta) . Z(f(sigma, .)) / (tau - sigma), and because f(sigma, delta) . Z(f(sigma, .)) = 0 the division leaves
//
//            tau^0                       tau^1
//   sigma^0  P1.Z(P0)                    P2.Z(P0)
//   sigma^1  P2.Z(P0) - P0.Z(P1)         P2.Z(P0, P1)
//   sigma^2  -P0.Z(P1, P2)               P2.Z(P1) - P0.Z(P2)
//   sigma^3  -P0.Z(P2)                   -P1.Z(P2)                 (P_a at delta)
//
// where every entry is a 2x4 block: the coefficients of epsilon^p delta^b. (The four rows of sigma^2 and sigma^3 are stored with
// the opposite sign, which changes neither the determinant nor the null vector.)
//
// V is a number, or a SIMD vector of numbers.
#pragma once

#include "math/Vec3.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

// A vector-valued polynomial of degree 2 in delta: coefficients of 1, delta, delta^2.
template <class V>
using Quadratic = Vec3<V>[3];

// z01 + z02 (delta + epsilon) + z12 delta epsilon
template <class V>
struct Bezoutian {
  Vec3<V> z01, z02, z12;
};

template <class V>
HYBRIDGV_INLINE Bezoutian<V> bezoutian(const Quadratic<V>& f) {
  return {cross(f[0], f[1]), cross(f[0], f[2]), cross(f[1], f[2])};
}
template <class V>
HYBRIDGV_INLINE Bezoutian<V> bezoutian(const Quadratic<V>& f, const Quadratic<V>& g) {
  return {cross(f[0], g[1]) + cross(g[0], f[1]), cross(f[0], g[2]) + cross(g[0], f[2]), cross(f[1], g[2]) + cross(g[1], f[2])};
}

// Coefficients of epsilon^p delta^b.
template <class V>
struct Block {
  V c[2][4];
};

// f(delta) . z(delta, epsilon)
template <class V>
HYBRIDGV_INLINE Block<V> product(const Quadratic<V>& f, const Bezoutian<V>& z) {
  const V a = dot(f[0], z.z02), b = dot(f[1], z.z02), c = dot(f[2], z.z02);
  return {{{dot(f[0], z.z01), dot(f[1], z.z01) + a, dot(f[2], z.z01) + b, c},
           {a, b + dot(f[0], z.z12), c + dot(f[1], z.z12), dot(f[2], z.z12)}}};
}
template <class V>
HYBRIDGV_INLINE Block<V> operator-(const Block<V>& a, const Block<V>& b) {
  Block<V> r;
  for (int p = 0; p < 2; ++p)
    for (int i = 0; i < 4; ++i) r.c[p][i] = a.c[p][i] - b.c[p][i];
  return r;
}
// M; row 2 s + p belongs to sigma^s epsilon^p, column 4 a + b to tau^a delta^b.
template <class V>
HYBRIDGV_INLINE void dixonMatrix(const Quadratic<V> (&p)[3], V (&m)[8][8]) {
  const auto set = [&m](int s, int a, const Block<V>& block) {
    for (int r = 0; r < 2; ++r)
      for (int b = 0; b < 4; ++b) m[2 * s + r][4 * a + b] = block.c[r][b];
  };
  const Bezoutian<V> z0 = bezoutian(p[0]), z1 = bezoutian(p[1]), z2 = bezoutian(p[2]);
  const Block<V> p2z0 = product(p[2], z0), p0z2 = product(p[0], z2);
  set(0, 0, product(p[1], z0));
  set(0, 1, p2z0);
  set(1, 0, p2z0 - product(p[0], z1));
  set(1, 1, product(p[2], bezoutian(p[0], p[1])));
  set(2, 0, product(p[0], bezoutian(p[1], p[2])));
  set(2, 1, p0z2 - product(p[2], z1));
  set(3, 0, p0z2);
  set(3, 1, product(p[1], z2));
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv

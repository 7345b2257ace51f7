// The equations of H51f as functions of the viewing direction n, the third row of the query's rotation.
//
// Origin of the rig at the 3D point, at depth d in the query and seen at p0 = g e0, |e0| = 1; a ray (c, q) of moment m = q x c is
// seen at p. Let (t1, t2, n) be a right-handed orthonormal frame and f (r1 + i r2) = w (t1 + i t2), |w| = f. The ray's equation
// is linear in
//
//   v = (f^2, Re w, Im w, d Re w, d Im w, g d)
//
// with the row, for D = p0 - p,
//
//   (-n.m,  -(px t1.m + py t2.m),  px t2.m - py t1.m,  Dx t2.q - Dy t1.q,  Dx t1.q + Dy t2.q,  (px e0y - py e0x) n.q).
//
// Five rays determine v up to scale, and n is a solution if v is of that form:
//
//   G1 = v1 v4 - v2 v3 = 0,   G2 = v0 v5 - g (v1 v3 + v2 v4) = 0.
//
// Both are quadratic forms Q1, Q2 of v. If four rays share a centre c, the query at c, which is at every n
//
//   v* = (g D, Re u, Im u, D Re u, D Im u, |w*|^2),   D = -n.c, w* = t1.c + i t2.c, u = -e0 conj(w*),
//
// satisfies their equations: a curve of improper solutions. Then v = A v* + B v2, with v2 the null vector of the four rows and v*
// and A = r5.v2, B = -r5.v*, and Q(v*) = 0 leaves the factor B in Q(v) = A B Q(v*, v2) + B^2 Q(v2), which is divided out.
#pragma once

#include <utility>

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace test {
namespace h51f_sphere {

using namespace math;

constexpr int kRays = 5;

// The data in coordinates of moderate size; the four rays that share a centre first.
template <class Real>
struct Data {
  Real direction[kRays][3], moment[kRays][3], image[kRays][2];
  Real point[2], pointRadius, pointAxis[2];  // p0, g, e0
  Real sharedCentre[3];
  bool fourShared;
};

template <class V, class Real>
HYBRIDGV_INLINE V dot(const V (&a)[3], const Real (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class V>
struct Frame {
  V t1[3], t2[3], n[3];
};

// A frame that depends smoothly on n but where n3 changes sign.
template <class V>
HYBRIDGV_INLINE Frame<V> frameAt(const V (&n)[3]) {
  const V one = V{} + 1, sign = n[2] < 0 ? -one : one;
  const V a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
  return {{1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]}, {b, sign + n[1] * n[1] * a, -n[1]}, {n[0], n[1], n[2]}};
}

template <class V, class Real>
HYBRIDGV_INLINE void rowOf(const Data<Real>& data, int j, const Frame<V>& frame, V (&row)[6]) {
  const auto& q = data.direction[j];
  const auto& m = data.moment[j];
  const Real px = data.image[j][0], py = data.image[j][1], Dx = data.point[0] - px, Dy = data.point[1] - py;
  const V t1m = dot(frame.t1, m), t2m = dot(frame.t2, m), t1q = dot(frame.t1, q), t2q = dot(frame.t2, q);
  row[0] = -dot(frame.n, m);
  row[1] = -(px * t1m + py * t2m);
  row[2] = px * t2m - py * t1m;
  row[3] = Dx * t2q - Dy * t1q;
  row[4] = Dx * t1q + Dy * t2q;
  row[5] = (px * data.pointAxis[1] - py * data.pointAxis[0]) * dot(frame.n, q);
}

// Exterior product of a p-form on R^6 with one more vector; a form's component for the coordinates in a set is at the set's bits.
template <int Set, class V>
HYBRIDGV_INLINE V wedgeComponent(const V (&form)[64], const V (&vector)[6]) {
  V sum = V{};
  bool negative = __builtin_popcount(Set) % 2 == 0;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k)
    if (Set >> k & 1) {
      const V product = vector[k] * form[Set & ~(1 << k)];
      sum = negative ? sum - product : sum + product;
      negative = !negative;
    }
  return sum;
}
template <int Size, class V, int... Sets>
HYBRIDGV_INLINE void wedge(V (&form)[64], const V (&vector)[6], std::integer_sequence<int, Sets...>) {
  ((__builtin_popcount(Sets) == Size ? void(form[Sets] = wedgeComponent<Sets>(form, vector)) : void()), ...);
}

// The vector orthogonal to five rows, of the size of their volume.
template <class V>
HYBRIDGV_INLINE void nullVector(const V (&rows)[5][6], V (&v)[6]) {
  V form[64];
  const std::make_integer_sequence<int, 64> allSets;
  for (int k = 0; k < 6; ++k) form[1 << k] = rows[0][k];
  wedge<2>(form, rows[1], allSets);
  wedge<3>(form, rows[2], allSets);
  wedge<4>(form, rows[3], allSets);
  wedge<5>(form, rows[4], allSets);
  for (int k = 0; k < 6; ++k) v[k] = k % 2 == 0 ? form[63 & ~(1 << k)] : -form[63 & ~(1 << k)];
}

// v, and G1, G2 scaled so that they do not depend on the lengths of the rows: values of one sample or of one per lane.
template <class V>
struct Sample {
  V v[6], G1, G2;
};

template <class V, class Real>
HYBRIDGV_INLINE Sample<V> sampleAt(const Data<Real>& data, const Frame<V>& frame) {
  Sample<V> sample;
  V rows[5][6];
  for (int j = 0; j < kRays; ++j) rowOf(data, j, frame, rows[j]);
  const auto Q1 = [](const V(&v)[6]) { return v[1] * v[4] - v[2] * v[3]; };
  const auto Q2 = [&data](const V(&v)[6]) { return v[0] * v[5] - data.pointRadius * (v[1] * v[3] + v[2] * v[4]); };
  const auto squaredNorm = [](const V(&v)[6]) {
    V sum = V{};
    for (int k = 0; k < 6; ++k) sum += v[k] * v[k];
    return sum;
  };
  if (!data.fourShared) {
    nullVector(rows, sample.v);
    const V scale = 1 / squaredNorm(sample.v);
    sample.G1 = scale * Q1(sample.v);
    sample.G2 = scale * Q2(sample.v);
    return sample;
  }
  const V D = -dot(frame.n, data.sharedCentre), re = dot(frame.t1, data.sharedCentre), im = dot(frame.t2, data.sharedCentre);
  const Real ex = data.pointAxis[0], ey = data.pointAxis[1];
  const V ur = -(ex * re + ey * im), ui = ex * im - ey * re;
  const V star[6] = {data.pointRadius * D, ur, ui, D * ur, D * ui, re * re + im * im};
  V fifth[6], v2[6], sum[6], A = V{}, B = V{};
  for (int k = 0; k < 6; ++k) {
    fifth[k] = rows[4][k];
    rows[4][k] = star[k];
  }
  nullVector(rows, v2);
  for (int k = 0; k < 6; ++k) {
    A += fifth[k] * v2[k];
    B -= fifth[k] * star[k];
    sum[k] = v2[k] + star[k];
  }
  for (int k = 0; k < 6; ++k) sample.v[k] = A * star[k] + B * v2[k];
  const V scale = 1 / squaredNorm(v2);
  sample.G1 = scale * (A * (Q1(sum) - Q1(v2)) + B * Q1(v2));
  sample.G2 = scale * (A * (Q2(sum) - Q2(v2)) + B * Q2(v2));
  return sample;
}

}  // namespace h51f_sphere
}  // namespace test
}  // namespace hybridgv

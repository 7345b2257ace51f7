// The equations of P3P and Newton's method for them, in every lane.
//
// With unit bearings v_i, c_ij = v_i . v_j and a_ij the squared distances of the points, the depths l_i along the bearings satisfy
//
//     l_i^2 + l_j^2 - 2 c_ij l_i l_j = a_ij.                                                                           (1)
#pragma once

#include "solvers/known_focal/TrianglePose.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace HYBRIDGV_INSTRUCTION_SET {

// Of the pairs 12, 13, 23.
template <class V>
struct Pairs {
  V of12, of13, of23;
  V sum() const { return of12 + of13 + of23; }
};

template <class V, class S>
HYBRIDGV_INLINE Pairs<V> broadcastPairs(const Pairs<S>& pairs) {
  return {broadcast<V>(pairs.of12), broadcast<V>(pairs.of13), broadcast<V>(pairs.of23)};
}

// The known quantities of (1). The squared distances have the sum 1.
template <class V>
struct P3pEquations {
  explicit P3pEquations(const TrianglePose<V>& pose)
      : cosine{dot(pose.bearing(0), pose.bearing(1)), dot(pose.bearing(0), pose.bearing(2)),
               dot(pose.bearing(1), pose.bearing(2))},
        squaredDistance{pose.squaredSide(0, 1), pose.squaredSide(0, 2), pose.squaredSide(1, 2)} {}
  // The same in all lanes.
  template <class S>
  explicit P3pEquations(const P3pEquations<S>& one)
      : cosine(broadcastPairs<V>(one.cosine)), squaredDistance(broadcastPairs<V>(one.squaredDistance)) {}

  Pairs<V> cosine, squaredDistance;
};

template <class V>
HYBRIDGV_INLINE Pairs<V> leftSides(const Pairs<V>& cosine, const Vec3<V>& l) {
  const V l11 = l.x * l.x, l22 = l.y * l.y, l33 = l.z * l.z;
  return {l11 + l22 - 2 * cosine.of12 * (l.x * l.y), l11 + l33 - 2 * cosine.of13 * (l.x * l.z),
          l22 + l33 - 2 * cosine.of23 * (l.y * l.z)};
}

// Depths of any common scale become those of the triangle, exact to rounding. At a double solution they are so already, and a step of
// Newton's method only amplifies its rounding errors.
template <class V>
HYBRIDGV_INLINE void solveExactly(const P3pEquations<V>& equations, Vec3<V>& depths) {
  using M = Mask<V>;
  const Pairs<V>&c = equations.cosine, &wanted = equations.squaredDistance;
  Pairs<V> left = leftSides(c, depths);
  const V scale2 = 1 / left.sum();
  left = {scale2 * left.of12, scale2 * left.of13, scale2 * left.of23};
  Vec3<V>& l = depths;
  l = squareRoot(scale2) * l;
  M moves = V{} == V{};
  for (int iteration = 0; iteration < 3; ++iteration) {
    const V r1 = (left.of12 - wanted.of12) / 2, r2 = (left.of13 - wanted.of13) / 2, r3 = (left.of23 - wanted.of23) / 2;
    const V residual = larger(absolute(r1), absolute(r2), absolute(r3)), size2 = squareOf(l);
    moves = allOf<M>(moves, residual >= 2e-16 * size2);
    if (!any(moves)) return;
    const V a = l.x - c.of12 * l.y, b = l.y - c.of12 * l.x, d = l.z - c.of13 * l.x, e = l.y - c.of23 * l.z;
    const V f = l.x - c.of13 * l.z, g = l.z - c.of23 * l.y, de = d * e, bg = b * g, inverse = -1 / (a * de + bg * f);
    const Vec3<V> step{inverse * (b * d * r3 - de * r1 - bg * r2), inverse * (a * (g * r2 - d * r3) - f * g * r1),
                       inverse * (f * (e * r1 - b * r3) - a * e * r2)};
    const V step2 = squareOf(step);
    moves = allOf<M>(moves, step2 < 1e-2 * size2, anyOf<M>(step2 <= 1e-8 * size2, residual >= 1e-12 * size2));
    l = chosen<V>(moves, l - step, l);
    moves = allOf<M>(moves, step2 >= 1e-18 * size2);
    left = leftSides(c, l);
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

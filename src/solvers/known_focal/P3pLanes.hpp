// P3P in every lane: three 2D-3D points, six equations for six unknowns.
//
// With unit bearings v_i, c_ij = v_i . v_j and a_ij the squared distances of the points, the depths l_i along the bearings satisfy
//
//     l_i^2 + l_j^2 - 2 c_ij l_i l_j = a_ij.                                                                           (1)
//
// Two differences of these are homogeneous, a23 M12 - a12 M23 and a23 M13 - a13 M23: two conics, whose intersections are the
// solutions up to scale. A pair of lines in their pencil, one real root of a cubic, gives them by quadratic equations.
#pragma once

#include "solvers/known_focal/OutermostRoot.hpp"
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

// The known quantities of (1). The squared distances have the sum 1.
template <class V>
struct Triangle {
  Pairs<V> cosine, squaredSine, squaredDistance;
};

template <class V>
HYBRIDGV_INLINE Pairs<V> leftSides(const Pairs<V>& cosine, const Vec3<V>& l) {
  const V l11 = l.x * l.x, l22 = l.y * l.y, l33 = l.z * l.z;
  return {l11 + l22 - 2 * cosine.of12 * (l.x * l.y), l11 + l33 - 2 * cosine.of13 * (l.x * l.z),
          l22 + l33 - 2 * cosine.of23 * (l.y * l.z)};
}

// The symmetric matrix of a conic.
template <class V>
struct Conic {
  V xx, xy, xz, yy, yz, zz;

  V trace(const Conic& other) const {  // of the product
    return xx * other.xx + yy * other.yy + zz * other.zz + 2 * (xy * other.xy + xz * other.xz + yz * other.yz);
  }
  Conic adjugate() const {
    return {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy, xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
  }
};
template <class V>
HYBRIDGV_INLINE Conic<V> chosen(Mask<V> mask, const Conic<V>& yes, const Conic<V>& no) {
  return {select<V>(mask, yes.xx, no.xx), select<V>(mask, yes.xy, no.xy), select<V>(mask, yes.xz, no.xz),
          select<V>(mask, yes.yy, no.yy), select<V>(mask, yes.yz, no.yz), select<V>(mask, yes.zz, no.zz)};
}

// g1 D1 + g2 D2
template <class V>
struct Member {
  V g1, g2;
};

// A pair of lines in the pencil: det(D1 + g D2) = k0 + k1 g + k2 g^2 + k3 g^3 = 0. Both ends vanish where the circles through the
// query and two of the points have one radius: then D1 and D2 are such pairs themselves.
template <class V>
HYBRIDGV_INLINE Member<V> lines(const Triangle<V>& t, const Conic<V>& D1, const Conic<V>& D2) {
  using M = Mask<V>;
  const Pairs<V>&a = t.squaredDistance, &s = t.squaredSine;
  const V k0 = a.of12 * a.of23 * (a.of12 * s.of23 - a.of23 * s.of12);
  const V k3 = a.of13 * a.of23 * (a.of13 * s.of23 - a.of23 * s.of13);
  const V k1 = D1.adjugate().trace(D2), k2 = D2.adjugate().trace(D1);
  const V abs0 = absolute(k0), abs1 = absolute(k1), abs2 = absolute(k2), abs3 = absolute(k3);
  const M last = abs3 > abs0;
  const V r = 1 / select<V>(last, k3, k0);
  const V root = cubicRoot<V>(r * select<V>(last, k2, k1), r * select<V>(last, k1, k2), r * select<V>(last, k0, k3));
  Member<V> member{select<V>(last, one<V>(), root), select<V>(last, root, one<V>())};
  const M bothEnds = math::larger(abs0, abs3) <= 1e-14 * math::larger(abs1, abs2);
  if (any(bothEnds)) {
    const M first = abs1 >= abs2;
    member.g1 = select<V>(bothEnds, select<V>(first, one<V>(), V{}), member.g1);
    member.g2 = select<V>(bothEnds, select<V>(first, V{}, one<V>()), member.g2);
  }
  return member;
}

// The solutions are handed to add(asked, rotation, position, n), n = 0 .. 3, with the lanes that have one.
template <class V, class Add>
class P3p {
 public:
  using M = Mask<V>;

  P3p(const TrianglePose<V>& pose, const Add& add) : pose_(pose), add_(add) {
    const auto squaredSine = [&](int i, int j) { return squareOf(cross(pose.bearing(i), pose.bearing(j))); };
    const auto cosine = [&](int i, int j) { return dot(pose.bearing(i), pose.bearing(j)); };
    triangle_ = {{cosine(0, 1), cosine(0, 2), cosine(1, 2)},
                 {squaredSine(0, 1), squaredSine(0, 2), squaredSine(1, 2)},
                 {pose.squaredSide(0, 1), pose.squaredSide(0, 2), pose.squaredSide(1, 2)}};
  }

  void solve() {
    const Pairs<V>&s = triangle_.squaredSine, &a = triangle_.squaredDistance, &c = triangle_.cosine;
    const M asked = pose_.isTriangle() & (larger(s.of12, s.of13, s.of23) > kOneDirection);
    if (!any(asked)) return;
    const Conic<V> D1{a.of23, -a.of23 * c.of12, V{}, a.of23 - a.of12, a.of12 * c.of23, -a.of12};
    const Conic<V> D2{a.of23, V{}, -a.of23 * c.of13, -a.of13, a.of13 * c.of23, a.of23 - a.of13};
    const Member<V> member = lines(triangle_, D1, D2);
    const Conic<V> both{member.g1 * D1.xx + member.g2 * D2.xx,
                        member.g1 * D1.xy,
                        member.g2 * D2.xz,
                        member.g1 * D1.yy + member.g2 * D2.yy,
                        member.g1 * D1.yz + member.g2 * D2.yz,
                        member.g1 * D1.zz + member.g2 * D2.zz};
    split(asked, both, chosen<V>(absolute(member.g2) > absolute(member.g1), D1, D2));
  }

 private:
  // The lines p, q of D = p q^T + q p^T. With z = p x q, adj D = -z z^T, and D + s [z]x has rank 1 for s = 1 or -1: its rows are
  // multiples of one line, its columns of the other. s is such that nothing cancels in the entry (j, k) after the largest z_i, which
  // row j and column k share. Without a real z the lines are complex, and there is no solution.
  void split(M asked, const Conic<V>& D, const Conic<V>& other) {
    const Conic<V> adjugate = D.adjugate();
    const M isSecond = adjugate.yy < adjugate.xx;
    const M isThird = adjugate.zz < select<V>(isSecond, adjugate.yy, adjugate.xx);
    const auto ofLargest = [&](V first, V second, V third) {
      return select<V>(isThird, third, select<V>(isSecond, second, first));
    };
    const V square = -ofLargest(adjugate.xx, adjugate.yy, adjugate.zz);
    asked = asked & (square > 0);
    if (!any(asked)) return;
    const V entry = ofLargest(D.yz, D.xz, D.xy);
    const V r = -1 / squareRoot(square), scale = select<V>(entry < 0, r, -r);  // s among it
    const Vec3<V> z{scale * ofLargest(adjugate.xx, adjugate.xy, adjugate.xz),
                    scale * ofLargest(adjugate.xy, adjugate.yy, adjugate.yz),
                    scale * ofLargest(adjugate.xz, adjugate.yz, adjugate.zz)};
    const V xyMinus = D.xy - z.z, xyPlus = D.xy + z.z, xzPlus = D.xz + z.y, xzMinus = D.xz - z.y, yzMinus = D.yz - z.x,
            yzPlus = D.yz + z.x;
    intersect(0, asked, {ofLargest(xyPlus, xzMinus, D.xx), ofLargest(D.yy, yzPlus, xyMinus), ofLargest(yzMinus, D.zz, xzPlus)},
              other);
    intersect(2, asked, {ofLargest(xzPlus, D.xx, xyMinus), ofLargest(yzMinus, xyPlus, D.yy), ofLargest(D.zz, xzMinus, yzPlus)},
              other);
  }

  // The points of a line with positive coordinates on the other conic. A line that meets the positive octant has one coefficient
  // whose sign differs from the others'; there l_a = |line_c| s, l_b = |line_c| t, l_c = |line_a| s + |line_b| t with s/t > 0, and the
  // conic is alpha s^2 + 2 beta s t + gamma t^2. (a, b, c) is (0, 1, 2), (2, 0, 1) or (1, 2, 0).
  void intersect(int n, M asked, const Vec3<V>& line, const Conic<V>& D) {
    const M xIsNegative = line.x < 0, yIsNegative = line.y < 0, zIsNegative = line.z < 0;
    const M isThird = xIsNegative == yIsNegative, isSecond = xIsNegative == zIsNegative;
    asked = asked & negated<M>(isThird & isSecond);
    if (!any(asked)) return;
    const auto ofOther = [&](V first, V second, V third) {
      return select<V>(isThird, third, select<V>(isSecond, second, first));
    };
    const V absX = absolute(line.x), absY = absolute(line.y), absZ = absolute(line.z);
    const V la = ofOther(absY, absZ, absX), lb = ofOther(absZ, absX, absY), lc = ofOther(absX, absY, absZ);
    const V Daa = ofOther(D.yy, D.zz, D.xx), Dbb = ofOther(D.zz, D.xx, D.yy), Dcc = ofOther(D.xx, D.yy, D.zz);
    const V Dab = ofOther(D.yz, D.xz, D.xy), Dac = ofOther(D.xy, D.yz, D.xz), Dbc = ofOther(D.xz, D.xy, D.yz);
    const V ac = lc * Dac + la * Dcc, bc = lc * Dbc + lb * Dcc;
    const V alpha = lc * (lc * Daa + la * Dac) + la * ac, beta = lc * (lc * Dab + la * Dbc) + lb * ac,
            gamma = lc * (lc * Dbb + lb * Dbc) + lb * bc;
    const V discriminant = beta * beta - alpha * gamma;
    asked = asked & (discriminant > -kDouble * (beta * beta));
    if (!any(asked)) return;
    const V root = squareRoot(math::larger(discriminant, V{})), h = -(beta + select<V>(beta < 0, -root, root));
    const auto depthsAt = [&](V s, V t) {
      const V a = lc * s, b = lc * t, c = la * s + lb * t;
      return Vec3<V>{ofOther(c, b, a), ofOther(a, c, b), ofOther(b, a, c)};
    };
    const M first = asked & (h * alpha > 0), second = asked & (h * gamma > 0);
    if (any(first)) addAt(n, first, depthsAt(absolute(h), absolute(alpha)));
    if (any(second)) addAt(n + 1, second, depthsAt(absolute(gamma), absolute(h)));
  }

  void addAt(int n, M asked, Vec3<V> depths) {
    const Pairs<V> left = leftSides(triangle_.cosine, depths);
    const V scale2 = 1 / left.sum();
    depths = squareRoot(scale2) * depths;
    refine(depths, {scale2 * left.of12, scale2 * left.of13, scale2 * left.of23});
    asked = asked & (depths.x > 0) & (depths.y > 0) & (depths.z > 0);
    for (int i = 0; i < n; ++i)
      if (any(found_[i]))
        asked = asked & negated<M>(found_[i] & (squareOf(depths_[i] - depths) < kSame * kSame * squareOf(depths)));
    if (!any(asked)) return;
    Columns<V> rotation;
    Vec3<V> position;
    found_[n] = asked & pose_.set(asked, {depths.x, depths.y, depths.z}, rotation, position);
    depths_[n] = depths;
    add_(n, found_[n], rotation, position);
  }

  // Newton's method for (1), from depths of these left sides. At a double solution the start is exact already, and a step only
  // amplifies its rounding errors.
  void refine(Vec3<V>& l, Pairs<V> left) const {
    const Pairs<V>&c = triangle_.cosine, &wanted = triangle_.squaredDistance;
    M moves = V{} == V{};
    for (int iteration = 0; iteration < 3; ++iteration) {
      const V r1 = (left.of12 - wanted.of12) / 2, r2 = (left.of13 - wanted.of13) / 2, r3 = (left.of23 - wanted.of23) / 2;
      const V residual = larger(absolute(r1), absolute(r2), absolute(r3)), size2 = squareOf(l);
      moves = moves & (residual >= 2e-16 * size2);
      if (!any(moves)) return;
      const V a = l.x - c.of12 * l.y, b = l.y - c.of12 * l.x, d = l.z - c.of13 * l.x, e = l.y - c.of23 * l.z;
      const V f = l.x - c.of13 * l.z, g = l.z - c.of23 * l.y, de = d * e, bg = b * g, inverse = -1 / (a * de + bg * f);
      const Vec3<V> step{inverse * (b * d * r3 - de * r1 - bg * r2), inverse * (a * (g * r2 - d * r3) - f * g * r1),
                         inverse * (f * (e * r1 - b * r3) - a * e * r2)};
      const V step2 = squareOf(step);
      moves = moves & (step2 < 1e-2 * size2) & ((step2 <= 1e-8 * size2) | (residual >= 1e-12 * size2));
      l = chosen<V>(moves, l - step, l);
      moves = moves & (step2 >= 1e-18 * size2);
      left = leftSides(c, l);
    }
  }

  static constexpr double kOneDirection = 1e-24;  // the squared sine of an angle that rounding cannot tell from 0
  static constexpr double kDouble = 1e-8;         // the square of the relative uncertainty of a double root
  static constexpr double kSame = 1e-7;           // depths that differ by less, relative, are those of one solution

  const TrianglePose<V>& pose_;
  const Add& add_;
  Triangle<V> triangle_;
  Vec3<V> depths_[4];
  M found_[4] = {};
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

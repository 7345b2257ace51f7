// The depths of P3P up to scale, in every lane.
//
// Two differences of the equations (P3pEquations.hpp) are homogeneous, a23 M12 - a12 M23 and a23 M13 - a13 M23: two conics, whose
// intersections are the solutions up to scale. A pair of lines in their pencil, one real root of a cubic, gives them by quadratic
// equations.
#pragma once

#include "solvers/known_focal/OutermostRoot.hpp"
#include "solvers/known_focal/P3pEquations.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace HYBRIDGV_INSTRUCTION_SET {

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
HYBRIDGV_INLINE Member<V> lines(const P3pEquations<V>& equations, const Pairs<V>& squaredSine, const Conic<V>& D1,
                                const Conic<V>& D2) {
  using M = Mask<V>;
  const Pairs<V>&a = equations.squaredDistance, &s = squaredSine;
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

// Up to four, each in the lanes where it exists.
template <class V>
class P3pDepths {
 public:
  using M = Mask<V>;

  P3pDepths(const TrianglePose<V>& pose, const P3pEquations<V>& equations) {
    const auto squaredSine = [&](int i, int j) { return squareOf(cross(pose.bearing(i), pose.bearing(j))); };
    const Pairs<V> s{squaredSine(0, 1), squaredSine(0, 2), squaredSine(1, 2)};
    const Pairs<V>&a = equations.squaredDistance, &c = equations.cosine;
    const M asked = allOf<M>(pose.isTriangle(), larger(s.of12, s.of13, s.of23) > kOneDirection);
    if (!any(asked)) return;
    const Conic<V> D1{a.of23, -a.of23 * c.of12, V{}, a.of23 - a.of12, a.of12 * c.of23, -a.of12};
    const Conic<V> D2{a.of23, V{}, -a.of23 * c.of13, -a.of13, a.of13 * c.of23, a.of23 - a.of13};
    const Member<V> member = lines(equations, s, D1, D2);
    const Conic<V> both{member.g1 * D1.xx + member.g2 * D2.xx,
                        member.g1 * D1.xy,
                        member.g2 * D2.xz,
                        member.g1 * D1.yy + member.g2 * D2.yy,
                        member.g1 * D1.yz + member.g2 * D2.yz,
                        member.g1 * D1.zz + member.g2 * D2.zz};
    split(asked, both, chosen<V>(absolute(member.g2) > absolute(member.g1), D1, D2));
  }

  M exists(int n) const { return exists_[n]; }
  const Vec3<V>& operator[](int n) const { return depths_[n]; }

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
    asked = allOf<M>(asked, square > 0);
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
    asked = allOf(asked, negated<M>(allOf(isThird, isSecond)));
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
    asked = allOf<M>(asked, discriminant > -kDouble * (beta * beta));
    if (!any(asked)) return;
    const V root = squareRoot(math::larger(discriminant, V{})), h = -(beta + select<V>(beta < 0, -root, root));
    const auto depthsAt = [&](V s, V t) {
      const V a = lc * s, b = lc * t, c = la * s + lb * t;
      return Vec3<V>{ofOther(c, b, a), ofOther(a, c, b), ofOther(b, a, c)};
    };
    const M first = allOf<M>(asked, h * alpha > 0), second = allOf<M>(asked, h * gamma > 0);
    set(n, first, depthsAt(absolute(h), absolute(alpha)));
    set(n + 1, second, depthsAt(absolute(gamma), absolute(h)));
  }

  void set(int n, M exists, const Vec3<V>& depths) {
    exists_[n] = exists;
    depths_[n] = depths;
  }

  static constexpr double kOneDirection = 1e-24;  // the squared sine of an angle that rounding cannot tell from 0
  static constexpr double kDouble = 1e-8;         // the square of the relative uncertainty of a double root

  M exists_[4] = {};
  Vec3<V> depths_[4];
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

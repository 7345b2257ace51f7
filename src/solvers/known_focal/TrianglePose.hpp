// The pose from a triangle of points and their depths, in every lane.
#pragma once

#include "math/Vec3.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;

template <class V>
HYBRIDGV_INLINE V larger(V a, V b, V c) {
  return math::larger(math::larger(a, b), c);
}
template <class V>
HYBRIDGV_INLINE V largestOf(const Vec3<V>& v) {
  return larger(absolute(v.x), absolute(v.y), absolute(v.z));
}
template <class V>
HYBRIDGV_INLINE V squareOf(const Vec3<V>& v) {
  return dot(v, v);
}
template <class V>
HYBRIDGV_INLINE Vec3<V> normalized(const Vec3<V>& v) {
  return (1 / squareRoot(squareOf(v))) * v;
}
// Also by numbers whose reciprocal is none.
template <class V>
HYBRIDGV_INLINE Vec3<V> divided(const Vec3<V>& v, V by) {
  return {v.x / by, v.y / by, v.z / by};
}
template <class V>
HYBRIDGV_INLINE V one() {
  return broadcast<V>(1);
}

// Three vectors: the columns of a matrix.
template <class V>
struct Columns {
  Vec3<V> x, y, z;
};
// a b^T
template <class V>
HYBRIDGV_INLINE Columns<V> timesTransposed(const Columns<V>& a, const Columns<V>& b) {
  const auto column = [&](V x, V y, V z) { return x * a.x + y * a.y + z * a.z; };
  return {column(b.x.x, b.y.x, b.z.x), column(b.x.y, b.y.y, b.z.y), column(b.x.z, b.y.z, b.z.z)};
}
template <class V>
HYBRIDGV_INLINE Vec3<V> chosen(Mask<V> mask, const Vec3<V>& yes, const Vec3<V>& no) {
  return {select<V>(mask, yes.x, no.x), select<V>(mask, yes.y, no.y), select<V>(mask, yes.z, no.z)};
}
template <class V>
HYBRIDGV_INLINE Columns<V> chosen(Mask<V> mask, const Columns<V>& yes, const Columns<V>& no) {
  return {chosen<V>(mask, yes.x, no.x), chosen<V>(mask, yes.y, no.y), chosen<V>(mask, yes.z, no.z)};
}

// A frame and where there is one.
template <class V>
struct Frame {
  Columns<V> axes;
  Mask<V> exists;
};

// Three points and the bearings at which a camera of focal length 1 sees them. Lengths are measured in a unit in which the squares
// of the triangle's sides have the sum 1.
template <class V>
class TrianglePose {
 public:
  using M = Mask<V>;

  TrianglePose(const Vec3<V> (&points)[3], const V (&u)[3], const V (&v)[3])
      : first_(points[0]), u_{u[0], u[1], u[2]}, v_{v[0], v[1], v[2]} {
    imageScale_ = V{};
    for (int i = 0; i < 3; ++i) {
      bearings_[i] = bearingOf(u[i], v[i]);
      imageScale_ = larger(imageScale_, absolute(u[i]), absolute(v[i]));
    }
    setSides(points[1] - points[0], points[2] - points[0]);
    setDuals();
  }

  // The same in all lanes.
  template <class S>
  explicit TrianglePose(const TrianglePose<S>& one)
      : first_(all(one.first_)),
        bearings_{all(one.bearings_[0]), all(one.bearings_[1]), all(one.bearings_[2])},
        u_{all(one.u_[0]), all(one.u_[1]), all(one.u_[2])},
        v_{all(one.v_[0]), all(one.v_[1]), all(one.v_[2])},
        squaredSides_{all(one.squaredSides_[0]), all(one.squaredSides_[1]), all(one.squaredSides_[2])},
        unit_(all(one.unit_)),
        sides_{all(one.sides_[0]), all(one.sides_[1])},
        duals_{all(one.duals_.x), all(one.duals_.y), all(one.duals_.z)},
        isTriangle_(all(one.isTriangle_ ? 1 : 0) > 0),
        isThin_(all(one.isThin_ ? 1 : 0) > 0),
        imageScale_(all(one.imageScale_)) {}

  // Not where the points are collinear or at one place.
  M isTriangle() const { return isTriangle_; }
  const Vec3<V>& bearing(int i) const { return bearings_[i]; }
  // Of the pairs 01, 02, 12.
  V squaredSide(int i, int j) const { return squaredSides_[i + j - 1]; }

  // Where the depths along the bearings are those of a congruent triangle, the pose; not where its image misses the image points,
  // relative to the largest image coordinate, by more than 1e-7. `asked`: the lanes that matter.
  M set(M asked, const V (&depths)[3], Columns<V>& rotation, Vec3<V>& position) const {
    const Vec3<V> first = depths[0] * bearings_[0];
    const M isSet = setRotation(asked, depths[1] * bearings_[1] - first, depths[2] * bearings_[2] - first, rotation);
    position = first_ - unit_ * (first.x * rotation.x + first.y * rotation.y + first.z * rotation.z);
    return allOf(isSet, isMet(0, rotation, first), isMet(1, rotation, first));
  }

 private:
  template <class W>
  friend class TrianglePose;

  static V all(double x) { return broadcast<V>(x); }
  static Vec3<V> all(const Vec3<double>& v) { return {all(v.x), all(v.y), all(v.z)}; }

  // Sine of the angle at a point of a triangle that counts as collinear.
  static constexpr double kCollinear = 1e-12;
  static constexpr double kImageTolerance = 1e-7;
  // Sine of the angle at a point of a triangle whose duals have lost digits, and a product of sides whose square is not small.
  static constexpr double kThin = 1e-2, kShort = 1e-50;

  // (u, v, 1), normalized, without overflow.
  static Vec3<V> bearingOf(V u, V v) {
    const M isHuge = negated<M>(u * u + v * v < 1e300);
    Vec3<V> bearing{u, v, one<V>()};
    if (any(isHuge)) bearing = divided(bearing, select<V>(isHuge, math::larger(absolute(u), absolute(v)), one<V>()));
    return normalized(bearing);
  }

  void setSides(Vec3<V> a, Vec3<V> b) {
    const V extent = math::larger(largestOf(a), largestOf(b));
    const M isModerate = allOf<M>(extent > 1e-100, extent < 1e100);  // its square is a double
    V scale = one<V>();
    if (any(negated<M>(isModerate))) {
      scale = select<V>(isModerate, scale, extent);
      a = divided(a, scale);
      b = divided(b, scale);
    }
    const V aa = squareOf(a), bb = squareOf(b), cc = squareOf(b - a), sum = aa + bb + cc, root = squareRoot(sum);
    const V inverse = 1 / sum, inverseRoot = inverse * root;
    unit_ = scale * root;
    isTriangle_ = allOf<M>(extent > 0, unit_ < kHuge);
    sides_[0] = inverseRoot * a;
    sides_[1] = inverseRoot * b;
    squaredSides_[0] = aa * inverse;
    squaredSides_[1] = bb * inverse;
    squaredSides_[2] = cc * inverse;
  }

  // With the vectors a, b of both sides, n = a x b and |n|^2 = |a|^2 |b|^2 - (a.b)^2.
  void setDuals() {
    const Vec3<V>&a = sides_[0], &b = sides_[1], n = cross(a, b);
    const V aa = squaredSides_[0], bb = squaredSides_[1], ab = dot(a, b), nn = squareOf(n), inverse = 1 / nn;
    isThin_ = negated<M>(allOf<M>(aa * bb > kShort, nn > kThin * kThin * (aa * bb)));
    duals_ = {(inverse * bb) * a - (inverse * ab) * b, (inverse * aa) * b - (inverse * ab) * a, inverse * n};
    if (any(isThin_)) isTriangle_ = allOf(isTriangle_, anyOf(negated<M>(isThin_), frameOf(a, b).exists));
  }

  // Shorter or longer, where the square of the length would be beyond the doubles.
  static Vec3<V> moderate(const Vec3<V>& v) {
    const V square = squareOf(v);
    const M isModerate = allOf<M>(square > 1e-200, square < 1e200);
    return any(negated<M>(isModerate)) ? divided(v, select<V>(isModerate, one<V>(), largestOf(v))) : v;
  }

  // Orthonormal columns: along a, in the plane of a and b, normal to it. None where these are parallel.
  static Frame<V> frameOf(const Vec3<V>& a, const Vec3<V>& b) {
    const Vec3<V> first = normalized(moderate(a)), second = moderate(b), product = cross(first, second);
    const M exists = squareOf(product) > kCollinear * kCollinear * squareOf(second);
    // Of vectors that are almost parallel the product is perpendicular to neither, by as much as has cancelled in it.
    const Vec3<V> normal = normalized(product - dot(first, product) * first);
    return {{first, cross(normal, first), normal}, exists};
  }

  // From the depths' differences a, b of the other points to the first. The rotation is that of the duals, as the triangle is seen to
  // its own. Where that is not one to rounding, of frames that are orthonormal in any case.
  M setRotation(M asked, const Vec3<V>& a, const Vec3<V>& b, Columns<V>& rotation) const {
    const Columns<V> ofDuals = timesTransposed(duals_, {a, b, cross(a, b)});
    const M isSet = allOf(orthonormalize(ofDuals, rotation), negated<M>(isThin_));
    const M isLeft = allOf(asked, negated<M>(isSet));
    if (!any(isLeft)) return isSet;
    const Frame<V> own = frameOf(sides_[0], sides_[1]), seen = frameOf(a, b);
    rotation = chosen<V>(isSet, rotation, timesTransposed(own.axes, seen.axes));
    return anyOf(isSet, allOf(own.exists, seen.exists));
  }

  // A matrix that is almost a rotation becomes one to rounding: 1 / |v| is 3/2 - |v|^2 / 2, to the square of the small difference.
  static M orthonormalize(const Columns<V>& R, Columns<V>& rotation) {
    constexpr double kSmall = 1e-8;
    const V xx = squareOf(R.x), yy = squareOf(R.y), xy = dot(R.x, R.y);
    rotation.x = (1.5 - 0.5 * xx) * R.x;
    rotation.y = (1.5 - 0.5 * yy) * R.y - xy * rotation.x;
    rotation.z = cross(rotation.x, rotation.y);
    return allOf<M>(absolute(xx - 1) < kSmall, absolute(yy - 1) < kSmall, absolute(xy) < kSmall);
  }

  M isMet(int side, const Columns<V>& rotation, const Vec3<V>& first) const {
    const Vec3<V>& s = sides_[side];
    const V x = dot(rotation.x, s) + first.x, y = dot(rotation.y, s) + first.y, z = dot(rotation.z, s) + first.z;
    const V allowed = kImageTolerance * (imageScale_ * z);
    return allOf<M>(absolute(x - u_[side + 1] * z) <= allowed, absolute(y - v_[side + 1] * z) <= allowed);
  }

  static constexpr double kHuge = 1.7e308;

  Vec3<V> first_, bearings_[3];
  V u_[3], v_[3];
  V squaredSides_[3];  // of the pairs 01, 02, 12
  V unit_;
  Vec3<V> sides_[2];  // from the first point, in that unit
  Columns<V> duals_;  // the basis dual to both sides and their vector product
  M isTriangle_, isThin_;
  V imageScale_;  // the largest image coordinate
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

// H22: two rays and two points, six equations for six unknowns.
//
// The points X1, X2, seen at the unit bearings a1, a2 with the angle gamma between them, leave two angles. With u = (X1 - X2) / l,
// l = |X1 - X2|, the image R u is a unit vector in the plane of the bearings, and the rest of R is a turn about it:
//
//     R u = g = cos(theta) b1 + sin(theta) b2,   h = N x g,
//     R e1 = cos(psi) h + sin(psi) N,   R e2 = -sin(psi) h + cos(psi) N,
//
// b1 along a1 - a2, b2 along the bisector, N normal to both; u, e1, e2 orthonormal. The depth of X2 is L l, L = cos(theta + gamma/2) /
// sin(gamma), that of X1 has - gamma/2. Both are positive for |theta| < (pi - gamma) / 2.
//
// A ray along q through c, seen at the bearing v, gives A cos(psi) + B sin(psi) + K = 0 with trigonometric polynomials of degree 2
// in theta. Two rays: (x, y, z) = (A1, B1, K1) x (A2, B2, K2) is a multiple of (cos(psi), sin(psi), 1), so that
//
//     x^2 + y^2 - z^2 = 0,
//
// a binary form of degree 16 in (cos(theta/2) : sin(theta/2)), of which only the arc with positive depths is searched.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "math/roots/BinaryFormRoots.hpp"
#include "solvers/MinimalProblems.hpp"
#include "solvers/known_focal/Bearing.hpp"
#include "solvers/known_focal/RayInFront.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace {

using Eigen::Vector3d;
using math::Direction;
using math::Pair;
using Roots = math::BinaryFormRoots<16>;

constexpr int kMaxPoses = 16;

// The coefficients of cos(psi), sin(psi) and 1 in a ray's equation.
template <class T>
struct Row {
  T A, B, K;
};

template <class T>
Row<T> cross(const Row<T>& a, const Row<T>& b) {
  return {a.B * b.K - a.K * b.B, a.K * b.A - a.A * b.K, a.A * b.B - a.B * b.A};
}

template <class T>
T squaredNorm(const Row<T>& row) {
  return row.A * row.A + row.B * row.B + row.K * row.K;
}

// The angle theta by its cosine and sine, and the depth L of X2.
template <class T>
struct Angle {
  T cosine, sine, depth;
};

// What the two points are to the rays.
struct PointPair {
  Vector3d b1, b2, N;             // of the query
  Vector3d u, e1, e2;             // of the rig
  Vector3d X2, a2;                // the second point and its bearing
  double length;                  // l
  double cosHalf, sinHalf, sine;  // of gamma/2, and of gamma

  // False for points or bearings that coincide.
  bool set(const PointMatch* points) {
    const Vector3d difference = points[0].point - points[1].point;
    const double extent = difference.cwiseAbs().maxCoeff();
    if (!(extent > 0) || !std::isfinite(extent)) return false;
    u = (difference / extent).normalized();
    length = extent * (difference / extent).norm();
    e1 = u.unitOrthogonal();
    e2 = u.cross(e1);
    X2 = points[1].point;
    const Vector3d a1 = bearingOf(points[0].u, points[0].v);
    a2 = bearingOf(points[1].u, points[1].v);
    // Exactly orthonormal also where the bearings nearly coincide: what their difference has along the bisector is rounding.
    b2 = (a1 + a2).normalized();
    const Vector3d chord = a1 - a2, across = chord - b2.dot(chord) * b2;
    sinHalf = across.norm() / 2;
    cosHalf = (a1 + a2).norm() / 2;
    sine = 2 * sinHalf * cosHalf;
    if (!(sine > kOneDirection) || !std::isfinite(length)) return false;
    b1 = across / (2 * sinHalf);
    N = b1.cross(b2);
    return true;
  }

  template <class T>
  Angle<T> angle(const T& cosine, const T& sineOfTheta) const {
    return {cosine, sineOfTheta, (cosHalf / sine) * cosine - (sinHalf / sine) * sineOfTheta};
  }

  static constexpr double kOneDirection = 1e-12;  // sine of an angle that rounding cannot tell from 0
};

// A ray in the frames of the points: m = (c - X2) x q / l and q by u, e1, e2; v and k = v x a2 by b1, b2, N.
class Ray {
 public:
  Ray() = default;
  Ray(const PointPair& points, const RayMatch& match) {
    const Vector3d bearing = bearingOf(match.u, match.v),
                   moment = ((match.centre - points.X2) / points.length).cross(match.direction);
    const Vector3d product = bearing.cross(points.a2);
    m_ = {points.u.dot(moment), points.e1.dot(moment), points.e2.dot(moment)};
    q_ = {points.u.dot(match.direction), points.e1.dot(match.direction), points.e2.dot(match.direction)};
    v_ = {points.b1.dot(bearing), points.b2.dot(bearing), points.N.dot(bearing)};
    k_ = {points.b1.dot(product), points.b2.dot(product), points.N.dot(product)};
  }

  template <class T>
  Row<T> row(const Angle<T>& at) const {
    const T vg = at.cosine * v_[0] + at.sine * v_[1], vh = at.cosine * v_[1] - at.sine * v_[0];
    const T kg = at.cosine * k_[0] + at.sine * k_[1], kh = at.cosine * k_[1] - at.sine * k_[0];
    return {vh * m_[1] + m_[2] * v_[2] + at.depth * (kh * q_[1] + q_[2] * k_[2]),
            m_[1] * v_[2] - vh * m_[2] + at.depth * (q_[1] * k_[2] - kh * q_[2]), vg * m_[0] + at.depth * (kg * q_[0])};
  }

  // The equation and its derivatives by theta and psi; `slope` is that of the depth by theta.
  struct Value {
    double F, byTheta, byPsi;
  };
  Value value(const Angle<double>& at, double slope, double cosPsi, double sinPsi) const {
    const double vg = at.cosine * v_[0] + at.sine * v_[1], vh = at.cosine * v_[1] - at.sine * v_[0];
    const double kg = at.cosine * k_[0] + at.sine * k_[1], kh = at.cosine * k_[1] - at.sine * k_[0];
    const double mh = m_[1] * cosPsi - m_[2] * sinPsi, mN = m_[1] * sinPsi + m_[2] * cosPsi;
    const double qh = q_[1] * cosPsi - q_[2] * sinPsi, qN = q_[1] * sinPsi + q_[2] * cosPsi;
    const double Q = q_[0] * kg + qh * kh + qN * k_[2];
    return {m_[0] * vg + mh * vh + mN * v_[2] + at.depth * Q,
            m_[0] * vh - mh * vg + slope * Q + at.depth * (q_[0] * kh - qh * kg),
            mh * v_[2] - mN * vh + at.depth * (qh * k_[2] - qN * kh)};
  }

 private:
  Vector3d m_, q_, v_, k_;
};

class H22 {
 public:
  H22(const PointPair& points, const RayMatch* rays, double imageScale, FocalPose* solutions)
      : points_(points), matches_(rays), imageScale_(imageScale), solutions_(solutions) {
    for (int i = 0; i < 2; ++i) rays_[i] = Ray(points, rays[i]);
  }

  int solve() {
    // tan of half the largest |theta|
    const double q = points_.sinHalf / (1 + points_.cosHalf), end = (1 - q) / (1 + q), length = std::sqrt(1 + end * end);
    const Direction first{1 / length, -end / length}, last{1 / length, end / length};
    Direction roots[Roots::kMaxRoots];
    const int count = Roots::findSampledBetween(
        [this](const double* c, const double* s, double* p) {
          for (int j = 0; j < Roots::kPadded; j += 2) math::store(p + j, form(math::load<Pair>(c + j), math::load<Pair>(s + j)));
        },
        first, last, roots);
    for (int i = 0; i < count; ++i) lift(roots[i]);
    return count_;
  }

 private:
  Pair form(const Pair& c, const Pair& s) const {
    const Angle<Pair> at = points_.angle<Pair>(c * c - s * s, 2 * c * s);
    const Row<Pair> n = cross(rays_[0].row(at), rays_[1].row(at));
    return n.A * n.A + n.B * n.B - n.K * n.K;
  }

  // Psi is that of both rows. Where they are nearly parallel, or do not meet the circle, it is that of the larger row: a ray whose
  // point lies on the line of X1 and X2 has none at all, for any psi.
  void lift(const Direction& root) {
    const Direction theta{root.c * root.c - root.s * root.s, 2 * root.c * root.s};
    const Angle<double> at = points_.angle(theta.c, theta.s);
    const Row<double> rows[2] = {rays_[0].row(at), rays_[1].row(at)}, n = cross(rows[0], rows[1]);
    const double squares[2] = {squaredNorm(rows[0]), squaredNorm(rows[1])}, square = squaredNorm(n);
    const double sign = n.K < 0 ? -1 : 1;
    refine(theta, {sign * n.A, sign * n.B});
    if (std::abs(n.A * n.A + n.B * n.B - n.K * n.K) <= 1e-2 * square && square >= 1e-8 * squares[0] * squares[1]) return;
    const Row<double>& row = squares[0] > squares[1] ? rows[0] : rows[1];
    const double w = std::sqrt(std::max(row.A * row.A + row.B * row.B - row.K * row.K, 0.));
    for (const double side : {w, -w}) refine(theta, {side * row.B - row.A * row.K, -row.B * row.K - side * row.A});
  }

  // Newton's method for theta and psi, of which the latter has any length.
  void refine(Direction theta, Direction psi) {
    const double largest = std::max(std::abs(psi.c), std::abs(psi.s));  // whose square may underflow
    if (!(largest > 0)) return;
    const double c = psi.c / largest, s = psi.s / largest, inverse = 1 / std::sqrt(c * c + s * s);
    psi = {c * inverse, s * inverse};
    bool isConverged = false;
    for (int step = 0; step < 6 && !isConverged; ++step) {
      const Angle<double> at = points_.angle(theta.c, theta.s);
      const double slope = -(points_.cosHalf * at.sine + points_.sinHalf * at.cosine) / points_.sine;
      const Ray::Value a = rays_[0].value(at, slope, psi.c, psi.s), b = rays_[1].value(at, slope, psi.c, psi.s);
      const double determinant = a.byTheta * b.byPsi - a.byPsi * b.byTheta;
      const double byTheta = (a.F * b.byPsi - a.byPsi * b.F) / determinant,
                   byPsi = (a.byTheta * b.F - a.F * b.byTheta) / determinant;
      const double size = std::max(std::abs(byTheta), std::abs(byPsi));
      if (!(size < 0.5)) return;
      theta = turned(theta, -byTheta);
      psi = turned(psi, -byPsi);
      isConverged = size < 1e-7;
    }
    if (isConverged) accept(theta, psi);
  }

  // By an angle, up to its cube.
  static Direction turned(const Direction& direction, double angle) {
    const double t = angle / 2, inverse = 1 / (1 + t * t), cosine = (1 - t * t) * inverse, sine = 2 * t * inverse;
    return {direction.c * cosine - direction.s * sine, direction.s * cosine + direction.c * sine};
  }

  static bool areSame(const Direction& a, const Direction& b) {
    constexpr double kSame = 1e-7;
    return (a.c - b.c) * (a.c - b.c) + (a.s - b.s) * (a.s - b.s) < kSame * kSame;
  }

  void accept(const Direction& theta, const Direction& psi) {
    const double depth1 = theta.c * points_.cosHalf + theta.s * points_.sinHalf,
                 depth2 = theta.c * points_.cosHalf - theta.s * points_.sinHalf;
    if (!(depth1 > 0 && depth2 > 0) || count_ == kMaxPoses) return;
    for (int i = 0; i < count_; ++i)
      if (areSame(thetas_[i], theta) && areSame(psis_[i], psi)) return;
    const Vector3d g = theta.c * points_.b1 + theta.s * points_.b2, h = points_.N.cross(g);
    const Eigen::Matrix3d R = g * points_.u.transpose() + (psi.c * h + psi.s * points_.N) * points_.e1.transpose() +
                              (psi.c * points_.N - psi.s * h) * points_.e2.transpose();
    const Vector3d y2 = depth2 / points_.sine * points_.a2;  // X2 seen by the query, in units of l
    for (int i = 0; i < 2; ++i) {
      const Vector3d centre = R * ((matches_[i].centre - points_.X2) / points_.length) + y2;
      if (!isMetInFront(matches_[i], centre, R * matches_[i].direction, imageScale_)) return;
    }
    FocalPose& pose = solutions_[count_];
    pose.rotation = R.transpose();
    pose.position = points_.X2 - points_.length * (pose.rotation * y2);
    pose.focalLength = 1;
    thetas_[count_] = theta;
    psis_[count_++] = psi;
  }

  const PointPair& points_;
  const RayMatch* matches_;
  double imageScale_;
  FocalPose* solutions_;
  Ray rays_[2];
  Direction thetas_[kMaxPoses], psis_[kMaxPoses];
  int count_ = 0;
};

}  // namespace

int h22(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  PointPair pair;
  if (!pair.set(points)) return 0;
  double imageScale = 0;
  for (int i = 0; i < 2; ++i)
    imageScale = std::max({imageScale, std::abs(rays[i].u), std::abs(rays[i].v), std::abs(points[i].u), std::abs(points[i].v)});
  return H22(pair, rays, imageScale, solutions).solve();
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

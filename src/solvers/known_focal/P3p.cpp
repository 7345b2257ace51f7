// P3P: three 2D-3D points, six equations for six unknowns.
//
// With unit bearings v_i, c_ij = v_i . v_j and a_ij the squared distances of the points, the depths l_i along the bearings satisfy
//
//     l_i^2 + l_j^2 - 2 c_ij l_i l_j = a_ij.                                                                           (1)
//
// Two differences of these are homogeneous, a23 M12 - a12 M23 and a23 M13 - a13 M23: two conics, whose intersections are the
// solutions up to scale. A pair of lines in their pencil, one real root of a cubic, gives them by quadratic equations.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solvers/MinimalProblems.hpp"
#include "solvers/known_focal/TrianglePose.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of the pairs 12, 13, 23.
struct Pairs {
  double of12, of13, of23;
  double sum() const { return of12 + of13 + of23; }
};

// The known quantities of (1). The squared distances have the sum 1.
struct Triangle {
  Pairs cosine, squaredSine, squaredDistance;
};

Pairs leftSides(const Pairs& cosine, const Vector3d& l) {
  const double l11 = l[0] * l[0], l22 = l[1] * l[1], l33 = l[2] * l[2];
  return {l11 + l22 - 2 * cosine.of12 * l[0] * l[1], l11 + l33 - 2 * cosine.of13 * l[0] * l[2],
          l22 + l33 - 2 * cosine.of23 * l[1] * l[2]};
}

// The symmetric matrix of a conic.
struct Conic {
  double xx, xy, xz, yy, yz, zz;

  double trace(const Conic& other) const {  // of the product
    return xx * other.xx + yy * other.yy + zz * other.zz + 2 * (xy * other.xy + xz * other.xz + yz * other.yz);
  }
  Conic adjugate() const {
    return {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy, xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
  }
  Matrix3d matrix() const {
    Matrix3d result;
    result << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return result;
  }
};

// g1 D1 + g2 D2
struct Member {
  double g1, g2;
};

// y as a zero of y^3 - 3 p y - F, improved by Newton's method or, with the second derivative, by Halley's.
double newtonStep(double y, double p, double F) { return y - (y * (y * y - 3 * p) - F) / (3 * (y * y - p)); }
double halleyStep(double y, double p, double F) {
  const double value = y * (y * y - 3 * p) - F, slope = 3 * (y * y - p);
  return y - value * slope / (slope * slope - 3 * y * value);
}

// The real root of y^3 - 3 p y + F that is farthest from zero; its sign is opposite to that of F.
double outermostRoot(double p, double F) {
  const double absF = std::abs(F), square = F * F - 4 * p * p * p;
  double y;
  if (square < 0) {
    // Of three real roots 2 sqrt(p) cos(arccos(t) / 3) is the largest: here to 8e-4, after both steps to rounding.
    const double root = std::sqrt(p), t = absF / (2 * p * root);
    y = root * (1.732787 + t * (0.319656 - t * 0.052919));
    y = newtonStep(halleyStep(y, p, absF), p, absF);
  } else {
    const double u = std::cbrt((absF + std::sqrt(square)) / 2);
    if (!(u > 0)) return 0;
    y = newtonStep(u + p / u, p, absF);  // where p < 0 the two may cancel
  }
  return F > 0 ? -y : y;
}

// Where x^3 + b x^2 + c x + d is zero, as far from the inflection point as possible: that root is simple even where two solutions
// coincide.
double cubicRoot(double b, double c, double d) {
  const double m = -b / 3, p = m * m - c / 3;
  return m + outermostRoot(p, ((m + b) * m + c) * m + d);
}

// A pair of lines in the pencil: det(D1 + g D2) = k0 + k1 g + k2 g^2 + k3 g^3 = 0. Both ends vanish where the circles through the
// query and two of the points have one radius: then D1 and D2 are such pairs themselves.
Member lines(const Triangle& t, const Conic& D1, const Conic& D2) {
  const Pairs &a = t.squaredDistance, &s = t.squaredSine;
  const double k0 = a.of12 * a.of23 * (a.of12 * s.of23 - a.of23 * s.of12);
  const double k3 = a.of13 * a.of23 * (a.of13 * s.of23 - a.of23 * s.of13);
  const double k1 = D1.adjugate().trace(D2), k2 = D2.adjugate().trace(D1);
  const double abs0 = std::abs(k0), abs3 = std::abs(k3);
  if (std::max(abs0, abs3) <= 1e-14 * std::max(std::abs(k1), std::abs(k2)))
    return std::abs(k1) >= std::abs(k2) ? Member{1, 0} : Member{0, 1};
  if (abs3 > abs0) {
    const double r = 1 / k3;
    return {1, cubicRoot(r * k2, r * k1, r * k0)};
  }
  const double r = 1 / k0;
  return {cubicRoot(r * k1, r * k2, r * k3), 1};
}

class P3p {
 public:
  P3p(const Triangle& triangle, const TrianglePose& pose, FocalPose* solutions)
      : triangle_(triangle), pose_(pose), solutions_(solutions) {}

  int solve() {
    const Pairs &a = triangle_.squaredDistance, &c = triangle_.cosine;
    const Conic D1{a.of23, -a.of23 * c.of12, 0, a.of23 - a.of12, a.of12 * c.of23, -a.of12};
    const Conic D2{a.of23, 0, -a.of23 * c.of13, -a.of13, a.of13 * c.of23, a.of23 - a.of13};
    const Member member = lines(triangle_, D1, D2);
    const Conic both{member.g1 * D1.xx + member.g2 * D2.xx,
                     member.g1 * D1.xy,
                     member.g2 * D2.xz,
                     member.g1 * D1.yy + member.g2 * D2.yy,
                     member.g1 * D1.yz + member.g2 * D2.yz,
                     member.g1 * D1.zz + member.g2 * D2.zz};
    split(both, (std::abs(member.g2) > std::abs(member.g1) ? D1 : D2).matrix());
    return count_;
  }

 private:
  // The lines p, q of D = p q^T + q p^T. With z = p x q, adj D = -z z^T, and D + s [z]x has rank 1 for s = 1 or -1: its rows are
  // multiples of one line, its columns of the other. s is such that nothing cancels in the entry (j, k), which row j and column k
  // share. Without a real z the lines are complex, and there is no solution.
  void split(const Conic& D, const Matrix3d& other) {
    const Matrix3d matrix = D.matrix(), adjugate = D.adjugate().matrix();
    int i = 0;
    for (int n = 1; n < 3; ++n)
      if (adjugate(n, n) < adjugate(i, i)) i = n;
    if (!(adjugate(i, i) < 0)) return;
    const Vector3d z = adjugate.col(i) * (-1 / std::sqrt(-adjugate(i, i)));
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double s = matrix(j, k) < 0 ? 1 : -1;
    Vector3d row = matrix.row(j), column = matrix.col(k);
    // [z]x has -z_i at (j, k), z_k at (j, i) and z_j at (i, k).
    row[k] -= s * z[i];
    row[i] += s * z[k];
    column[j] -= s * z[i];
    column[i] += s * z[j];
    intersect(row, other);
    intersect(column, other);
  }

  // The points of a line with positive coordinates on the other conic. A line that meets the positive octant has one coefficient
  // whose sign differs from the others'; there l_a = |line_c| s, l_b = |line_c| t, l_c = |line_a| s + |line_b| t with s/t > 0, and the
  // conic is alpha s^2 + 2 beta s t + gamma t^2.
  void intersect(const Vector3d& line, const Matrix3d& D) {
    const bool negative[3] = {line[0] < 0, line[1] < 0, line[2] < 0};
    if (negative[0] == negative[1] && negative[1] == negative[2]) return;
    const int c = negative[0] == negative[1] ? 2 : (negative[0] == negative[2] ? 1 : 0);
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    const double la = std::abs(line[a]), lb = std::abs(line[b]), lc = std::abs(line[c]);
    const double ac = lc * D(a, c) + la * D(c, c), bc = lc * D(b, c) + lb * D(c, c);
    const double alpha = lc * (lc * D(a, a) + la * D(a, c)) + la * ac, beta = lc * (lc * D(a, b) + la * D(b, c)) + lb * ac,
                 gamma = lc * (lc * D(b, b) + lb * D(b, c)) + lb * bc;
    const double discriminant = beta * beta - alpha * gamma;
    if (!(discriminant > -kDouble * beta * beta)) return;
    const double h = -(beta + std::copysign(std::sqrt(std::max(discriminant, 0.)), beta));
    const auto addAt = [&](double s, double t) {
      Vector3d depths;
      depths[a] = lc * s;
      depths[b] = lc * t;
      depths[c] = la * s + lb * t;
      add(depths);
    };
    if (h * alpha > 0) addAt(std::abs(h), std::abs(alpha));
    if (h * gamma > 0) addAt(std::abs(gamma), std::abs(h));
  }

  void add(Vector3d depths) {
    Pairs left = leftSides(triangle_.cosine, depths);
    const double scale2 = 1 / left.sum();
    depths *= std::sqrt(scale2);
    refine(depths, {scale2 * left.of12, scale2 * left.of13, scale2 * left.of23});
    if (!(depths.minCoeff() > 0)) return;
    for (int i = 0; i < count_; ++i)
      if ((depths_[i] - depths).squaredNorm() < kSame * kSame * depths.squaredNorm()) return;
    if (!pose_.set(depths, solutions_[count_])) return;
    depths_[count_++] = depths;
  }

  // Newton's method for (1), from depths of these left sides. At a double solution the start is exact already, and a step only
  // amplifies its rounding errors.
  void refine(Vector3d& l, Pairs left) const {
    const Pairs& c = triangle_.cosine;
    for (int iteration = 0; iteration < 3; ++iteration) {
      const double r1 = (left.of12 - triangle_.squaredDistance.of12) / 2, r2 = (left.of13 - triangle_.squaredDistance.of13) / 2,
                   r3 = (left.of23 - triangle_.squaredDistance.of23) / 2;
      const double residual = std::max({std::abs(r1), std::abs(r2), std::abs(r3)}), size2 = l.squaredNorm();
      if (residual < 2e-16 * size2) return;
      const double a = l[0] - c.of12 * l[1], b = l[1] - c.of12 * l[0], d = l[2] - c.of13 * l[0], e = l[1] - c.of23 * l[2];
      const double f = l[0] - c.of13 * l[2], g = l[2] - c.of23 * l[1], inverse = -1 / (a * d * e + b * f * g);
      const Vector3d step(inverse * (b * d * r3 - d * e * r1 - b * g * r2), inverse * (a * g * r2 - a * d * r3 - f * g * r1),
                          inverse * (f * e * r1 - a * e * r2 - b * f * r3));
      const double step2 = step.squaredNorm();
      if (!(step2 < 1e-2 * size2) || (step2 > 1e-8 * size2 && residual < 1e-12 * size2)) return;
      l -= step;
      if (step2 < 1e-18 * size2) return;
      left = leftSides(c, l);
    }
  }

  static constexpr double kDouble = 1e-8;  // the square of the relative uncertainty of a double root
  static constexpr double kSame = 1e-7;    // depths that differ by less, relative, are those of one solution

  const Triangle& triangle_;
  const TrianglePose& pose_;
  FocalPose* solutions_;
  Vector3d depths_[4];
  int count_ = 0;
};

// Squared sine of the angle between bearings that rounding cannot tell apart.
constexpr double kOneDirection = 1e-24;

Triangle makeTriangle(const TrianglePose& pose) {
  const auto squaredSine = [&](int i, int j) { return pose.bearing(i).cross(pose.bearing(j)).squaredNorm(); };
  const auto cosine = [&](int i, int j) { return pose.bearing(i).dot(pose.bearing(j)); };
  return {{cosine(0, 1), cosine(0, 2), cosine(1, 2)},
          {squaredSine(0, 1), squaredSine(0, 2), squaredSine(1, 2)},
          {pose.squaredSide(0, 1), pose.squaredSide(0, 2), pose.squaredSide(1, 2)}};
}

}  // namespace

int p3p(const RayMatch*, const PointMatch* points, FocalPose* solutions) {
  TrianglePose pose;
  if (!pose.set(points)) return 0;
  const Triangle triangle = makeTriangle(pose);
  const Pairs& s = triangle.squaredSine;
  if (!(std::max({s.of12, s.of13, s.of23}) > kOneDirection)) return 0;
  return P3p(triangle, pose, solutions).solve();
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

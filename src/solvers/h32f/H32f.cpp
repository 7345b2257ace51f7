// H32f: pose and focal length from three 2D-2D and two 2D-3D correspondences, at most 26 solutions.
//
// With X_query = R X + t, the points X4, X5 with depths d4, d5 and the unit vector u from X5 to X4, the third row n of R gives
// e = n.u, the hidden variable. In a frame (e1, e2, u) at X5, with |X4 - X5| as the unit of length, n = (s cos psi, s sin psi,
// e), s^2 = w = 1 - e^2. Write image points as complex numbers p. Then
//
//     d4 = d5 + e,   l = p4 d4 - p5 d5 = f (R13 + i R23),   f = |l| / s,
//
// and with o = R (e1 + i e2), a complex 3-vector,
//
//     o1 + i o2 = exp(i psi) l/|l| (1-e),   o1 - i o2 = - exp(i psi) conj(l)/|l| (1+e),   o3 = s exp(i psi).
//
// So (e, psi, d = d5) give the pose, the 2D-3D equations hold identically, and each ray c + beta q with moment m = (c-X5) x q and
// image p leaves one equation s (A cos psi + B sin psi) + K = 0,
//
//     al = |l|^2 - e p.l,   g = (p - p5).l,   ga = p x p5 + a e d4,   a = (p - p5) x (p4 - p5),
//     A = m1 al + m2 p x l + d (q1 ga + q2 g),
//     B = m2 al - m1 p x l + d (q2 ga - q1 g),
//     K = m3 (e |l|^2 + w p.l) - w a q3 d d4.
//
// For fixed e these are three polynomials of degree 2 in tan(psi/2) and in d/e. They have a common root where their Dixon
// determinant (math/dixon/DixonMatrix.hpp) vanishes, a polynomial of degree 26 in e apart from constant factors.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "solvers/MinimalProblems.hpp"
#include "solvers/h32f/HiddenRoots.hpp"
#include "solvers/h32f/Kernel.hpp"

namespace hybridgv {
namespace solvers {
namespace h32f {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

double crossProduct(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

// The sample in the frame of the two points, image points divided by the largest coordinate.
struct NormalizedProblem {
  Vector3d origin;  // X5
  Matrix3d axes;    // columns e1, e2, u
  double length;    // |X4 - X5|
  double imageScale;
  Vector2d p4, p5;
  Vector2d p[3];
  Vector3d centre[3], direction[3];
};

// False if the two points coincide or if both lie in the principal point (any focal length then fits).
bool normalize(const RayMatch* rays, const PointMatch* points, NormalizedProblem& n) {
  const PointMatch *x4 = &points[0], *x5 = &points[1];
  // X5 is the point farther from the principal point.
  if (std::hypot(x4->u, x4->v) > std::hypot(x5->u, x5->v)) std::swap(x4, x5);
  n.imageScale = std::max(std::abs(x5->u), std::abs(x5->v));
  for (int j = 0; j < 3; ++j) n.imageScale = std::max({n.imageScale, std::abs(rays[j].u), std::abs(rays[j].v)});
  n.p4 = Vector2d(x4->u, x4->v) / n.imageScale;
  n.p5 = Vector2d(x5->u, x5->v) / n.imageScale;
  n.origin = x5->point;
  const Vector3d difference = x4->point - x5->point;
  n.length = difference.norm();
  if (!(n.length > 1e-14 * (x4->point.norm() + x5->point.norm())) || !(n.p5.norm() > 1e-12)) return false;
  const Vector3d u = difference / n.length, e1 = u.unitOrthogonal();
  n.axes << e1, u.cross(e1), u;
  for (int j = 0; j < 3; ++j) {
    n.p[j] = Vector2d(rays[j].u, rays[j].v) / n.imageScale;
    n.centre[j] = n.axes.transpose() * (rays[j].centre - n.origin) / n.length;
    n.direction[j] = n.axes.transpose() * rays[j].direction;
  }
  return true;
}

// The equations as polynomials in e and delta = d / e. With l = e L: L = p4 + (p4 - p5) delta. False if an equation vanishes, as
// it does for a ray through X4 or X5 with the same image point.
bool makeForms(const NormalizedProblem& n, const Vector2d& p4, Forms& f) {
  const Vector2d slope = p4 - n.p5;
  const double squaredL[3] = {p4.squaredNorm(), 2 * p4.dot(slope), slope.squaredNorm()};
  for (int j = 0; j < 3; ++j) {
    const Vector3d& q = n.direction[j];
    const Vector3d m = n.centre[j].cross(q);
    const Vector2d &p = n.p[j], difference = p - n.p5;
    const double pDotL[3] = {p.dot(p4), p.dot(slope), 0}, pCrossL[3] = {crossProduct(p, p4), crossProduct(p, slope), 0};
    const double g[3] = {0, difference.dot(p4), difference.dot(slope)};  // delta (p - p5).L
    const double constant[3] = {0, crossProduct(p, n.p5), 0};            // delta p x p5
    const double a = crossProduct(difference, slope);
    const double aTimes[3] = {0, a, a};  // a delta (delta + 1)
    double sum = 0;
    for (int b = 0; b < 3; ++b) {
      const double alpha = squaredL[b] - pDotL[b];
      f.a[b][0][j] = m[1] * pCrossL[b] + q[0] * constant[b];
      f.a[b][1][j] = m[0] * alpha + q[1] * g[b];
      f.a[b][2][j] = q[0] * aTimes[b];
      f.b[b][0][j] = -m[0] * pCrossL[b] + q[1] * constant[b];
      f.b[b][1][j] = m[1] * alpha - q[0] * g[b];
      f.b[b][2][j] = q[1] * aTimes[b];
      f.k[b][0][j] = m[2] * pDotL[b];
      f.k[b][1][j] = -q[2] * aTimes[b];
      f.k[b][2][j] = m[2] * alpha;
      for (int c = 0; c < 3; ++c) sum += f.a[b][c][j] * f.a[b][c][j] + f.b[b][c][j] * f.b[b][c][j] + f.k[b][c][j] * f.k[b][c][j];
    }
    const double rounding = 1e-13 * (1 + n.centre[j].norm() + n.origin.norm() / n.length);
    if (!(sum > rounding * rounding)) return false;
    const double scale = 1 / std::sqrt(sum);
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c) {
        f.a[b][c][j] *= scale;
        f.b[b][c][j] *= scale;
        f.k[b][c][j] *= scale;
      }
  }
  return true;
}

// X_query = rotation X + translation in the normalized frame; f in units of the image scale.
struct NormalizedPose {
  Matrix3d rotation;
  Vector3d translation;
  double focalLength;
};

bool makePose(const NormalizedProblem& n, double e, double cosPsi, double sinPsi, double d, NormalizedPose& pose) {
  const double d4 = d + e;
  const Vector2d l = n.p4 * d4 - n.p5 * d;
  const double length = l.norm(), s = std::sqrt((1 - e) * (1 + e));
  // a query centre in one of the points makes its equation hold trivially
  const double smallest = 1e-9 * (1 + std::abs(d));
  if (!(d > smallest) || !(d4 > smallest) || !(s > 0)) return false;
  pose.focalLength = length / s;
  if (!(pose.focalLength > 1e-6)) return false;
  const std::complex<double> turn(cosPsi, sinPsi), along(l[0] / length, l[1] / length), i(0, 1);
  const std::complex<double> sum = turn * along * (1 - e), difference = -turn * std::conj(along) * (1 + e);
  const std::complex<double> o1 = (sum + difference) / 2.0, o2 = (sum - difference) / (2.0 * i), o3 = s * turn;
  pose.rotation << o1.real(), o1.imag(), s * along.real(),  //
      o2.real(), o2.imag(), s * along.imag(),               //
      o3.real(), o3.imag(), e;
  pose.translation = d * Vector3d(n.p5[0] / pose.focalLength, n.p5[1] / pose.focalLength, 1);
  return true;
}

// Does the pose satisfy the original equation of every ray, with positive depths? A query centre on a ray makes that ray's
// equation hold trivially and is no solution: with all rays from one centre there are such poses, fixed by the two points alone.
bool fitsRays(const NormalizedProblem& n, const NormalizedPose& pose) {
  constexpr double kTolerance = 1e-8;  // distance from the epipolar line, in units of the image scale
  for (int j = 0; j < 3; ++j) {
    const Vector3d baseline = pose.rotation * n.centre[j] + pose.translation;
    const Vector3d ray = pose.rotation * n.direction[j];
    const Vector3d view(n.p[j][0] / pose.focalLength, n.p[j][1] / pose.focalLength, 1);
    const Vector3d line = baseline.cross(ray), normal = ray.cross(view);
    if (!(baseline.norm() > 1e-6) || !(line.norm() > 1e-7 * baseline.norm())) return false;
    if (!(pose.focalLength * std::abs(view.dot(line)) < kTolerance * line.head<2>().norm())) return false;
    const double beta = -baseline.cross(view).dot(normal), depth = -line.dot(normal);
    if (!(beta > 0) || !(depth > 0)) return false;
  }
  return true;
}

// Fills up to a whole number of SIMD vectors.
void pad(int count, double* values) {
  for (int i = count; i % 8 != 0; ++i) values[i] = values[i - 1];
}

// Newton's method strives for a step of 1e-9; next to e = +-1 rounding may keep it from getting there. Whether a candidate is a
// solution is decided by the original equations.
bool isConverged(const Candidates& candidates, int i) { return candidates.step[i] < 1e-7; }

// From the roots to solutions of the three equations. A candidate that Newton's method has carried away started from an
// inaccurate root (there is another one close to it, or e is close to +-1): it tries again from an accurate one.
void solveForPose(const Forms& elimination, const Forms& exact, const Kernel& kernel, int count, Candidates& candidates) {
  double roots[kBatch];
  std::copy(candidates.e, candidates.e + count, roots);
  kernel.nullVectors(elimination, count, candidates);
  kernel.newton(exact, count, candidates);
  Candidates again;
  int where[kBatch], againCount = 0;
  for (int i = 0; i < count; ++i)
    if (!isConverged(candidates, i) || !(std::abs(candidates.e[i] - roots[i]) < 1e-6)) {
      where[againCount] = i;
      again.e[againCount++] = roots[i];
    }
  if (againCount == 0) return;
  pad(againCount, again.e);
  kernel.polishRoots(elimination, againCount, again.e);
  kernel.nullVectors(elimination, againCount, again);
  kernel.newton(exact, againCount, again);
  for (int k = 0; k < againCount; ++k) {
    const int i = where[k];
    candidates.e[i] = again.e[k];
    candidates.d[i] = again.d[k];
    candidates.step[i] = again.step[k];
    candidates.cosPsi[i] = again.cosPsi[k];
    candidates.sinPsi[i] = again.sinPsi[k];
  }
}

bool isSame(const Candidates& c, int i, int k) {
  constexpr double kEqual = 1e-7;
  return std::abs(c.e[i] - c.e[k]) < kEqual && std::abs(c.cosPsi[i] - c.cosPsi[k]) < kEqual &&
         std::abs(c.sinPsi[i] - c.sinPsi[k]) < kEqual && std::abs(c.d[i] - c.d[k]) < kEqual * (1 + std::abs(c.d[i]));
}

// p4 = 0 makes d5 = 0, and p4 = p5 makes d5 = infinity, a common root of the three equations for every e, so that the resultant
// vanishes although the problem is well posed. A point next to p4 then serves for the elimination, and Newton's method leads from
// its solutions to those of p4.
Vector2d imagePointForElimination(const NormalizedProblem& n) {
  const Vector2d sideways(-n.p5[1], n.p5[0]);
  if (n.p4.norm() < 1e-6) return n.p4 + 1e-5 * sideways;
  if ((n.p4 - n.p5).norm() < 1e-6) return n.p4 + 3e-4 * sideways;
  return n.p4;
}

}  // namespace

int solve(const RayMatch* rays, const PointMatch* points, const Kernel& kernel, FocalPose* solutions) {
  constexpr int kMaxPoses = 26;
  NormalizedProblem n;
  if (!normalize(rays, points, n)) return 0;
  Forms exact, moved;
  if (!makeForms(n, n.p4, exact)) return 0;
  const Vector2d p4 = imagePointForElimination(n);
  const bool isMoved = p4 != n.p4;
  if (isMoved && !makeForms(n, p4, moved)) return 0;
  const Forms& elimination = isMoved ? moved : exact;
  Candidates candidates;
  const int count = hiddenRoots(elimination, kernel, candidates.e);
  if (count == 0) return 0;
  pad(count, candidates.e);
  solveForPose(elimination, exact, kernel, count, candidates);

  int found = 0;
  int accepted[kMaxPoses];
  for (int i = 0; i < count && found < kMaxPoses; ++i) {
    NormalizedPose pose;
    if (!isConverged(candidates, i)) continue;
    if (!makePose(n, candidates.e[i], candidates.cosPsi[i], candidates.sinPsi[i], candidates.d[i], pose)) continue;
    if (!fitsRays(n, pose)) continue;
    if (std::any_of(accepted, accepted + found, [&](int k) { return isSame(candidates, i, k); })) continue;
    accepted[found] = i;
    FocalPose& solution = solutions[found++];
    solution.rotation = n.axes * pose.rotation.transpose();
    solution.position = n.origin - n.length * (solution.rotation * pose.translation);
    solution.focalLength = n.imageScale * pose.focalLength;
  }
  return found;
}

int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  return solve(rays, points, kernel(), solutions);
}

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv

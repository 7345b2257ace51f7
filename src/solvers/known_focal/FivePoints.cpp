#include "solvers/known_focal/FivePoints.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "math/roots/BinaryFormRoots.hpp"
#include "solvers/known_focal/Bearing.hpp"
#include "solvers/known_focal/EssentialForm.hpp"
#include "solvers/known_focal/RayInFront.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using math::Pair;
using Roots = math::BinaryFormRoots<EssentialForm::kDegree>;

// With little parallax the matrices nearly contain the plane {[t]x R} of a pure rotation R, which every line z = w = 0 of the basis
// meets, and the elimination loses digits. Where a pivot is smaller than this, other bases of the same matrices are tried too.
constexpr double kWeakPivot = 1e-3;
constexpr int kBases = 3;
// Orthogonal matrices: each row makes one matrix of the basis.
constexpr double kBasisChange[kBases][4][4] = {
    {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}},
    {{0.5, 0.5, 0.5, 0.5}, {0.5, -0.5, 0.5, -0.5}, {0.5, 0.5, -0.5, -0.5}, {0.5, -0.5, -0.5, 0.5}},
    {{0.36, -0.48, -0.64, -0.48}, {0.48, 0.36, -0.48, 0.64}, {0.64, 0.48, 0.36, -0.48}, {0.48, -0.64, 0.48, 0.36}}};
constexpr double kSame = 1e-7;  // motions that differ by less are one

void changeBasis(const PaddedMatrix (&from)[4], const double (&change)[4][4], PaddedMatrix (&to)[4]) {
  for (int n = 0; n < 4; ++n)
    for (int p = 0; p < PaddedMatrix::kPairs; ++p) {
      to[n].e[p] = Pair{0, 0};
      for (int k = 0; k < 4; ++k) to[n].e[p] += change[n][k] * from[k].e[p];
    }
}

Matrix3d combination(const PaddedMatrix (&basis)[4], const double (&factors)[4]) {
  Matrix3d result;
  for (int i = 0; i < 9; ++i)
    result(i / 3, i % 3) =
        factors[0] * basis[0][i] + factors[1] * basis[1][i] + factors[2] * basis[2][i] + factors[3] * basis[3][i];
  return result;
}

Matrix3d crossMatrix(const Vector3d& v) {
  Matrix3d result;
  result << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return result;
}

Matrix3d cofactors(const Matrix3d& E) {
  Matrix3d result;
  for (int i = 0; i < 3; ++i) result.row(i) = Vector3d(E.row((i + 1) % 3)).cross(Vector3d(E.row((i + 2) % 3)));
  return result;
}

// The right null vector of a matrix of rank 2, to which every row of its cofactors is parallel.
Vector3d nullVector(const Matrix3d& cofactors) {
  int largest = 0;
  for (int i = 1; i < 3; ++i)
    if (cofactors.row(i).squaredNorm() > cofactors.row(largest).squaredNorm()) largest = i;
  return cofactors.row(largest).normalized();
}

void orthonormalize(Matrix3d& R) {
  Vector3d first = R.row(0), second = R.row(1);
  first.normalize();
  second = (second - first.dot(second) * first).normalized();
  R.row(0) = first;
  R.row(1) = second;
  R.row(2) = first.cross(second);
}

}  // namespace

FivePoints::FivePoints(const RayMatch* rays) : rays_(rays), imageScale_(0) {
  PaddedMatrix rows[kRays], basis[4], changed[4];
  for (int i = 0; i < kRays; ++i) {
    const Vector3d &v = bearings_[i] = bearingOf(rays[i].u, rays[i].v), &q = rays[i].direction;
    imageScale_ = std::max({imageScale_, std::abs(rays[i].u), std::abs(rays[i].v)});
    rows[i] = outerProduct({v[0], v[1], v[2]}, {q[0], q[1], q[2]});
  }
  if (!nullSpace(rows, basis)) return;
  for (const auto& change : kBasisChange) {
    EssentialForm form;
    changeBasis(basis, change, changed);
    if (form.set(changed)) {
      math::Direction roots[Roots::kMaxRoots];
      const int count = Roots::findSampled(
          [&](const double* c, const double* s, double* p) {
            for (int j = 0; j < Roots::kPadded; j += 2)
              math::store(p + j, form.value(math::load<Pair>(c + j), math::load<Pair>(s + j)));
          },
          roots);
      for (int i = 0; i < count; ++i) {
        double coordinates[4];
        form.coordinates(roots[i].c, roots[i].s, coordinates);
        addMotionsOf(combination(changed, coordinates));
      }
    }
    if (form.leastPivot() > kWeakPivot) return;
  }
}

// R = cof(E) - E [b]x with E b = 0 and |E|^2 = 2, t = R b; the other rotation is (2 t t^T - I) R = 2 t b^T - R.
void FivePoints::addMotionsOf(const Matrix3d& matrix) {
  const double norm = matrix.norm();
  if (!(norm > 0) || !std::isfinite(norm)) return;
  const Matrix3d E = std::sqrt(2.) / norm * matrix;
  Matrix3d R = cofactors(E);
  const Vector3d b = nullVector(R);
  for (int i = 0; i < 3; ++i) R.row(i) -= Vector3d(E.row(i)).cross(b);
  const Vector3d t = R * b;
  addInFront(R, t);
  addInFront(2 * t * b.transpose() - R, t);
}

// Adds the motion by t or by -t, if all rays meet in front for one of them.
void FivePoints::addInFront(const Matrix3d& R, const Vector3d& t) {
  int side = 0;
  for (int i = 0; i < kRays; ++i) {
    const int sideOfRay = meetingSide(rays_[i].u, rays_[i].v, 1, R * rays_[i].direction, t);
    if (sideOfRay == 0 || sideOfRay == -side) return;
    side = sideOfRay;
  }
  add({R, side * t});
}

void FivePoints::add(Motion motion) {
  orthonormalize(motion.R);
  if (!refine(motion) || !areInFront(motion) || count_ == kMaxMotions) return;
  for (const Motion& known : *this)
    if ((known.R - motion.R).norm() < kSame && (known.t - motion.t).norm() < kSame) return;
  motions_[count_++] = motion;
}

bool FivePoints::areInFront(const Motion& motion) const {
  return std::all_of(rays_, rays_ + kRays,
                     [&](const RayMatch& ray) { return isMetInFront(ray, motion.t, motion.R * ray.direction, imageScale_); });
}

// Newton's method for a turn of R and two tangents of t.
bool FivePoints::refine(Motion& motion) const {
  constexpr int kSteps = 20;
  for (int step = 0; step < kSteps; ++step) {
    const Vector3d u1 = motion.t.unitOrthogonal(), u2 = motion.t.cross(u1);
    Eigen::Matrix<double, kRays, kRays> J;
    Eigen::Matrix<double, kRays, 1> F;
    for (int i = 0; i < kRays; ++i) {
      const Vector3d a = motion.R * rays_[i].direction, vt = bearings_[i].cross(motion.t), av = a.cross(bearings_[i]);
      J.row(i) << a.cross(vt).transpose(), av.dot(u1), av.dot(u2);
      F[i] = vt.dot(a);
    }
    const Eigen::Matrix<double, kRays, 1> change = -J.partialPivLu().solve(F);
    const double size = change.norm();
    if (!(size < 1)) return false;
    // Cayley's rotation by the vector: a + 2 (w x a + w x (w x a)) / (1 + w.w), w half of it.
    const Vector3d w = change.head<3>() / 2;
    const Matrix3d W = crossMatrix(w);
    motion.R += 2 / (1 + w.squaredNorm()) * (W * motion.R + W * (W * motion.R));
    motion.t = (motion.t + change[3] * u1 + change[4] * u2).normalized();
    if (size < 1e-8) break;
  }
  orthonormalize(motion.R);
  return true;
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

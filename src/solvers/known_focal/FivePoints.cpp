#include "solvers/known_focal/FivePoints.hpp"

#include <Eigen/Geometry>
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
constexpr int kOtherBases = 2;
// Orthogonal matrices: each row makes one matrix of the basis.
constexpr double kBasisChange[kOtherBases][4][4] = {
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

// Five linear equations in five unknowns, a row each with its right side.
class FiveEquations {
 public:
  void set(int i, const Vector3d& first, double fourth, double fifth, double right) {
    row_[i][0] = Pair{first[0], first[1]};
    row_[i][1] = Pair{first[2], fourth};
    row_[i][2] = Pair{fifth, right};
  }

  // Gauss elimination with row pivots. Not finite if the equations are dependent.
  void solve(double (&x)[5]) {
    eliminateFrom<0>();
    for (int i = 4; i >= 0; --i) {
      double sum = at(i, 5);
      for (int k = i + 1; k < 5; ++k) sum -= at(i, k) * x[k];
      x[i] = sum;
    }
  }

 private:
  double at(int r, int column) const { return row_[r][column / 2][column % 2]; }

  // Afterwards the diagonal is 1, and what is below it no longer counts.
  template <int Column>
  void eliminateFrom() {
    int pivot = Column;
    for (int r = Column + 1; r < 5; ++r)
      if (std::abs(at(r, Column)) > std::abs(at(pivot, Column))) pivot = r;
    const double inverse = 1 / at(pivot, Column);
    for (int p = Column / 2; p < 3; ++p) {
      const Pair normalized = inverse * row_[pivot][p];
      row_[pivot][p] = row_[Column][p];
      row_[Column][p] = normalized;
    }
    for (int r = Column + 1; r < 5; ++r) {
      const double factor = at(r, Column);
      for (int p = Column / 2; p < 3; ++p) row_[r][p] -= factor * row_[Column][p];
    }
    if constexpr (Column < 4) eliminateFrom<Column + 1>();
  }

  Pair row_[5][3];
};

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
  if (addMotionsOf(basis) > kWeakPivot) return;
  for (const auto& change : kBasisChange) {
    changeBasis(basis, change, changed);
    if (addMotionsOf(changed) > kWeakPivot) return;
  }
}

double FivePoints::addMotionsOf(const PaddedMatrix (&basis)[4]) {
  EssentialForm form;
  if (!form.set(basis)) return 0;
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
    addMotionsOf(combination(basis, coordinates));
  }
  return form.leastPivot();
}

// R = cof(E) - E [b]x with E b = 0 and |E|^2 = 2, t = R b; the other rotation is (2 t t^T - I) R = 2 t b^T - R. The first ray tells
// which of them can have it in front.
void FivePoints::addMotionsOf(const Matrix3d& matrix) {
  const double norm = matrix.norm();
  if (!(norm > 0) || !std::isfinite(norm)) return;
  const Matrix3d E = std::sqrt(2.) / norm * matrix;
  Matrix3d R = cofactors(E);
  const Vector3d b = nullVector(R);
  for (int i = 0; i < 3; ++i) R.row(i) -= Vector3d(E.row(i)).cross(b);
  const Vector3d t = R * b;
  const Vector3d p(rays_[0].u, rays_[0].v, 1), a = R * rays_[0].direction, pt = p.cross(t), at = a.cross(t), n = p.cross(a);
  // n.pt and n.at (meetingSide) of R, and of the other rotation, for which a is 2 (b.q) t - a.
  const double npt = n.dot(pt), nat = n.dot(at), twice = 2 * b.dot(rays_[0].direction);
  const double otherNpt = twice * pt.squaredNorm() - npt, otherNat = nat - twice * pt.dot(at);
  if ((npt > 0) == (nat > 0)) addInFront(R, t);
  if ((otherNpt > 0) == (otherNat > 0)) addInFront(2 * t * b.transpose() - R, t);
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
  return std::all_of(rays_, rays_ + kRays, [&](const RayMatch& ray) {
    const Vector3d a = motion.R * ray.direction;
    return isOnLine(ray, motion.t, a, imageScale_) && meetInFront(ray.u, ray.v, 1, a, motion.t);
  });
}

// Newton's method for a turn of R and two tangents of t.
bool FivePoints::refine(Motion& motion) const {
  constexpr int kSteps = 20;
  for (int step = 0; step < kSteps; ++step) {
    const Vector3d u1 = motion.t.unitOrthogonal(), u2 = motion.t.cross(u1);
    FiveEquations equations;
    for (int i = 0; i < kRays; ++i) {
      const Vector3d a = motion.R * rays_[i].direction, vt = bearings_[i].cross(motion.t), av = a.cross(bearings_[i]);
      equations.set(i, a.cross(vt), av.dot(u1), av.dot(u2), -vt.dot(a));
    }
    double change[kRays];
    equations.solve(change);
    const Vector3d turn(change[0], change[1], change[2]);
    const double size2 = turn.squaredNorm() + change[3] * change[3] + change[4] * change[4];
    if (!(size2 < 1)) return false;
    // Cayley's rotation by the vector: a + 2 (w x a + w x (w x a)) / (1 + w.w), w half of it.
    const Vector3d w = turn / 2;
    const Matrix3d W = crossMatrix(w), WR = W * motion.R;
    motion.R += 2 / (1 + w.squaredNorm()) * (WR + W * WR);
    motion.t = (motion.t + change[3] * u1 + change[4] * u2).normalized();
    if (size2 < 1e-16) break;
  }
  return true;
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

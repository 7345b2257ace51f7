#include "solvers/OneFocalFundamental.hpp"

#include <algorithm>
#include <cmath>

#include "math/BinaryFormRoots.hpp"
#include "math/Vec3.hpp"

namespace hybridgv {
namespace solvers {
namespace {

using math::Pair;
using math::Vec3;
using Vector = Vec3<double>;

constexpr int kPadded = 10;  // 9 entries of F, and a zero so that loops run over pairs

// A constraint is dependent on the others where what is left of its unit row is below this.
constexpr double kDependent = 1e-12;
// Largest |det| of unit matrices of the pencil below which all of them count as singular.
constexpr double kSingularPencil = 1e-9;

double dot(const double* a, const double* b) {
  Pair sum = math::loadPair(a) * math::loadPair(b);
  for (int i = 2; i < kPadded; i += 2) sum += math::loadPair(a + i) * math::loadPair(b + i);
  return sum[0] + sum[1];
}

void addMultiple(double* a, double factor, const double* b) {
  for (int i = 0; i < kPadded; i += 2) math::storePair(a + i, math::loadPair(a + i) + factor * math::loadPair(b + i));
}

// Orthonormal basis of the F with p_k^T F q_k = 0, by Householder reflections of the six rows p_k (x) q_k of unit length.
bool nullSpace(const SixCorrespondences& data, double (*basis)[kPadded]) {
  double row[kSix][kPadded];
  for (int k = 0; k < kSix; ++k) {
    const double u = data.u[k], v = data.v[k];
    const double scale = 1 / std::sqrt(u * u + v * v + 1);
    for (int i = 0; i < 3; ++i) {
      const double q = scale * data.direction[k][i];
      row[k][i] = u * q, row[k][3 + i] = v * q, row[k][6 + i] = q;
    }
    row[k][9] = 0;
  }
  double factor[kSix];  // reflection k: I - factor w w^T, w = row[k] from entry k on
  for (int k = 0; k < kSix; ++k) {
    double* w = row[k];
    for (int i = 0; i < k; ++i) w[i] = 0;
    const double length = std::sqrt(dot(w, w));
    if (!(length > kDependent)) return false;
    const double head = std::abs(w[k]);
    w[k] += std::copysign(length, w[k]);
    factor[k] = 1 / (length * (length + head));
    for (int l = k + 1; l < kSix; ++l) addMultiple(row[l], -factor[k] * dot(w, row[l]), w);
  }
  for (int n = 0; n < 3; ++n) {
    for (int i = 0; i < kPadded; ++i) basis[n][i] = i == 6 + n;
    for (int k = kSix - 1; k >= 0; --k) addMultiple(basis[n], -factor[k] * dot(row[k], basis[n]), row[k]);
  }
  return true;
}

struct Matrix {
  Vector f1, f2, f3;  // rows
};

Matrix rows(const double* entries) {
  return {{entries[0], entries[1], entries[2]}, {entries[3], entries[4], entries[5]}, {entries[6], entries[7], entries[8]}};
}

// cof(A), the gradient of the determinant.
Matrix cofactors(const Matrix& a) { return {cross(a.f2, a.f3), cross(a.f3, a.f1), cross(a.f1, a.f2)}; }
double dot(const Matrix& a, const Matrix& b) { return dot(a.f1, b.f1) + dot(a.f2, b.f2) + dot(a.f3, b.f3); }

// The coefficients of det(x B0 + y B1 + w B2).
struct DeterminantCubic {
  double xxx, yyy, www, xxy, xxw, xyy, yyw, xww, yww, xyw;

  explicit DeterminantCubic(const double (*basis)[kPadded]) {
    const Matrix b0 = rows(basis[0]), b1 = rows(basis[1]), b2 = rows(basis[2]);
    const Matrix c0 = cofactors(b0), c1 = cofactors(b1), c2 = cofactors(b2);
    xxx = dot(b0.f1, c0.f1), yyy = dot(b1.f1, c1.f1), www = dot(b2.f1, c2.f1);
    xxy = dot(c0, b1), xxw = dot(c0, b2), xyy = dot(c1, b0), yyw = dot(c1, b2), xww = dot(c2, b0), yww = dot(c2, b1);
    const Matrix mixed{cross(b0.f2, b1.f3) + cross(b1.f2, b0.f3), cross(b0.f3, b1.f1) + cross(b1.f3, b0.f1),
                       cross(b0.f1, b1.f2) + cross(b1.f1, b0.f2)};
    xyw = dot(mixed, b2);
  }
  double operator()(double x, double y, double w) const {
    return x * (x * (xxx * x + xxy * y + xxw * w) + y * (xyy * y + xyw * w) + xww * w * w) + y * y * (yyy * y + yyw * w) +
           w * w * (yww * y + www * w);
  }
};

// Directions to the faces, edges and corners of a cube, one of each opposite pair.
constexpr double kEdge = 0.70710678118654752, kCorner = 0.57735026918962576;
constexpr double kDirections[][3] = {{1, 0, 0},
                                     {0, 1, 0},
                                     {0, 0, 1},
                                     {kEdge, kEdge, 0},
                                     {kEdge, -kEdge, 0},
                                     {kEdge, 0, kEdge},
                                     {kEdge, 0, -kEdge},
                                     {0, kEdge, kEdge},
                                     {0, kEdge, -kEdge},
                                     {kCorner, kCorner, kCorner},
                                     {kCorner, kCorner, -kCorner},
                                     {kCorner, -kCorner, kCorner},
                                     {kCorner, -kCorner, -kCorner}};

// F = x B0 + c B1 + s B2 with det B0 far from 0.
class Pencil {
 public:
  // False if every matrix of the pencil is singular.
  bool build(const SixCorrespondences& data, int attempt) {
    double basis[3][kPadded];
    if (!nullSpace(data, basis)) return false;
    if (!chooseB0(basis, attempt)) return false;
    v2_ = cross(b_.f1, b_.f3), w2_ = cross(b_.f2, b_.f3);
    d2_ = dot(b_.f1, b_.f3), e2_ = dot(b_.f2, b_.f3);
    q4_ = d2_ * v2_ + e2_ * w2_;
    inverseDeterminant_ = 1 / dot(b_.f1, w2_);
    return true;
  }

  // The columns of M(c, s): x^2 r2 + x r1 + r0 = Q modulo det F.
  template <class T>
  struct Quadratics {
    Vec3<T> r2, r1, r0;
  };
  template <class T>
  Quadratics<T> quadratics(T c, T s) const {
    // coefficients of f1.f3 (d), f2.f3 (e), f1 x f3 (v), f2 x f3 (w) in x, the leading ones being constant
    const Vec3<T> g1 = c * y_.f1 + s * w_.f1, g2 = c * y_.f2 + s * w_.f2, g3 = c * y_.f3 + s * w_.f3;
    const T d1 = dot(b_.f1, g3) + dot(b_.f3, g1), d0 = dot(g1, g3);
    const T e1 = dot(b_.f2, g3) + dot(b_.f3, g2), e0 = dot(g2, g3);
    const Vec3<T> v1 = cross(b_.f1, g3) + cross(g1, b_.f3), v0 = cross(g1, g3);
    const Vec3<T> w1 = cross(b_.f2, g3) + cross(g2, b_.f3), w0 = cross(g2, g3);
    // Q = d v + e w
    const Vec3<T> q3 = d2_ * v1 + d1 * v2_ + (e2_ * w1 + e1 * w2_);
    const Vec3<T> q2 = d2_ * v0 + d1 * v1 + d0 * v2_ + (e2_ * w0 + e1 * w1 + e0 * w2_);
    const Vec3<T> q1 = d1 * v0 + d0 * v1 + (e1 * w0 + e0 * w1);
    const Vec3<T> q0 = d0 * v0 + e0 * w0;
    // det F / det B0 = x^3 + k2 x^2 + k1 x + k0
    const T k2 = inverseDeterminant_ * (dot(b_.f1, w1) + dot(g1, w2_));
    const T k1 = inverseDeterminant_ * (dot(b_.f1, w0) + dot(g1, w1));
    const T k0 = inverseDeterminant_ * dot(g1, w0);
    // x^3 = -k2 x^2 - k1 x - k0,  x^4 = (k2^2 - k1) x^2 + (k2 k1 - k0) x + k2 k0
    return {q2 - k2 * q3 + (k2 * k2 - k1) * q4_, q1 - k1 * q3 + (k2 * k1 - k0) * q4_, q0 - k0 * q3 + (k2 * k0) * q4_};
  }
  template <class T>
  T form(T c, T s) const {
    const Quadratics<T> m = quadratics(c, s);
    return dot(m.r2, cross(m.r1, m.r0));
  }

  // x at a root of the form, where r2, r1, r0 lie in a plane: (x^2, x, 1) ~ (r1 x r0, r0 x r2, r2 x r1).
  double thirdCoordinate(double c, double s) const {
    const Quadratics<double> m = quadratics(c, s);
    const Vector a = cross(m.r1, m.r0), b = cross(m.r0, m.r2), d = cross(m.r2, m.r1);
    const double aa = dot(a, a), bb = dot(b, b), dd = dot(d, d);
    const Vector& normal = aa > bb ? (aa > dd ? a : d) : (bb > dd ? b : d);
    return dot(b, normal) / dot(d, normal);
  }

  // The direction (c : s) of the matrix whose third row is 0, if there is one.
  math::Direction withoutThirdRow() const {
    // x b3 + c y3 + s w3 = 0 with coplanar b3, y3, w3
    const Vector a = cross(y_.f3, w_.f3), b = cross(w_.f3, b_.f3), d = cross(b_.f3, y_.f3);
    const double aa = dot(a, a), bb = dot(b, b), dd = dot(d, d);
    const Vector& normal = aa > bb ? (aa > dd ? a : d) : (bb > dd ? b : d);
    const double c = dot(b, normal), s = dot(d, normal), length = std::sqrt(c * c + s * s);
    return {c / length, s / length};
  }

  Matrix at(double x, double c, double s) const {
    return {x * b_.f1 + c * y_.f1 + s * w_.f1, x * b_.f2 + c * y_.f2 + s * w_.f2, x * b_.f3 + c * y_.f3 + s * w_.f3};
  }
  const Matrix& b0() const { return b_; }
  // dF/dpsi
  Matrix turned(double c, double s) const { return {c * w_.f1 - s * y_.f1, c * w_.f2 - s * y_.f2, c * w_.f3 - s * y_.f3}; }

 private:
  bool chooseB0(const double (*basis)[kPadded], int attempt) {
    const DeterminantCubic determinant(basis);
    double value[13];
    for (int i = 0; i < 13; ++i) value[i] = std::abs(determinant(kDirections[i][0], kDirections[i][1], kDirections[i][2]));
    int best = static_cast<int>(std::max_element(value, value + 13) - value);
    if (!(value[best] > kSingularPencil)) return false;
    for (; attempt > 0; --attempt) {
      value[best] = 0;
      best = static_cast<int>(std::max_element(value, value + 13) - value);
    }
    // Reflection that exchanges the first axis and the direction: its rows are an orthonormal basis that begins with +-direction.
    const double* n = kDirections[best];
    const double w[3] = {n[0] + std::copysign(1.0, n[0]), n[1], n[2]};
    const double factor = 1 / (1 + std::abs(n[0]));
    double rotated[3][kPadded];
    for (int i = 0; i < 3; ++i) {
      double coordinates[3];
      for (int j = 0; j < 3; ++j) coordinates[j] = (i == j) - factor * w[i] * w[j];
      std::fill(rotated[i], rotated[i] + kPadded, 0.0);
      for (int j = 0; j < 3; ++j) addMultiple(rotated[i], coordinates[j], basis[j]);
    }
    b_ = rows(rotated[0]), y_ = rows(rotated[1]), w_ = rows(rotated[2]);
    return true;
  }

  Matrix b_, y_, w_;
  Vector v2_, w2_, q4_;
  double d2_, e2_, inverseDeterminant_;
};

// Roots of the form; with a principal point among the image points the form is divided by the square of its known factor.
int rootDirections(const Pencil& pencil, const SixCorrespondences& data, math::Direction* roots) {
  using Roots = math::BinaryFormRoots<9>;
  using Deflated = math::BinaryFormRoots<7>;
  constexpr double kAtPrincipalPoint = 1e-12;
  const auto sampler = [&](int count) {
    return [&pencil, count](const double* c, const double* s, double* p) {
      for (int j = 0; j < count; j += 2) math::storePair(p + j, pencil.form(math::loadPair(c + j), math::loadPair(s + j)));
    };
  };
  for (int k = 0; k < kSix; ++k) {
    if (std::abs(data.u[k]) > kAtPrincipalPoint || std::abs(data.v[k]) > kAtPrincipalPoint) continue;
    const math::Direction known = pencil.withoutThirdRow();
    const auto sample = sampler(Deflated::kPadded);
    return Deflated::findSampled(
        [&](const double* c, const double* s, double* p) {
          sample(c, s, p);
          for (int j = 0; j < Deflated::kPadded; ++j) {
            const double factor = c[j] * known.s - s[j] * known.c;
            p[j] /= factor * factor;
          }
        },
        roots);
  }
  return Roots::findSampled(sampler(Roots::kPadded), roots);
}

double component(const Vector& a, int j) { return j == 0 ? a.x : j == 1 ? a.y : a.z; }

// Newton's iteration in (x, psi) on det F = 0 and that Q_j = 0 whose cross products are largest: on det F = 0 both are parallel
// to the null vector of F, so that the other Q_j vanish with it.
bool refine(const Pencil& pencil, double& x, double& c, double& s) {
  double last = 1;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Matrix f = pencil.at(x, c, s), g = pencil.turned(c, s);
    const Matrix& b = pencil.b0();
    const Vector v = cross(f.f1, f.f3), w = cross(f.f2, f.f3);
    const double sizes[3] = {v.x * v.x + w.x * w.x, v.y * v.y + w.y * w.y, v.z * v.z + w.z * w.z};
    const int j = static_cast<int>(std::max_element(sizes, sizes + 3) - sizes);
    const Matrix cofactor{w, {-v.x, -v.y, -v.z}, cross(f.f1, f.f2)};
    const double det = dot(f.f1, w), detX = dot(cofactor, b), detPsi = dot(cofactor, g);
    const double d = dot(f.f1, f.f3), e = dot(f.f2, f.f3);
    const auto slope = [&](const Matrix& h) {  // dQ_j in direction h
      return (dot(h.f1, f.f3) + dot(f.f1, h.f3)) * component(v, j) + d * component(cross(h.f1, f.f3) + cross(f.f1, h.f3), j) +
             (dot(h.f2, f.f3) + dot(f.f2, h.f3)) * component(w, j) + e * component(cross(h.f2, f.f3) + cross(f.f2, h.f3), j);
    };
    const double q = d * component(v, j) + e * component(w, j), qX = slope(b), qPsi = slope(g);
    const double inverse = 1 / (detX * qPsi - detPsi * qX);
    const double dx = inverse * (q * detPsi - det * qPsi), dpsi = inverse * (det * qX - q * detX);
    if (!(std::abs(dpsi) < 1) || !std::isfinite(dx)) return false;
    x += dx;
    const double length = 1 / std::sqrt(1 + dpsi * dpsi);
    const double turnedC = (c - dpsi * s) * length;
    s = (s + dpsi * c) * length, c = turnedC;
    const double step = std::abs(dx) / (1 + std::abs(x)) + std::abs(dpsi);
    if (step < 1e-9 || (step < 1e-7 && step >= last)) return true;
    last = step;
  }
  return false;
}

Eigen::Vector3d toEigen(const Vector& a) { return {a.x, a.y, a.z}; }

// f from  |f3|^4 = f^2 (|f1 x f3|^2 + |f2 x f3|^2 - (f1.f3)^2 - (f2.f3)^2), then E = diag(f, f, 1) F of squared norm 2, b its
// unit right null vector, R = cof(E) - E [b]x.
bool decompose(const Matrix& f, OneFocalMotion& motion) {
  constexpr double kLeastFocalLength = 1e-4;  // of the largest image coordinate; what lies below belongs to f = 0
  const Vector v = cross(f.f1, f.f3), w = cross(f.f2, f.f3);
  const double d = dot(f.f1, f.f3), e = dot(f.f2, f.f3), ff = dot(f.f3, f.f3);
  const double denominator = dot(v, v) + dot(w, w) - d * d - e * e;
  if (!(denominator > 0)) return false;
  const double focal = ff / std::sqrt(denominator);
  if (!(focal > kLeastFocalLength)) return false;
  const double scale = std::sqrt(2 / (focal * focal * (dot(f.f1, f.f1) + dot(f.f2, f.f2)) + ff));
  const Matrix E{(scale * focal) * f.f1, (scale * focal) * f.f2, scale * f.f3};
  const Matrix cof = cofactors(E);
  const double c1 = dot(cof.f1, cof.f1), c2 = dot(cof.f2, cof.f2), c3 = dot(cof.f3, cof.f3);
  const Vector& largest = c1 > c2 ? (c1 > c3 ? cof.f1 : cof.f3) : (c2 > c3 ? cof.f2 : cof.f3);
  const Vector b = (1 / std::sqrt(dot(largest, largest))) * largest;
  motion.focalLength = focal;
  motion.baseline = toEigen(b);
  motion.rotation.row(0) = toEigen(cof.f1 - cross(E.f1, b)).transpose();
  motion.rotation.row(1) = toEigen(cof.f2 - cross(E.f2, b)).transpose();
  motion.rotation.row(2) = toEigen(cof.f3 - cross(E.f3, b)).transpose();
  motion.baselineInQuery = motion.rotation * motion.baseline;
  return motion.rotation.allFinite();
}

bool isNew(const OneFocalMotion& motion, const OneFocalMotion* motions, int count) {
  constexpr double kSame = 1e-7;
  for (int i = 0; i < count; ++i)
    if (std::abs(motion.focalLength / motions[i].focalLength - 1) < kSame &&
        ((motion.rotation - motions[i].rotation).squaredNorm() < kSame * kSame ||
         (motion.rotation - motions[i].otherRotation()).squaredNorm() < kSame * kSame))
      return false;
  return true;
}

}  // namespace

bool SixCorrespondences::normalise() {
  imageScale = 0;
  for (int k = 0; k < kSix; ++k) imageScale = std::max({imageScale, std::abs(u[k]), std::abs(v[k])});
  if (!(imageScale > 0)) return false;
  for (int k = 0; k < kSix; ++k) u[k] /= imageScale, v[k] /= imageScale;
  return true;
}

int oneFocalFundamental(const SixCorrespondences& correspondences, int attempt, OneFocalMotion* motions) {
  Pencil pencil;
  if (!pencil.build(correspondences, attempt)) return 0;
  math::Direction roots[math::BinaryFormRoots<9>::kMaxRoots];
  const int candidates = rootDirections(pencil, correspondences, roots);
  int count = 0;
  for (int i = 0; i < candidates; ++i) {
    double c = roots[i].c, s = roots[i].s, x = pencil.thirdCoordinate(c, s);
    OneFocalMotion motion;
    if (!refine(pencil, x, c, s) || !decompose(pencil.at(x, c, s), motion) || !isNew(motion, motions, count)) continue;
    // More than the equations' degree: they have a continuum of solutions.
    if (count == kMaxOneFocalMotions) return 0;
    motions[count++] = motion;
  }
  return count;
}

bool meetInFront(double u, double v, double f, const Eigen::Vector3d& a, const Eigen::Vector3d& T) {
  constexpr double kLeastAngle = 1e-10;  // of either ray with T [rad]
  const Vector p{u, v, f}, ray{a[0], a[1], a[2]}, t{T[0], T[1], T[2]};
  // n = p x a is normal to the epipolar plane;  kappa p x T = -beta n,  kappa a x T = -lambda n.
  const Vector n = cross(p, ray);
  const double beta = dot(n, cross(p, t)), lambda = dot(n, cross(ray, t));
  const double least = kLeastAngle * kLeastAngle * dot(n, n);
  return beta < 0 && lambda < 0 && beta * beta > least * dot(p, p) && lambda * lambda > least;
}

}  // namespace solvers
}  // namespace hybridgv

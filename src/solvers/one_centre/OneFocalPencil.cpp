#include "solvers/one_centre/OneFocalPencil.hpp"

#include <algorithm>

#include "solvers/one_centre/EpipolarNullSpace.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {
namespace {

using math::Vec3;

// Largest |det| of unit matrices of the pencil below which all of them count as singular. Six coplanar points give at most 4e-10
// (by rounding), points flattened to 1e-4 of their spread at least 3e-7.
constexpr double kSingularPencil = 1e-9;

Rows<double> toRows(const PaddedMatrix& a) { return {{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {a[6], a[7], a[8]}}; }

// The coefficients of det(x B0 + y B1 + w B2).
struct DeterminantCubic {
  double xxx, yyy, www, xxy, xxw, xyy, yyw, xww, yww, xyw;

  DeterminantCubic(const Rows<double>& b0, const Rows<double>& b1, const Rows<double>& b2) {
    const Rows<double> c0 = cofactors(b0), c1 = cofactors(b1), c2 = cofactors(b2);
    xxx = dot(b0.f1, c0.f1);
    yyy = dot(b1.f1, c1.f1);
    www = dot(b2.f1, c2.f1);
    xxy = dot(c0, b1);
    xxw = dot(c0, b2);
    xyy = dot(c1, b0);
    yyw = dot(c1, b2);
    xww = dot(c2, b0);
    yww = dot(c2, b1);
    const Rows<double> mixed{cross(b0.f2, b1.f3) + cross(b1.f2, b0.f3), cross(b0.f3, b1.f1) + cross(b1.f3, b0.f1),
                             cross(b0.f1, b1.f2) + cross(b1.f1, b0.f2)};
    xyw = dot(mixed, b2);
  }
  double operator()(double x, double y, double w) const {
    return x * (x * (xxx * x + xxy * y + xxw * w) + y * (xyy * y + xyw * w) + xww * w * w) + y * y * (yyy * y + yyw * w) +
           w * w * (yww * y + www * w);
  }
};

// Directions to the faces, edges and corners of a cube, one of each opposite pair.
constexpr int kDirectionCount = 13;
constexpr double kEdge = 0.70710678118654752, kCorner = 0.57735026918962576;
constexpr double kDirections[kDirectionCount][3] = {{1, 0, 0},
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

}  // namespace

bool OneFocalPencil::build(const SixCorrespondences& correspondences) {
  PaddedMatrix basis[3];
  if (!epipolarNullSpace(correspondences, basis)) return false;
  const Rows<double> n0 = toRows(basis[0]), n1 = toRows(basis[1]), n2 = toRows(basis[2]);
  const DeterminantCubic determinant(n0, n1, n2);
  double size[kDirectionCount];
  for (int i = 0; i < kDirectionCount; ++i)
    size[i] = std::abs(determinant(kDirections[i][0], kDirections[i][1], kDirections[i][2]));
  const double* best = std::max_element(size, size + kDirectionCount);
  if (!(*best > kSingularPencil)) return false;
  // The rows of the reflection that exchanges the first axis and the direction are an orthonormal basis beginning with it.
  const double* n = kDirections[best - size];
  const double wx = n[0] + std::copysign(1.0, n[0]), wy = n[1], wz = n[2];
  const double factor = 1 / (1 + std::abs(n[0]));
  const Rows<double> along = factor * (wx * n0 + wy * n1 + wz * n2);
  b_ = n0 + (-wx) * along;
  y_ = n1 + (-wy) * along;
  w_ = n2 + (-wz) * along;
  v2_ = cross(b_.f1, b_.f3);
  w2_ = cross(b_.f2, b_.f3);
  d2_ = dot(b_.f1, b_.f3);
  e2_ = dot(b_.f2, b_.f3);
  q4_ = d2_ * v2_ + e2_ * w2_;
  inverseDeterminant_ = 1 / dot(b_.f1, w2_);
  return true;
}

math::Direction OneFocalPencil::withoutThirdRow() const {
  // x b3 + c y3 + s w3 = 0 with coplanar b3, y3, w3:  (x, c, s) ~ (y3 x w3, w3 x b3, b3 x y3)
  const Vec3<double> a = cross(y_.f3, w_.f3), b = cross(w_.f3, b_.f3), d = cross(b_.f3, y_.f3);
  const Vec3<double>& normal = longest(a, b, d);
  const double c = dot(b, normal), s = dot(d, normal), length = std::sqrt(c * c + s * s);
  return {c / length, s / length};
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv

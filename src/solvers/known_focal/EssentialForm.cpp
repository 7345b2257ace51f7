#include "solvers/known_focal/EssentialForm.hpp"

#include <cstring>

#include "math/simd/versions.hpp"
#include "solvers/known_focal/EssentialKernel.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

using math::Pair;

HYBRIDGV_VERSIONS(EssentialKernel, kEssentialKernel)

const EssentialKernel& essentialKernel(math::SimdLevel level) {
  return math::choose(level, baseline::kEssentialKernel, avx2::kEssentialKernel, avx512::kEssentialKernel);
}

const EssentialKernel& essentialKernel() { return essentialKernel(math::simdLevel()); }

bool EssentialForm::set(const PaddedMatrix* basis) {
  EssentialBasis entries;
  static_assert(sizeof entries[0] == sizeof basis[0].e, "nine entries and a zero");
  for (int n = 0; n < 4; ++n) std::memcpy(entries[n], basis[n].e, sizeof entries[n]);
  ReducedCubics cubics;
  essentialKernel().reduce(entries, cubics);
  leastPivot_ = cubics.leastPivot;
  if (!(leastPivot_ > 0)) return false;
  for (int i = 0; i < 3; ++i) {
    const double(&A)[ReducedCubics::kColumns] = cubics.row[2 * i], (&B)[ReducedCubics::kColumns] = cubics.row[2 * i + 1];
    Equation& equation = equations_[i];
    for (int k = 0; k < 4; ++k) {
      equation.a[k] = (k > 0 ? A[k - 1] : 0) - (k < 3 ? B[k] : 0);
      equation.b[k] = (k > 0 ? A[k + 2] : 0) - (k < 3 ? B[k + 3] : 0);
    }
    for (int k = 0; k < 5; ++k) equation.c[k] = (k > 0 ? A[k + 5] : 0) - (k < 4 ? B[k + 6] : 0);
  }
  return true;
}

template <class T>
EssentialForm::Row<T> EssentialForm::row(int i, const T& z, const T& w) const {
  const Equation& e = equations_[i];
  const T zz = z * z, zw = z * w, ww = w * w;
  return {z * (zz * e.a[0] + zw * e.a[1] + ww * e.a[2]) + ww * w * e.a[3],
          z * (zz * e.b[0] + zw * e.b[1] + ww * e.b[2]) + ww * w * e.b[3],
          zz * (zz * e.c[0] + zw * e.c[1] + ww * e.c[2]) + ww * (zw * e.c[3] + ww * e.c[4])};
}

math::Pair EssentialForm::value(const math::Pair& z, const math::Pair& w) const {
  const Row<Pair> p = row(0, z, w), q = row(1, z, w), r = row(2, z, w);
  return p.a * (q.b * r.c - q.c * r.b) + p.b * (q.c * r.a - q.a * r.c) + p.c * (q.a * r.b - q.b * r.a);
}

// Of the three rows, which are dependent at a root, every two have the solution as their cross product.
void EssentialForm::coordinates(double z, double w, double (&result)[4]) const {
  const Row<double> rows[3] = {row(0, z, w), row(1, z, w), row(2, z, w)};
  double sum[3] = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const Row<double>&p = rows[i], &q = rows[(i + 1) % 3];
    const double n[3] = {p.b * q.c - p.c * q.b, p.c * q.a - p.a * q.c, p.a * q.b - p.b * q.a};
    const double sign = n[0] * sum[0] + n[1] * sum[1] + n[2] * sum[2] < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) sum[k] += sign * n[k];
  }
  result[0] = sum[0];
  result[1] = sum[1];
  result[2] = sum[2] * z;
  result[3] = sum[2] * w;
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

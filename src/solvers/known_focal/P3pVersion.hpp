// P3P for the instruction set of the including file.
#pragma once

#include "solvers/known_focal/P3pKernel.hpp"
#include "solvers/known_focal/P3pLanes.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace HYBRIDGV_INSTRUCTION_SET {

HYBRIDGV_INLINE void storeMask(bool* to, bool mask) { *to = mask; }
template <class M>
HYBRIDGV_INLINE void storeMask(bool* to, M mask) {
  for (unsigned lane = 0, set = bits(mask); lane < sizeof(M) / sizeof(mask[0]); ++lane) to[lane] = ((set >> lane) & 1) != 0;
}

template <class V, int N>
HYBRIDGV_INLINE void storeVector(double (&to)[3][N], int at, const Vec3<V>& v) {
  store(&to[0][at], v.x);
  store(&to[1][at], v.y);
  store(&to[2][at], v.z);
}

template <class V, int N>
static void solveP3p(const P3pSamples<N>& samples, P3pSolutions<N>& solutions) {
  for (int at = 0; at < N; at += LaneTraits<V>::kWidth) {
    Vec3<V> points[3];
    V u[3], v[3];
    for (int i = 0; i < 3; ++i) {
      const auto coordinate = [&](int k) { return load<V>(&samples.point[i][k][at]); };
      points[i] = {coordinate(0), coordinate(1), coordinate(2)};
      u[i] = load<V>(&samples.u[i][at]);
      v[i] = load<V>(&samples.v[i][at]);
      storeMask(&solutions.found[i][at], Mask<V>{});
    }
    storeMask(&solutions.found[3][at], Mask<V>{});
    const TrianglePose<V> pose(points, u, v);
    const auto add = [&](int n, Mask<V> found, const Columns<V>& rotation, const Vec3<V>& position) {
      storeVector(solutions.column[n][0], at, rotation.x);
      storeVector(solutions.column[n][1], at, rotation.y);
      storeVector(solutions.column[n][2], at, rotation.z);
      storeVector(solutions.position[n], at, position);
      storeMask(&solutions.found[n][at], found);
    };
    P3p<V, decltype(add)>(pose, add).solve();
  }
}

extern const P3pKernel kP3pKernel;
const P3pKernel kP3pKernel = {&solveP3p<double, 1>, &solveP3p<Doubles, kP3pSamples>};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

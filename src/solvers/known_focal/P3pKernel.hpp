// P3P over many samples side by side, for three instruction sets.
#pragma once

#include "math/simd/SimdLevel.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

constexpr int kP3pSolutions = 4;  // at most

// N samples: every row holds a number of each.
template <int N>
struct P3pSamples {
  double u[3][N], v[3][N];  // for focal length 1
  double point[3][3][N];    // x, y, z of the three
};

// Up to four solutions of each, anywhere among the four.
template <int N>
struct P3pSolutions {
  double column[kP3pSolutions][3][3][N];  // of the rotation
  double position[kP3pSolutions][3][N];
  bool found[kP3pSolutions][N];
};

// So many at once: as many as the widest vector has lanes.
constexpr int kP3pSamples = 8;

struct P3pKernel {
  void (*solveOne)(const P3pSamples<1>& samples, P3pSolutions<1>& solutions);
  void (*solveMany)(const P3pSamples<kP3pSamples>& samples, P3pSolutions<kP3pSamples>& solutions);
};

// The version for the processor at hand.
const P3pKernel& p3pKernel();
// The version for one level, which the processor must support.
const P3pKernel& p3pKernel(math::SimdLevel level);

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

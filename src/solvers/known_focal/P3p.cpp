#include <algorithm>

#include "math/simd/versions.hpp"
#include "solvers/MinimalProblems.hpp"
#include "solvers/known_focal/P3pKernel.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

HYBRIDGV_VERSIONS(P3pKernel, kP3pKernel)
static_assert(kP3pSamples == kSideBySide, "as many as p3pMany is given");

const P3pKernel& p3pKernel(math::SimdLevel level) {
  return math::choose(level, baseline::kP3pKernel, avx2::kP3pKernel, avx512::kP3pKernel);
}

const P3pKernel& p3pKernel() { return p3pKernel(math::simdLevel()); }

namespace {

template <int N>
void setSample(const PointMatch* points, int at, P3pSamples<N>& samples) {
  for (int i = 0; i < 3; ++i) {
    samples.u[i][at] = points[i].u;
    samples.v[i][at] = points[i].v;
    for (int k = 0; k < 3; ++k) samples.point[i][k][at] = points[i].point[k];
  }
}

template <int N>
int solutionsOf(const P3pSolutions<N>& from, int at, FocalPose* solutions) {
  int count = 0;
  for (int n = 0; n < kP3pSolutions; ++n) {
    if (!from.found[n][at]) continue;
    FocalPose& pose = solutions[count++];
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) pose.rotation(row, column) = from.column[n][column][row][at];
      pose.position[row] = from.position[n][row][at];
    }
    pose.focalLength = 1;
  }
  return count;
}

}  // namespace

// A single sample gains nothing by wider vectors, and their instructions are slower.
int p3p(const RayMatch*, const PointMatch* points, FocalPose* solutions) {
  P3pSamples<1> samples;
  P3pSolutions<1> found;
  setSample(points, 0, samples);
  p3pKernel(std::min(math::simdLevel(), math::SimdLevel::Avx2)).solveOne(samples, found);
  return solutionsOf(found, 0, solutions);
}

void p3pMany(const PointMatch* points, int count, FocalPose* solutions, int* found) {
  P3pSamples<kP3pSamples> samples;
  P3pSolutions<kP3pSamples> all;
  // The places that are left over are filled with the first one: all are solved.
  for (int i = 0; i < kP3pSamples; ++i) setSample(points + (i < count ? 3 * i : 0), i, samples);
  p3pKernel().solveMany(samples, all);
  for (int i = 0; i < count; ++i) found[i] = solutionsOf(all, i, solutions + kP3pSolutions * i);
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

// The sums of normal equations.
#pragma once

#include "robust/kernels/PoseLanes.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

// J^T W J and J^T W e of errors with any derivatives.
template <int N>
class NormalEquationsSum {
 public:
  HYBRIDGV_INLINE void add(const Doubles (&derivatives)[N], Doubles error, Doubles weight) {
    for (int row = 0, k = 0; row < N; ++row) {
      const Doubles weighted = weight * derivatives[row];
      gradient_[row] += weighted * error;
      for (int column = row; column < N; ++column, ++k) hessian_[k] += weighted * derivatives[column];
    }
  }
  void addTo(NormalEquations& total) const {
    for (int row = 0, k = 0; row < N; ++row) {
      total.gradient[row] += sum(gradient_[row]);
      for (int column = row; column < N; ++column, ++k) total.hessian[row][column] += sum(hessian_[k]);
    }
  }

 private:
  Doubles gradient_[N] = {}, hessian_[N * (N + 1) / 2] = {};
};

// Entries of the position from the query's frame to the rig's: there its derivatives are R times those in the query's.
static inline void turnPosition(const PlainPose& pose, double* entries) {
  const double x = entries[3], y = entries[4], z = entries[5];
  for (int k = 0; k < 3; ++k) entries[3 + k] = pose.r1[k] * x + pose.r2[k] * y + pose.r3[k] * z;
}

// Adds sums by N parameters of which the position is one in the query's frame, from the upper triangle of the hessian.
template <int N>
static void addTurned(const PlainPose& pose, double (&gradient)[N], double (&hessian)[N][N], NormalEquations& total) {
  for (int row = 0; row < N; ++row)
    for (int column = 0; column < row; ++column) hessian[row][column] = hessian[column][row];
  turnPosition(pose, gradient);
  for (auto& row : hessian) turnPosition(pose, row);
  for (int column = 0; column < N; ++column) {
    double entries[N] = {};
    for (int row = 0; row < N; ++row) entries[row] = hessian[row][column];
    turnPosition(pose, entries);
    for (int row = 0; row < N; ++row) hessian[row][column] = entries[row];
  }
  for (int row = 0; row < N; ++row) {
    total.gradient[row] += gradient[row];
    for (int column = row; column < N; ++column) total.hessian[row][column] += hessian[row][column];
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

// Tracks all solutions of a start system to the target and sorts the end points.
#pragma once

#include "math/simd/SimdLevel.hpp"
#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

struct EndPoints {
  // Of `paths` tracked paths, `accepted` ended on converged, pairwise different, proper solutions. As many as there are paths:
  // the target has no other solution, so the set is complete. Fewer: as many are missing, be it that they are at infinity, that
  // two coincide, or that a path was lost.
  int paths = 0, accepted = 0;
  int steps = 0;  // of all paths and passes, accepted or not: at most kMaxSteps
  // Real solutions with d > 0, to double precision.
  int count = 0;
  math::Point<double, kUnknowns> point[kMaxPaths];  // x, y, alpha, beta, d

  bool complete() const { return accepted == paths; }
};

// Bounds: per path in the first pass, per path and for all paths together in a round of the second pass. No round begins once as
// many steps as one round may take have been spent.
constexpr int kMaxStepsFirstPass = 300, kMaxStepsSecondPass = 600, kMaxStepsPerRound = 8000, kRounds = 8;
constexpr int kMaxSteps = kMaxPaths * kMaxStepsFirstPass + 2 * kMaxStepsPerRound;

// Bounded time, no allocation. The level must not exceed math::supportedSimdLevel().
void solvePaths(math::SimdLevel level, const StartSystem& start, const Parameters& target, EndPoints* ends);

// Its versions, one per instruction set.
void solvePathsSse2(const StartSystem& start, const Parameters& target, EndPoints* ends);
void solvePathsAvx2(const StartSystem& start, const Parameters& target, EndPoints* ends);
void solvePathsAvx512(const StartSystem& start, const Parameters& target, EndPoints* ends);

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

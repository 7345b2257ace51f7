// What tracking all paths to a problem gives, and how much work it may be; the same for every instruction set.
#pragma once

#include "math/homotopy/Data.hpp"

namespace hybridgv {
namespace math {

// Bounds of PathSolver: per path in the first pass, per path and for all paths together in a round of the second pass. No round
// begins once as many steps as one round may take have been spent.
constexpr int kMaxStepsFirstPass = 300;
constexpr int kMaxStepsSecondPass = 600;
constexpr int kMaxStepsPerRound = 7000;
constexpr int kMaxRounds = 8;

template <int Unknowns, int MaxPaths>
struct EndPoints {
  // The steps of a call are at most as many.
  static constexpr int kMaxSteps = MaxPaths * kMaxStepsFirstPass + 2 * kMaxStepsPerRound;

  // Of `paths` tracked paths, `accepted` ended on converged, pairwise different, proper solutions. As many as there are paths:
  // the target has no other solution, so the set is complete. Fewer: as many are missing, be it that they are at infinity, that
  // two coincide, or that a path was lost.
  int paths = 0;
  int accepted = 0;
  int steps = 0;  // of all paths and passes, accepted or not
  // The real solutions that are of use, to double precision.
  int count = 0;
  Point<double, Unknowns> point[MaxPaths];

  bool complete() const { return accepted == paths; }
};

}  // namespace math
}  // namespace hybridgv

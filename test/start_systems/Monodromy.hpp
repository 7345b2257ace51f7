// All solutions of a parametrized system, from one of them: when the parameters are moved around a loop, the solutions are
// permuted, and if the set of solutions is irreducible, random loops take any solution to any other. Needed to make start
// systems, not to use them.
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "math/homotopy/PathTracker.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

template <class System>
using Solutions = std::vector<Point<double, System::kUnknowns>>;

template <int N>
bool coincide(const Point<double, N>& a, const Point<double, N>& b) {
  constexpr double kDistinct = 1e-6;
  for (int k = 0; k < N; ++k)
    if (std::hypot(a.re[k] - b.re[k], a.im[k] - b.im[k]) > kDistinct * (1 + std::hypot(a.re[k], a.im[k]))) return false;
  return true;
}

// The ends of the paths, with small steps in double precision; paths that fail are left out.
template <class System>
Solutions<System> trackCarefully(const typename System::template Homotopy<double>& homotopy, const Solutions<System>& starts) {
  using Tracker = PathTracker<System, Doubles, Pivoting::Rows>;
  constexpr TrackingOptions kCareful{1e-3, 1e-2, 1e-5, 0.01, 0.1, 1e-13, 3000};
  const std::size_t count = starts.size();
  const int n = static_cast<int>(count);
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  Solutions<System> tangents(count), moved(count), result;
  std::vector<PathEnd<double, System::kUnknowns>> ends(count);
  std::vector<double> lastStep(count);
  Tracker::startTangents(homotopy, starts.data(), all.data(), n, tangents.data());
  Tracker::track(homotopy, starts.data(), tangents.data(), all.data(), n, kCareful, ends.data());
  for (std::size_t i = 0; i < count; ++i) moved[i] = ends[i].point;
  newtonSteps<System, Doubles, Pivoting::Rows>(homotopy, 1.0, moved.data(), all.data(), n, 5, 0.0, lastStep.data());
  for (std::size_t i = 0; i < count; ++i)
    if (ends[i].reached && lastStep[i] < 1e-10) result.push_back(moved[i]);
  return result;
}

// Moves the solutions to the end of the homotopy. False if a path fails or two end points coincide.
template <class System>
bool moveAll(const typename System::template Homotopy<double>& homotopy, Solutions<System>* solutions) {
  const std::size_t count = solutions->size();
  *solutions = trackCarefully<System>(homotopy, *solutions);
  for (std::size_t i = 0; i < solutions->size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (coincide((*solutions)[i], (*solutions)[j])) return false;
  return solutions->size() == count;
}

// Adds to the known solutions at `base` those that triangles base -> random() -> random() -> base lead to, until `idleLoops`
// triangles in a row have given nothing new. connect(a, b) is the homotopy from parameters a to b.
template <class System, class Parameters, class Connect, class RandomParameters>
void addByMonodromy(const Parameters& base, Connect connect, RandomParameters random, int idleLoops, Solutions<System>* known) {
  for (int idle = 0; idle < idleLoops; ++idle) {
    const Parameters second = random(), third = random();
    Solutions<System> moving = trackCarefully<System>(connect(base, second), *known);
    moving = trackCarefully<System>(connect(second, third), moving);
    for (const auto& end : trackCarefully<System>(connect(third, base), moving)) {
      bool isNew = true;
      for (const auto& solution : *known) isNew = isNew && !coincide(solution, end);
      if (isNew) {
        known->push_back(end);
        idle = -1;
      }
    }
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv

// Tracks all solutions of a start system to the target and sorts the end points.
#pragma once

#include "math/homotopy/EndPoints.hpp"
#include "math/simd/SimdLevel.hpp"
#include "solvers/h70f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

using EndPoints = math::EndPoints<kUnknowns, kMaxPaths>;

// Bounded time, no allocation. The level must not exceed math::supportedSimdLevel().
void solvePaths(math::SimdLevel level, const StartSystem& start, const Parameters& target, EndPoints* ends);

// One of its versions, see math/simd/versions.hpp.
using SolvePaths = void (*)(const StartSystem& start, const Parameters& target, EndPoints* ends);

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv

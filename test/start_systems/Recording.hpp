// What the programs that record problems have in common: the poses among the ends of carefully followed paths, in the unknowns of
// H70f, and the format of GoldenProblems.hpp. The solutions do not come from the library's solvers.
#pragma once

#include <vector>

#include "MinimalProblem.hpp"
#include "solvers/complex_rays/Frame.hpp"
#include "start_systems/H70fFamily.hpp"

namespace hybridgv {
namespace test {

using PathEnds = math::Solutions<H70fFamily::PathProblem::System>;

// The ends that are real, as poses.
FocalPoses realPoses(const PathEnds& ends, const solvers::complex_rays::Frame& frame);

// Whether the pose satisfies the equations of rays and points, in front of all cameras.
bool isSolution(const FocalPose& pose, const MinimalProblem& problem);

// Those that are.
FocalPoses solutionsAmong(const FocalPoses& poses, const MinimalProblem& problem);

void print(std::size_t id, const MinimalProblem& problem, const FocalPoses& solutions);

}  // namespace test
}  // namespace hybridgv

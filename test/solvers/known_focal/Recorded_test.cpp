// The solvers with known focal length on problems that were solved by other means, see recordKnownFocal: all solutions are found,
// and nothing else.
#include <gtest/gtest.h>

#include "FocalPoseNear.hpp"
#include "GoldenProblems.hpp"
#include "SolverConfigurations.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace test {
namespace {

std::vector<SolverConfiguration> knownFocalConfigurations() {
  std::vector<SolverConfiguration> result;
  for (const SolverConfiguration& configuration : solverConfigurations())
    if (!configuration.solver->intrinsics.focalLength) result.push_back(configuration);
  return result;
}

class KnownFocalRecorded : public testing::TestWithParam<SolverConfiguration> {};

INSTANTIATE_TEST_SUITE_P(, KnownFocalRecorded, testing::ValuesIn(knownFocalConfigurations()),
                         [](const auto& info) { return info.param.name; });

TEST_P(KnownFocalRecorded, AllSolutionsAreFound) {
  const solvers::MinimalSolver& solver = *GetParam().solver;
  const std::vector<GoldenProblem> problems = readGoldenProblems(GetParam().name + ".txt", HYBRIDGV_RECORDED_DIR);
  ASSERT_FALSE(problems.empty());
  for (const GoldenProblem& recorded : problems) {
    ASSERT_FALSE(recorded.solutions.empty());
    FocalPoses solutions(static_cast<std::size_t>(solver.maxSolutions));
    solutions.resize(static_cast<std::size_t>(solvers::solve(solver, recorded.problem.rays.data(), recorded.problem.points.data(),
                                                             recorded.solutions[0].focalLength, solutions.data())));
    expectSamePoses(solutions, recorded.solutions, 1e-6);
    for (const FocalPose& pose : solutions) {
      const auto isAtIt = [&pose](const FocalPose& other) { return isFocalPoseNear(pose, other, 1e-6, 1e-5); };
      EXPECT_TRUE(std::any_of(recorded.solutions.begin(), recorded.solutions.end(), isAtIt)) << "position";
    }
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

// What every minimal solver makes of degenerate and extreme data: no NaN, no exception, an end, and the outcome that is
// documented (src/doc/degenerate.md).
#include <cstddef>

#include "EquationCheck.hpp"
#include "Situations.hpp"

namespace hybridgv {
namespace test {
namespace {

struct Tally {
  int problems = 0, recovered = 0, empty = 0;
};

Tally solveAll(const Situation& situation, const SolverCase& solver) {
  Tally tally;
  const std::uint64_t problems = solver.problems(50, 10);
  for (std::uint64_t i = 0; i < problems; ++i) {
    Random random(testSeed() + 710, i);
    SituationScene scene(random, solver);
    situation.changeScene(scene, random);
    MinimalProblem problem = scene.problem();
    situation.changeProblem(problem, random);
    const FocalPoses poses = solver.solutions(problem);
    const EquationCheck equations(problem.rays, problem.points, solver.exactCoordinates);
    for (const FocalPose& pose : poses) EXPECT_EQ(equations.violation(pose), "") << solver << ", problem " << i;
    ++tally.problems;
    tally.empty += poses.empty();
    tally.recovered += distanceToNearest(poses, problem.truth) < 1e-3;
  }
  return tally;
}

class Degenerate : public testing::TestWithParam<Situation> {};

TEST_P(Degenerate, DataHaveTheDocumentedOutcome) {
  std::string outcomes;
  for (const char letter : GetParam().outcomes)
    if (letter != ' ') outcomes += letter;
  ASSERT_EQ(outcomes.size(), solverCases().size());
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    if (outcomes[k] == '.') continue;
    const SolverCase& solver = solverCases()[k];
    const Tally tally = solveAll(GetParam(), solver);
    // One in fifty may be badly conditioned.
    const int mustBeRecovered = outcomes[k] == 't' ? tally.problems - 1 : 0;
    EXPECT_GE(tally.recovered, mustBeRecovered) << solver;
    // A path may be lost on the way to infinity and end in a solution after all, which then satisfies the equations.
    const int mustBeEmpty = outcomes[k] == '0' ? tally.problems - (solver.followsPaths ? 1 : 0) : 0;
    EXPECT_GE(tally.empty, mustBeEmpty) << solver;
  }
}

INSTANTIATE_TEST_SUITE_P(Situations, Degenerate, testing::ValuesIn(situations()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace test
}  // namespace hybridgv

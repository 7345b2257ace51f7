#include <gtest/gtest.h>

#include "GoldenProblems.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace test {
namespace {

TEST(H13f, FindsAllRecordedSolutions) {
  const std::vector<GoldenProblem> problems = readGoldenProblems("h13f.txt");
  if (problems.empty()) GTEST_SKIP() << "no recorded problems in " HYBRIDGV_GOLDEN_DIR;
  std::size_t recorded = 0, found = 0;
  for (const GoldenProblem& golden : problems) {
    FocalPoses poses(12);
    const int count = solvers::three_points::h13f(golden.problem.rays.data(), golden.problem.points.data(), poses.data());
    poses.resize(static_cast<std::size_t>(count));
    for (const FocalPose& pose : poses) EXPECT_LT(largestResidual(golden.problem, pose, 3), 1e-5);
    for (const FocalPose& solution : golden.solutions) found += distanceToNearest(poses, solution) < 1e-5;
    recorded += golden.solutions.size();
  }
  // Measured: all.
  EXPECT_EQ(found, recorded);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

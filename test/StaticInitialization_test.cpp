// The library may be used before main: by the initializer of a global, in whatever order globals are initialized.
#include <gtest/gtest.h>

#include "MinimalProblem.hpp"
#include "hybridgv/absolute_pose/methods.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/relative_pose/methods.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace {

struct Solved {
  test::MinimalProblem problem;
  FocalPoses poses;
};

Solved solve(FocalPoses (*function)(const hybrid_pose::HybridAdapterBase&), const std::vector<int>& raysPerCamera, int points) {
  test::Random random(77);
  const test::MinimalProblem problem = test::makeMinimalProblem(random, raysPerCamera, points);
  try {
    return {problem, function(test::makeAdapter(problem))};
  } catch (const std::exception&) {
    return {problem, {}};  // an exception would end the program before the test
  }
}

const Solved kSolved[] = {
    solve(&absolute_pose::p4pf, {}, 4),           solve(&absolute_pose::p35pf, {}, 4),     solve(&hybrid_pose::h13f, {1}, 3),
    solve(&hybrid_pose::h32f, {2, 1}, 2),         solve(&hybrid_pose::h51f, {2, 2, 1}, 1), solve(&hybrid_pose::h70f, {5, 2}, 0),
    solve(&relative_pose::sixpt_onefocal, {6}, 0)};
const FocalPose kRobust = [] {
  test::Random random(78);
  return sac::hybridRansac(test::makeAdapter(test::makeMinimalProblem(random, {10, 10}, 20))).pose;
}();
const std::string kNames = [] {
  std::string names;
  for (const sac::SolverPrior& entry : sac::HybridRansacOptions().solvers) names += toString(entry.solver) + std::string(" ");
  return names;
}();

TEST(StaticInitialization, SolversWorkBeforeMain) {
  for (const Solved& solved : kSolved) EXPECT_LT(test::distanceToNearest(solved.poses, solved.problem.truth), 1e-6);
}

TEST(StaticInitialization, RansacWorksBeforeMain) {
  test::Random random(78);
  EXPECT_LT(test::poseDistance(kRobust, test::makeMinimalProblem(random, {10, 10}, 20).truth), 1e-6);
}

TEST(StaticInitialization, SolversHaveTheirNamesBeforeMain) {
  std::string names;
  for (const Solver solver : allSolvers()) names += toString(solver) + std::string(" ");
  EXPECT_EQ(kNames, names);
}

}  // namespace
}  // namespace hybridgv

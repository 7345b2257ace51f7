#include "solvers/MinimalProblems.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <stdexcept>

#include "MinimalProblem.hpp"
#include "SolverConfigurations.hpp"
#include "hybridgv/absolute_pose/methods.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/relative_pose/methods.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"

namespace hybridgv {
namespace {

using namespace solvers;

TEST(MinimalProblems, RowsOfOneNameStandTogetherAndTakeTheSameCorrespondences) {
  std::set<std::string> names;
  for (const SolverRows& problem : minimalProblems()) {
    EXPECT_TRUE(names.insert(problem.name()).second) << problem.name();
    for (const MinimalSolver& solver : problem) {
      EXPECT_EQ(solver.name, std::string(problem.name()));
      EXPECT_EQ(solver.id, problem.id()) << solver.name;
      EXPECT_EQ(solver.rays, problem.rays()) << solver.name;
      EXPECT_EQ(solver.points, problem.points()) << solver.name;
      EXPECT_EQ(solver.prior, problem.begin()->prior) << solver.name;
      EXPECT_EQ(solver.exactCoordinates, problem.begin()->exactCoordinates) << solver.name;
    }
  }
}

TEST(MinimalProblems, RowsAreSound) {
  for (const MinimalSolver& solver : kMinimalSolvers) {
    EXPECT_GT(solver.rays + solver.points, 0) << solver.name;
    EXPECT_GT(solver.maxSolutions, 0) << solver.name;
    EXPECT_LE(solver.maxSolutions, kMaxSolutions) << solver.name;
    EXPECT_LE(std::max(solver.rays, solver.points), kMaxSampleSize) << solver.name;
    EXPECT_GT(solver.cost, 0) << solver.name;
    EXPECT_GE(solver.prior, 0) << solver.name;
    EXPECT_LE(solver.exactCoordinates, 2 * solver.points) << solver.name;
    EXPECT_TRUE(solver.id || solver.prior == 0) << solver.name;
    EXPECT_NE(solver.solve, nullptr) << solver.name;
  }
}

// A sample has an equation per ray and two per point: as many as unknowns, or more where a solver leaves some out.
TEST(MinimalProblems, SamplesHaveEnoughEquations) {
  for (const MinimalSolver& solver : kMinimalSolvers) {
    const int unknowns = solver.intrinsics.parameters() - (solver.id ? 0 : 1);  // without id: up to scale
    EXPECT_GE(solver.rays + 2 * solver.points, unknowns) << solver.name;
    EXPECT_LE(solver.rays + solver.exactCoordinates, unknowns) << solver.name;
  }
}

TEST(MinimalProblems, SampleOfOneCameraHasTheRowOfItsOwn) {
  const SolverRows h51f = rowsOf(Solver::H51f);
  const MinimalSolver* const oneCamera = test::solverFor(h51f, {5});
  const MinimalSolver* const several = test::solverFor(h51f, {4, 1});
  ASSERT_TRUE(oneCamera && several);
  EXPECT_EQ(oneCamera->draw, RayDraw::OneCamera);
  EXPECT_EQ(several->draw, RayDraw::Spread);
  EXPECT_LT(oneCamera->maxSolutions, several->maxSolutions);
  EXPECT_EQ(test::solverFor(rowsOf("sixpt_onefocal"), {5, 1}), nullptr);
  EXPECT_NE(test::solverFor(rowsOf("sixpt_onefocal"), {6}), nullptr);
  EXPECT_EQ(test::solverFor(rowsOf(Solver::H70f), {6, 1})->draw, RayDraw::AllButOne);
  EXPECT_EQ(test::solverFor(rowsOf(Solver::H70f), {5, 2})->draw, RayDraw::Spread);
  EXPECT_EQ(test::solverFor(rowsOf(Solver::H70f), {7})->draw, RayDraw::Spread);
}

TEST(MinimalProblems, UnknownNamesAreRefused) {
  try {
    rowsOf(std::string("h99f"));
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("h99f"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("sixpt_onefocal"), std::string::npos) << error.what();
  }
}

TEST(MinimalProblems, RansacDrawsThoseWithAPriorByDefault) {
  const std::vector<sac::SolverPrior> solvers = sac::HybridRansacOptions().solvers;
  ASSERT_EQ(solvers.size(), allSolvers().size());
  for (const sac::SolverPrior& entry : solvers)
    EXPECT_EQ(entry.prior, rowsOf(entry.solver).begin()->prior) << toString(entry.solver);
}

// The public functions have the rows of their names.
TEST(MinimalProblems, PublicFunctionsSolveTheProblemOfTheirName) {
  using Adapter = hybrid_pose::HybridAdapterBase;
  using Function = FocalPoses (*)(const Adapter&);
  using AtFocalLength = FocalPoses (*)(const Adapter&, double);
  const auto estimating = [](Function solve) { return [=](const Adapter& adapter, double) { return solve(adapter); }; };
  const struct {
    const char* name;
    std::function<FocalPoses(const Adapter&, double)> solve;
  } functions[] = {{"p4pf", estimating(&absolute_pose::p4pf)}, {"p35pf", estimating(&absolute_pose::p35pf)},
                   {"h13f", estimating(&hybrid_pose::h13f)},   {"h32f", estimating(&hybrid_pose::h32f)},
                   {"h51f", estimating(&hybrid_pose::h51f)},   {"sixpt_onefocal", estimating(&relative_pose::sixpt_onefocal)},
                   {"h70f", estimating(&hybrid_pose::h70f)},   {"p3p", AtFocalLength(&absolute_pose::p3p)},
                   {"h22", AtFocalLength(&hybrid_pose::h22)},  {"h41", AtFocalLength(&hybrid_pose::h41)},
                   {"h60", AtFocalLength(&hybrid_pose::h60)},  {"fivept", AtFocalLength(&relative_pose::fivept)}};
  test::Random random(test::testSeed() + 720);
  for (const auto& function : functions)
    for (const test::SolverConfiguration& configuration : test::configurationsOf(rowsOf(function.name))) {
      const test::MinimalProblem problem =
          test::makeMinimalProblem(random, configuration.raysPerCamera, configuration.solver->points);
      FocalPoses expected(kMaxSolutions);
      const double f = problem.truth.focalLength;
      expected.resize(
          static_cast<std::size_t>(solve(*configuration.solver, problem.rays.data(), problem.points.data(), f, expected.data())));
      const FocalPoses poses = function.solve(test::makeAdapter(problem), f);
      ASSERT_EQ(poses.size(), expected.size()) << configuration.name;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_LT(test::poseDistance(poses[i], expected[i]), 1e-6) << configuration.name;
        EXPECT_LT((poses[i].position - expected[i].position).norm(), 1e-5) << configuration.name;
      }
    }
}

}  // namespace
}  // namespace hybridgv

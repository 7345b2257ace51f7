// Every minimal solver, with every pattern of shared centres, and what may be asked of it.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"
#include "SolverConfigurations.hpp"

namespace hybridgv {
namespace test {

struct SolverCase {
  std::string name;
  solvers::MinimalSolver solver;
  std::vector<int> raysPerCamera;
  int points;
  int maxSolutions;
  std::size_t exactCoordinates;
  int exchangeablePoints;  // so many of the first points may be permuted without changing the problem
  double cost;             // microseconds
  bool followsPaths;       // a path may be lost, about once in ten thousand problems
  bool isUpToScale;        // the distance from the rays' centre is not determined and returned as 1
  bool usesAllOfImage;     // false: the image's axes matter, because one of two coordinates is left out

  explicit SolverCase(const SolverConfiguration& configuration)
      : name(configuration.name),
        solver(*configuration.solver),
        raysPerCamera(configuration.raysPerCamera),
        points(configuration.solver->points),
        maxSolutions(configuration.solver->maxSolutions),
        exactCoordinates(static_cast<std::size_t>(configuration.solver->exactCoordinates)),
        exchangeablePoints(configuration.solver->exactCoordinates / 2),
        cost(configuration.solver->cost),
        followsPaths(configuration.solver->followsPaths),
        isUpToScale(!configuration.solver->id),
        usesAllOfImage(configuration.solver->exactCoordinates % 2 == 0) {}

  // How many problems a test takes: fewer of solvers that take their time.
  std::uint64_t problems(std::uint64_t usual, std::uint64_t few) const { return cost < 500 ? usual : few; }

  // Solvers that need the focal length get the true one.
  FocalPoses solutions(const MinimalProblem& problem) const {
    FocalPose poses[solvers::kMaxSolutions];
    const int count = solvers::solve(solver, problem.rays.data(), problem.points.data(), problem.truth.focalLength, poses);
    EXPECT_GE(count, 0);
    EXPECT_LE(count, maxSolutions);
    return {poses, poses + count};
  }
};

inline std::ostream& operator<<(std::ostream& stream, const SolverCase& solver) { return stream << solver.name; }

inline const std::vector<SolverCase>& solverCases() {
  static const std::vector<SolverCase> cases = [] {
    std::vector<SolverCase> list;
    for (const SolverConfiguration& configuration : solverConfigurations()) list.emplace_back(configuration);
    return list;
  }();
  return cases;
}

}  // namespace test
}  // namespace hybridgv

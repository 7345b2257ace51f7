// Every minimal solver, with every pattern of shared centres that it treats in its own way, and what may be asked of it.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace test {

struct SolverCase {
  std::string name;
  solvers::SolveFunction solve;
  std::vector<int> raysPerCamera;
  int points;
  int maxSolutions;
  // How many image coordinates of the points, counted from the first, all solutions satisfy; the others only rank or reject.
  std::size_t exactCoordinates;
  int exchangeablePoints;      // so many of the first points may be permuted without changing the problem
  bool followsPaths = false;   // a path may be lost, about once in ten thousand problems
  bool isUpToScale = false;    // the distance from the rays' centre is not determined and returned as 1
  bool usesAllOfImage = true;  // false: the image's axes matter, because one of two coordinates is left out

  FocalPoses solutions(const MinimalProblem& problem) const {
    FocalPose poses[solvers::kMaxSolutions];
    const int count = solve(problem.rays.data(), problem.points.data(), poses);
    EXPECT_GE(count, 0);
    EXPECT_LE(count, maxSolutions);
    return {poses, poses + count};
  }
};

inline std::ostream& operator<<(std::ostream& stream, const SolverCase& solver) { return stream << solver.name; }

inline const std::vector<SolverCase>& solverCases() {
  using namespace solvers;
  static const std::vector<SolverCase> cases = {
      {"p4pf", &three_points::p4pf, {}, 4, 6, 6, 3},
      {"p35pf", &three_points::p35pf, {}, 4, 10, 7, 3, false, false, false},
      {"h13f", &three_points::h13f, {1}, 3, 12, 6, 3},
      {"h32f_111", &h32f::solve, {1, 1, 1}, 2, 26, 4, 2},
      {"h32f_21", &h32f::solve, {2, 1}, 2, 26, 4, 2},
      {"h32f_3", &h32f::solve, {3}, 2, 26, 4, 2},
      {"h51f_11111", &h51f::solve, {1, 1, 1, 1, 1}, 1, 56, 2, 1, true},
      {"h51f_2111", &h51f::solve, {2, 1, 1, 1}, 1, 56, 2, 1, true},
      {"h51f_221", &h51f::solve, {2, 2, 1}, 1, 56, 2, 1, true},
      {"h51f_311", &h51f::solve, {3, 1, 1}, 1, 50, 2, 1, true},
      {"h51f_32", &h51f::solve, {3, 2}, 1, 50, 2, 1, true},
      {"h51f_41", &h51f::solve, {4, 1}, 1, 36, 2, 1, true},
      {"h51f_5", &h51f::solve, {5}, 1, 9, 2, 1},
      {"sixpt_onefocal", &one_centre::sixptOnefocal, {6}, 0, 9, 0, 0, false, true},
  };
  return cases;
}

}  // namespace test
}  // namespace hybridgv

// H13f, P3.5Pf and P4Pf: what holds for all solvers with three 2D-3D points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "AwkwardProblems.hpp"
#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "solvers/MinimalProblems.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace test {
namespace {

// Every solution must satisfy its equations to this, in pixels.
constexpr double kResidualLimit = 1e-5;

struct SolverCase {
  const char* name;
  solvers::SolveFunction solve;
  std::vector<int> raysPerCamera;
  int points;
  int maxSolutions;
  int allowedFailures;  // of 20000 problems; measured on 100000: see the table below
};

// Measured share of problems whose truth is not found to 1e-6: P4Pf 0 / 100000, P3.5Pf 0 / 100000, H13f 2 / 100000.
const SolverCase kP4pf{"P4Pf", &solvers::three_points::p4pf, {}, 4, 6, 1};
const SolverCase kP35pf{"P3.5Pf", &solvers::three_points::p35pf, {}, 4, 10, 1};
const SolverCase kH13f{"H13f", &solvers::three_points::h13f, {1}, 3, 12, 2};

FocalPoses solve(const SolverCase& solver, const MinimalProblem& problem) {
  FocalPoses poses(static_cast<std::size_t>(solver.maxSolutions));
  const int count = solver.solve(problem.rays.data(), problem.points.data(), poses.data());
  EXPECT_GE(count, 0);
  EXPECT_LE(count, solver.maxSolutions);
  poses.resize(static_cast<std::size_t>(count));
  return poses;
}

class ThreePointSolver : public testing::TestWithParam<SolverCase> {
 protected:
  MinimalProblem makeProblem(Random& random) const {
    return makeMinimalProblem(random, GetParam().raysPerCamera, GetParam().points);
  }
};

INSTANTIATE_TEST_SUITE_P(All, ThreePointSolver, testing::Values(kP4pf, kP35pf, kH13f), [](const auto& info) {
  return info.index == 0 ? "P4pf" : info.index == 1 ? "P35pf" : "H13f";
});

TEST_P(ThreePointSolver, FindsTheTruthAndReturnsOnlySolutions) {
  int lost = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    Random random(testSeed(), i);
    const MinimalProblem problem = makeProblem(random);
    const FocalPoses poses = solve(GetParam(), problem);
    lost += !(distanceToNearest(poses, problem.truth) < 1e-6);
    for (const FocalPose& pose : poses) EXPECT_LT(largestResidual(problem, pose, 3), kResidualLimit) << "problem " << i;
    EXPECT_TRUE(areDistinct(poses, 1e-7)) << "problem " << i;
  }
  EXPECT_LE(lost, GetParam().allowedFailures);
}

// The third point is near the line of the other two. Whatever is returned is a rotation to rounding.
TEST_P(ThreePointSolver, PosesFromThinTrianglesAreRotations) {
  int poses = 0;
  for (const double thin : {1e-3, 1e-5, 1e-7, 1e-8})
    for (std::uint64_t i = 0; i < 300; ++i) {
      Random random(testSeed() + 8, i);
      MinimalProblem problem = makeProblem(random);
      const Eigen::Vector3d &first = problem.points[0].point, edge = problem.points[1].point - first;
      const Eigen::Vector3d third = first + random.uniform(0.2, 0.8) * edge + thin * edge.norm() * random.direction();
      problem.points[2] = makePointMatch(problem.truth, third);
      for (const FocalPose& pose : solve(GetParam(), problem)) {
        EXPECT_LT((pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-13) << thin << ", " << i;
        ++poses;
      }
    }
  EXPECT_GT(poses, 100) << "there is something to check";
}

// Median relative errors of the focal length [%] with noisy image points: of the solution returned first and of the best one.
struct FocalErrors {
  double first, best;
};

FocalErrors focalErrors(const SolverCase& solver, double imageNoise, int count) {
  std::vector<double> first, best;
  for (int i = 0; i < count; ++i) {
    Random random(testSeed(), static_cast<std::uint64_t>(i));
    MinimalProblem problem = makeMinimalProblem(random, solver.raysPerCamera, solver.points);
    for (solvers::PointMatch& match : problem.points) {
      match.u += imageNoise * random.normal();
      match.v += imageNoise * random.normal();
    }
    double least = 100, ofFirst = 100;  // no solution: 100 %
    const FocalPoses poses = solve(solver, problem);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const double error = 100 * std::abs(poses[k].focalLength / problem.truth.focalLength - 1);
      if (k == 0) ofFirst = error;
      least = std::min(least, error);
    }
    first.push_back(ofFirst);
    best.push_back(least);
  }
  return {median(first), median(best)};
}

// The eighth equation ranks P4Pf's solutions so well that the first one is as good as the best of P3.5Pf, which can be known only
// with the truth. (Four times 20000 problems, 0.5 px: 3.58 to 3.73 % of P4Pf, its best 3.48 to 3.61 %; 3.59 to 3.81 % of P3.5Pf.)
// Allowed are 3 % for the noise of the medians.
TEST(ThreePointSolvers, FirstSolutionOfP4pfIsAsGoodAsTheBestOfP35pfUnderNoise) {
  for (const double noise : {0.1, 0.5}) {
    const FocalErrors p4pf = focalErrors(kP4pf, noise, 20000), p35pf = focalErrors(kP35pf, noise, 20000);
    EXPECT_LT(p4pf.first, 1.03 * p35pf.best) << noise;
    EXPECT_LT(p4pf.first, 1.1 * p4pf.best) << "the ranking loses little, at " << noise;
    EXPECT_LT(p4pf.first, p35pf.first);
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

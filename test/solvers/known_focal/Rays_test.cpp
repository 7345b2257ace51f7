// Solvers with rays and a known focal length: what is their own, beside the contract of all solvers.
#include <gtest/gtest.h>

#include <functional>

#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "SolverConfigurations.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace test {
namespace {

using Eigen::Vector3d;

struct Case {
  const char* name;
  std::vector<int> raysPerCamera;
};
const Case kCases[] = {{"h22", {1, 1}}, {"h22", {2}}, {"h41", {4}}, {"h60", {5, 1}}, {"fivept", {5}}};

// How many of the problems are solved to 1e-6; all that is returned must be a solution, and different.
int countFound(const Case& solved, int count, const std::function<void(MinimalProblem&, Random&)>& change) {
  const solvers::SolverRows problem = solvers::rowsOf(std::string(solved.name));
  const solvers::MinimalSolver& solver = *solverFor(problem, solved.raysPerCamera);
  int found = 0;
  for (int i = 0; i < count; ++i) {
    Random random(testSeed() + 50, static_cast<std::uint64_t>(i));
    MinimalProblem sample = makeMinimalProblem(random, solved.raysPerCamera, solver.points);
    change(sample, random);
    FocalPoses poses(static_cast<std::size_t>(solver.maxSolutions));
    poses.resize(static_cast<std::size_t>(
        solvers::solve(solver, sample.rays.data(), sample.points.data(), sample.truth.focalLength, poses.data())));
    found += distanceToNearest(poses, sample.truth) < 1e-6;
    for (const FocalPose& pose : poses)
      EXPECT_LT(largestResidual(sample, pose, static_cast<std::size_t>(solver.points)), 1e-3) << solved.name << " " << i;
    EXPECT_TRUE(areDistinct(poses, 1e-8)) << solved.name << " " << i;
  }
  return found;
}

TEST(KnownFocalRays, FindTheTruthAndReturnOnlySolutions) {
  for (const Case& solved : kCases) EXPECT_GE(countFound(solved, 4000, [](MinimalProblem&, Random&) {}), 3999) << solved.name;
}

// The rig cameras near to each other and to the query, compared with the scene: with another basis, most of what is lost without
// is found.
TEST(KnownFocalRays, FindTheTruthWithAShortBaseline) {
  const auto comeNear = [](MinimalProblem& problem, Random& random) {
    std::vector<Vector3d> centres;
    for (const solvers::RayMatch& ray : problem.rays)
      if (static_cast<std::size_t>(ray.camera) >= centres.size())
        centres.push_back(problem.truth.position + 0.5 * random.direction());
    for (solvers::RayMatch& ray : problem.rays) {
      const double depth = random.uniform(5, 15), f = problem.truth.focalLength;
      const Vector3d point = problem.truth.position + depth * (problem.truth.rotation * Vector3d(ray.u / f, ray.v / f, 1));
      ray.centre = centres[static_cast<std::size_t>(ray.camera)];
      ray.direction = (point - ray.centre).normalized();
    }
  };
  for (const Case& solved : kCases) EXPECT_GE(countFound(solved, 1000, comeNear), 995) << solved.name;
}

// A ray whose point lies on the line of the two points has an equation that holds for every turn about it: a double root.
TEST(KnownFocalRays, H22FindsARayToTheLineOfThePoints) {
  const auto toLine = [](MinimalProblem& problem, Random& random) {
    const Vector3d &a = problem.points[0].point, &b = problem.points[1].point;
    const Vector3d point = a + random.uniform(0.2, 0.8) * (b - a);
    problem.rays[0] = makeRayMatch(problem.truth, point, problem.rays[0].centre, problem.rays[0].camera);
  };
  EXPECT_GE(countFound(kCases[0], 1000, toLine), 960);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

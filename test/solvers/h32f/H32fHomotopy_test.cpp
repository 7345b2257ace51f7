// The path tracker is general: it solves H32f as well, and agrees with the solver that eliminates all unknowns but one.
#include <gtest/gtest.h>

#include <cmath>

#include "FocalPoseNear.hpp"
#include "H32fSystem.hpp"
#include "solvers/MinimalProblems.hpp"
#include "solvers/h51f/Reduction.hpp"
#include "start_systems/Monodromy.hpp"

namespace hybridgv {
namespace test {
namespace {

using solvers::h51f::ComplexNumber;
using Parameters = H32fSystem::Parameters;
using H32fSolutions = Solutions<H32fSystem>;

constexpr double kImageScale = 1000;  // [px]
constexpr double kSmallResidual = 1e-5, kEqual = 1e-6;

// The first point at the origin, the second one at (0, 0, 1).
solvers::h51f::Frame frameOf(const MinimalProblem& problem) {
  const Eigen::Vector3d difference = problem.points[1].point - problem.points[0].point, third = difference.normalized();
  const Eigen::Vector3d first = third.unitOrthogonal();
  solvers::h51f::Frame frame;
  frame.origin = problem.points[0].point;
  frame.length = difference.norm();
  frame.imageScale = kImageScale;
  frame.turn << first.transpose(), third.cross(first).transpose(), third.transpose();
  return frame;
}

Parameters parametersOf(const MinimalProblem& problem) {
  const solvers::h51f::Frame frame = frameOf(problem);
  Parameters p;
  for (const solvers::RayMatch& ray : problem.rays) {
    const Eigen::Vector3d q = frame.turn * ray.direction, c = frame.turn * (ray.centre - frame.origin) / frame.length;
    for (int k = 0; k < 3; ++k) p.push_back({q[k], 0});
    for (int k = 0; k < 3; ++k) p.push_back({c[k], 0});
    p.push_back({ray.u / kImageScale, ray.v / kImageScale});
    p.push_back({ray.u / kImageScale, -ray.v / kImageScale});
  }
  for (double sign : {1.0, -1.0})
    for (const solvers::PointMatch& point : problem.points) p.push_back({point.u / kImageScale, sign * point.v / kImageScale});
  return p;
}

// Complex parameters near the problem's; rays of one centre keep one.
Parameters perturbedParameters(const MinimalProblem& problem, Random& random) {
  Parameters p = parametersOf(problem);
  for (ComplexNumber& a : p) {
    a.re += 0.3 * random.normal();
    a.im += 0.3 * random.normal();
  }
  for (std::size_t j = 1; j < problem.rays.size(); ++j)
    if (problem.rays[j].camera == problem.rays[j - 1].camera)
      for (std::size_t k = H32fSystem::Centre; k < H32fSystem::Image; ++k) p[8 * j + k] = p[8 * (j - 1) + k];
  return p;
}

H32fSolutions::value_type trueSolution(const MinimalProblem& problem) {
  const solvers::h51f::Solution truth = solvers::h51f::solutionOf(problem.truth, frameOf(problem), problem.points[0]);
  return {{truth.x.real(), truth.y.real(), truth.d.real()}, {truth.x.imag(), truth.y.imag(), 0}};
}

// The poses of the real solutions, unless a ray is met behind a camera.
FocalPoses posesOf(const H32fSolutions& solutions, const MinimalProblem& problem) {
  using Number = std::complex<double>;
  FocalPoses poses;
  const Number pi0 = Number(problem.points[0].u, problem.points[0].v) / kImageScale;
  const Number pi1 = Number(problem.points[1].u, problem.points[1].v) / kImageScale;
  for (const auto& p : solutions) {
    const Number x(p.re[0], p.im[0]), y(p.re[1], p.im[1]), d(p.re[2], p.im[2]);
    if (std::abs(y - std::conj(x)) > 1e-6 * (1 + std::abs(x)) || std::abs(d.imag()) > 1e-6 * std::abs(d)) continue;
    const Number beta = -2.0 * x / (pi1 * (1.0 - x * y) - (pi0 - pi1) * d * (1.0 + x * y));
    const FocalPose pose =
        solvers::h51f::poseOf({x, std::conj(x), std::conj(beta), beta, d}, frameOf(problem), problem.points[0]);
    if (largestResidual(problem, pose, 2) < kSmallResidual) poses.push_back(pose);
  }
  return poses;
}

struct Pattern {
  std::vector<int> raysPerCamera;
  std::size_t solutions;
};

class H32fHomotopy : public testing::TestWithParam<Pattern> {};
INSTANTIATE_TEST_SUITE_P(, H32fHomotopy, testing::Values(Pattern{{1, 1, 1}, 26}, Pattern{{2, 1}, 26}, Pattern{{3}, 22}),
                         [](const auto& info) {
                           std::string name = "Rays";
                           for (int rays : info.param.raysPerCamera) name += std::to_string(rays);
                           return name;
                         });

TEST_P(H32fHomotopy, AgreesWithTheEliminationSolver) {
  Random random(testSeed(), 0);
  const auto straight = &H32fSystem::straightHomotopy;
  const MinimalProblem start = makeMinimalProblem(random, GetParam().raysPerCamera, 2);
  const auto randomParameters = [&] { return perturbedParameters(start, random); };
  const Parameters base = randomParameters();
  H32fSolutions known = trackCarefully<H32fSystem>(straight(parametersOf(start), base), {trueSolution(start)});
  ASSERT_EQ(known.size(), 1u);
  addByMonodromy<H32fSystem>(base, straight, randomParameters, 6, &known);
  ASSERT_EQ(known.size(), GetParam().solutions);

  for (std::uint64_t i = 1; i <= 25; ++i) {
    Random instance(testSeed(), i);
    const MinimalProblem problem = makeMinimalProblem(instance, GetParam().raysPerCamera, 2);
    const H32fSolutions ends = trackCarefully<H32fSystem>(straight(base, parametersOf(problem)), known);
    EXPECT_EQ(ends.size(), known.size()) << "a path failed in problem " << i;
    const FocalPoses tracked = posesOf(ends, problem);
    FocalPoses eliminated(solvers::kMaxSolutions);
    eliminated.resize(
        static_cast<std::size_t>(solvers::h32f::solve(problem.rays.data(), problem.points.data(), eliminated.data())));
    EXPECT_EQ(tracked.size(), eliminated.size()) << "problem " << i;
    for (const FocalPose& pose : eliminated) EXPECT_TRUE(hasFocalPoseNear(tracked, pose, kEqual)) << "problem " << i;
    for (const FocalPose& pose : tracked) EXPECT_TRUE(hasFocalPoseNear(eliminated, pose, kEqual)) << "problem " << i;
    EXPECT_TRUE(hasFocalPoseNear(tracked, problem.truth, kEqual)) << "problem " << i;
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

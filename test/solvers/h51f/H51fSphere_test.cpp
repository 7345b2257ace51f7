// H51f against an independent method (h51f_sphere/solve.hpp) and that method against the equations.
#include <gtest/gtest.h>

#include "FocalPoseNear.hpp"
#include "H51fScenes.hpp"
#include "h51f_sphere/solve.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace test {
namespace {

constexpr double kSmallResidual = 1e-5;  // [px]
constexpr double kEqual = 1e-5;

FocalPoses solveByHomotopy(const MinimalProblem& problem) {
  FocalPoses poses(solvers::kMaxSolutions);
  poses.resize(static_cast<std::size_t>(solvers::h51f::solve(problem.rays.data(), problem.points.data(), poses.data())));
  return poses;
}

// Without those that meet a ray behind a camera.
FocalPoses solveOnSphere(const MinimalProblem& problem) {
  FocalPoses poses;
  for (const FocalPose& pose : h51f_sphere::solve(problem.rays, problem.points[0], h51f_sphere::kFine))
    if (largestResidual(problem, pose, 1) < kSmallResidual) poses.push_back(pose);
  return poses;
}

class H51fSphere : public testing::TestWithParam<RaysPerCamera> {
 protected:
  struct Count {
    std::size_t problems = 0, truths = 0, tracked = 0, both = 0;
  };
  template <class MakeProblem>
  Count compare(MakeProblem makeProblem, std::uint64_t problems, std::uint64_t stream) {
    Count count;
    for (std::uint64_t i = 0; i < problems; ++i) {
      Random random(testSeed() + stream, i);
      const MinimalProblem problem = makeProblem(random);
      const FocalPoses tracked = solveByHomotopy(problem), isolated = solveOnSphere(problem);
      for (const FocalPose& pose : isolated) EXPECT_TRUE(hasFocalPoseNear(tracked, pose, kEqual)) << "problem " << i;
      for (const FocalPose& pose : tracked) count.both += distanceToNearest(isolated, pose) < kEqual;
      count.tracked += tracked.size();
      ++count.problems;
      count.truths += distanceToNearest(isolated, problem.truth) < kEqual;
    }
    return count;
  }
};
INSTANTIATE_TEST_SUITE_P(, H51fSphere, testing::ValuesIn(h51fPatterns()),
                         [](const auto& info) { return "RaysPerCamera" + nameOf(info.param); });

// Whatever one method finds, the other one finds too; but the sphere's grid may be too coarse for a few.
TEST_P(H51fSphere, AgreesWithTheHomotopy) {
  const Count count = compare([](Random& random) { return makeMinimalProblem(random, GetParam(), 1); }, 40, 0);
  EXPECT_GE(count.both, count.tracked * 98 / 100) << "of " << count.tracked;
  EXPECT_GE(count.truths, count.problems - 1);
}

TEST_P(H51fSphere, AgreesWithTheHomotopyOnARig) {
  const Count count = compare([](Random& random) { return makeRigProblem(random, GetParam(), 0.5); }, 10, 1);
  EXPECT_GE(count.both, count.tracked * 95 / 100) << "of " << count.tracked;
}

TEST_P(H51fSphere, AgreesWithTheHomotopyOnNoisyData) {
  const auto noisyProblem = [](Random& random) {
    MinimalProblem problem = makeMinimalProblem(random, GetParam(), 1);
    for (solvers::RayMatch& ray : problem.rays) {
      ray.u += random.normal();
      ray.v += random.normal();
    }
    return problem;
  };
  const Count count = compare(noisyProblem, 15, 2);
  EXPECT_GE(count.both, count.tracked * 95 / 100) << "of " << count.tracked;
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

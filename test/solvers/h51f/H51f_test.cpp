// H51f in the camera configurations [1] .. [4], at every instruction set of this processor.
#include <gtest/gtest.h>

#include <functional>

#include "FocalPoseNear.hpp"
#include "GoldenProblems.hpp"
#include "H51fScenes.hpp"
#include "SimdLevels.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "solvers/MinimalProblems.hpp"
#include "solvers/h51f/solve.hpp"

namespace hybridgv {
namespace test {
namespace {

using math::SimdLevel;
using solvers::h51f::EndPoints;

constexpr double kRecovered = 1e-6;
constexpr double kSmallResidual = 1e-5;  // [px]

FocalPoses solve(const MinimalProblem& problem, SimdLevel level, EndPoints* ends = nullptr) {
  EndPoints unused;
  FocalPoses solutions(solvers::kMaxSolutions);
  const int count = solvers::h51f::solve(level, problem.rays.data(), problem.points[0], solutions.data(), ends ? ends : &unused);
  solutions.resize(static_cast<std::size_t>(count));
  return solutions;
}

// As the library calls it.
FocalPoses solve(const MinimalProblem& problem) {
  FocalPoses solutions(solvers::kMaxSolutions);
  solutions.resize(static_cast<std::size_t>(solvers::h51f::solve(problem.rays.data(), problem.points.data(), solutions.data())));
  return solutions;
}

// The poses satisfy the equations and no pose is there twice.
void expectValid(const MinimalProblem& problem, const FocalPoses& solutions) {
  for (const FocalPose& pose : solutions)
    EXPECT_LT(largestResidual(problem, pose, 1), kSmallResidual) << "f " << pose.focalLength;
  EXPECT_TRUE(areDistinct(solutions, 1e-9));
}

class H51fLevels : public testing::TestWithParam<SimdLevel> {
 protected:
  // Counts how often the truth is found and how often the set is complete.
  void run(const std::function<MinimalProblem(Random&)>& makeProblem, std::uint64_t count, std::uint64_t stream) {
    found_ = complete_ = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      Random random(testSeed() + stream, i);
      const MinimalProblem problem = makeProblem(random);
      EndPoints ends;
      const FocalPoses solutions = solve(problem, GetParam(), &ends);
      expectValid(problem, solutions);
      found_ += distanceToNearest(solutions, problem.truth) < kRecovered;
      complete_ += ends.complete();
    }
  }
  std::uint64_t found_ = 0, complete_ = 0;
};

INSTANTIATE_TEST_SUITE_P(, H51fLevels, testing::ValuesIn(supportedLevels()),
                         [](const auto& info) { return math::toString(info.param); });

TEST_P(H51fLevels, FindsTheTruthAndAllSolutions) {
  constexpr std::uint64_t kCount = 150;
  for (const RaysPerCamera& pattern : h51fPatterns()) {
    run([&pattern](Random& random) { return makeMinimalProblem(random, pattern, 1); }, kCount, 0);
    EXPECT_GE(found_, kCount - 1) << nameOf(pattern);
    EXPECT_GE(complete_, kCount - 1) << nameOf(pattern);
  }
}

// An image point at the principal point sends some paths to infinity; the truth is found all the same.
TEST_P(H51fLevels, FindsTheTruthInOtherScenes) {
  constexpr std::uint64_t kCount = 25;
  for (std::size_t i = 0; i < h51fScenes().size(); ++i)
    for (const RaysPerCamera& pattern : h51fPatterns()) {
      const MinimalScene& scene = h51fScenes()[i];
      run([&](Random& random) { return scene.make(random, pattern); }, kCount, 1 + i);
      EXPECT_GE(found_, kCount - 1) << scene.name << ", " << nameOf(pattern);
      if (scene.finite) {
        EXPECT_GE(complete_, kCount - 2) << scene.name << ", " << nameOf(pattern);
      }
    }
}

// Problems in which another solution lies so close to the true pose that Newton's method converges slowly to either.
TEST_P(H51fLevels, FindsAlmostDoubleSolutions) {
  const struct {
    std::uint64_t seed, stream;
    RaysPerCamera pattern;
    double rigHalfSize;  // 0: the usual scene
  } problems[] = {{90210, 774, {2, 1, 1, 1}, 0.1},
                  {90210, 776, {2, 2, 1}, 0.1},
                  {90210, 776, {2, 2, 1}, 0.5},
                  {90210, 1295, {3, 1, 1}, 0.1},
                  {424242, 12372, {3, 1, 1}, 0}};
  for (const auto& p : problems) {
    Random random(p.seed, p.stream);
    const MinimalProblem problem =
        p.rigHalfSize > 0 ? makeRigProblem(random, p.pattern, p.rigHalfSize) : makeMinimalProblem(random, p.pattern, 1);
    EXPECT_TRUE(hasFocalPoseNear(solve(problem, GetParam()), problem.truth, 1e-5)) << p.seed << ", " << p.stream;
  }
}

// Data for which the solutions are not finitely many, not distinct or not all finite; and worse.
struct DegenerateCase {
  const char* name;
  std::function<void(MinimalProblem&, Random&)> change;
  int mostSteps;  // a sample of the usual scene takes about 1500
};
constexpr int kFewSteps = 12000;

void moveQueryToRigCentre(MinimalProblem& problem, Random& random) {
  problem.truth.position = problem.rays[0].centre;
  const Eigen::Vector3d z = -problem.truth.position.normalized(), x = z.cross(random.direction()).normalized();
  problem.truth.rotation << x, z.cross(x), z;
  for (solvers::RayMatch& ray : problem.rays) ray = makeRayMatch(problem.truth, random.vector(-5, 5), ray.centre, ray.camera);
  problem.points[0] = makePointMatch(problem.truth, random.vector(-5, 5));
}

void makeCollinear(MinimalProblem& problem, Random& random) {
  const Eigen::Vector3d origin = random.vector(-2, 2), direction = random.direction();
  const auto point = [&]() -> Eigen::Vector3d { return origin + random.uniform(-3, 3) * direction; };
  for (solvers::RayMatch& ray : problem.rays) ray = makeRayMatch(problem.truth, point(), ray.centre, ray.camera);
  problem.points[0] = makePointMatch(problem.truth, point());
}

const std::vector<DegenerateCase>& degenerateCases() {
  static const std::vector<DegenerateCase> cases = {
      {"a ray twice", [](MinimalProblem& problem, Random&) { problem.rays[1] = problem.rays[0], problem.rays[1].camera = 7; },
       kFewSteps},
      {"a ray through the point",
       [](MinimalProblem& problem, Random&) {
         problem.rays[0].direction = (problem.points[0].point - problem.rays[0].centre).normalized();
         problem.rays[0].u = problem.points[0].u;
         problem.rays[0].v = problem.points[0].v;
       },
       kFewSteps},
      {"two image points equal",
       [](MinimalProblem& problem, Random&) { problem.rays[1].u = problem.rays[0].u, problem.rays[1].v = problem.rays[0].v; },
       kFewSteps},
      {"all image points equal",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) {
           ray.u = problem.points[0].u;
           ray.v = problem.points[0].v;
         }
       },
       kFewSteps},
      {"all image points on a line through the principal point",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) ray.v = 0;
         problem.points[0].v = 0;
       },
       kFewSteps},
      {"parallel rays",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) ray.direction = Eigen::Vector3d(0, 0, 1);
       },
       kFewSteps},
      {"all points on one line", makeCollinear, kFewSteps},
      {"the point and a ray at the principal point",
       [](MinimalProblem& problem, Random& random) {
         movePointToAxis(problem, random.uniform(10, 30));
         moveRayToAxis(problem, 2, random.uniform(10, 30));
       },
       kFewSteps},
      {"all image points at the principal point",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) ray.u = ray.v = 0;
         problem.points[0].u = problem.points[0].v = 0;
       },
       kFewSteps},
      {"the query at the centre of a rig camera", moveQueryToRigCentre, EndPoints::kMaxSteps},
      {"the point at the centre of a rig camera",
       [](MinimalProblem& problem, Random&) { problem.points[0].point = problem.rays[0].centre; }, EndPoints::kMaxSteps},
      {"rays without direction",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) ray.direction.setZero();
       },
       EndPoints::kMaxSteps},
      {"noise on many scales",
       [](MinimalProblem& problem, Random& random) {
         for (solvers::RayMatch& ray : problem.rays) {
           ray.u = std::exp(random.uniform(-20, 20));
           ray.centre = std::exp(random.uniform(-20, 20)) * random.direction();
         }
       },
       EndPoints::kMaxSteps},
  };
  return cases;
}

TEST_P(H51fLevels, StopsOnDegenerateData) {
  for (std::size_t i = 0; i < degenerateCases().size(); ++i)
    for (std::uint64_t k = 0; k < 12; ++k) {
      const DegenerateCase& degenerate = degenerateCases()[i];
      Random random(testSeed() + 30 + i, k);
      MinimalProblem problem = makeMinimalProblem(random, h51fPatterns()[k % 6], 1);
      degenerate.change(problem, random);
      EndPoints ends;
      const FocalPoses solutions = solve(problem, GetParam(), &ends);
      for (const FocalPose& pose : solutions) {
        EXPECT_TRUE(pose.rotation.allFinite() && pose.position.allFinite() && std::isfinite(pose.focalLength)) << degenerate.name;
        EXPECT_GT(pose.focalLength, 0) << degenerate.name;
      }
      EXPECT_LE(ends.steps, degenerate.mostSteps) << degenerate.name;
      EXPECT_LE(ends.accepted, ends.paths) << degenerate.name;
    }
}

// A query at the centre that three or four rays share satisfies their equations whatever they are, and then is a multiple solution
// that is known to few digits only.
TEST_P(H51fLevels, ReturnsHardlyAnyImproperPose) {
  constexpr std::uint64_t kCount = 20;
  std::uint64_t improper = 0;
  for (const RaysPerCamera& pattern : {RaysPerCamera{3, 1, 1}, RaysPerCamera{3, 2}, RaysPerCamera{4, 1}})
    for (std::uint64_t i = 0; i < kCount; ++i) {
      Random random(testSeed() + 90, i);
      MinimalProblem problem = makeMinimalProblem(random, pattern, 1);
      moveQueryToRigCentre(problem, random);
      for (const FocalPose& pose : solve(problem, GetParam())) improper += (pose.position - problem.rays[0].centre).norm() < 1e-4;
    }
  EXPECT_LE(improper, 3 * kCount / 10);
}

// The paths that an image point at the principal point sends to infinity do not cost much.
TEST_P(H51fLevels, TakesAFewTimesAsManyStepsAtThePrincipalPoint) {
  const auto meanSteps = [](const std::function<void(MinimalProblem&, Random&)>& change) {
    constexpr std::uint64_t kCount = 30;
    double steps = 0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      Random random(testSeed() + 20, i);
      MinimalProblem problem = makeMinimalProblem(random, h51fPatterns()[i % 6], 1);
      change(problem, random);
      EndPoints ends;
      solve(problem, GetParam(), &ends);
      steps += static_cast<double>(ends.steps) / kCount;
    }
    return steps;
  };
  const double usual = meanSteps([](MinimalProblem&, Random&) {});
  EXPECT_LT(usual, 2000);
  EXPECT_LT(meanSteps([](MinimalProblem& problem, Random& random) { movePointToAxis(problem, random.uniform(10, 30)); }),
            4 * usual);
  EXPECT_LT(meanSteps([](MinimalProblem& problem, Random& random) { moveRayToAxis(problem, 1, random.uniform(10, 30)); }),
            4 * usual);
}

TEST_P(H51fLevels, SameResultEveryTime) {
  Random random(testSeed(), 40);
  const MinimalProblem problem = makeMinimalProblem(random, {2, 2, 1}, 1);
  const FocalPoses first = solve(problem, GetParam()), second = solve(problem, GetParam());
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(poseDistance(first[i], second[i]), 0);
}

class H51fPatterns : public testing::TestWithParam<RaysPerCamera> {};

INSTANTIATE_TEST_SUITE_P(, H51fPatterns, testing::ValuesIn(h51fPatterns()),
                         [](const auto& info) { return "RaysPerCamera" + nameOf(info.param); });

TEST_P(H51fPatterns, FindsAllRecordedSolutions) {
  const std::vector<GoldenProblem> problems = readGoldenProblems("h51f_" + nameOf(GetParam()) + ".txt");
  if (problems.empty()) GTEST_SKIP() << "no recorded problems in " << HYBRIDGV_GOLDEN_DIR;
  for (const GoldenProblem& golden : problems) {
    const FocalPoses solutions = solve(golden.problem);
    expectValid(golden.problem, solutions);
    for (const FocalPose& expected : golden.solutions) EXPECT_TRUE(hasFocalPoseNear(solutions, expected, 1e-5));
    EXPECT_EQ(solutions.size(), golden.solutions.size());
  }
}

TEST_P(H51fPatterns, DoesNotDependOnOrderScaleAndFrame) {
  for (std::uint64_t i = 0; i < 5; ++i) {
    Random random(testSeed() + 50, i);
    const MinimalProblem problem = makeMinimalProblem(random, GetParam(), 1);
    const FocalPoses expected = solve(problem);

    MinimalProblem reversed = problem;
    std::reverse(reversed.rays.begin(), reversed.rays.end());
    expectSamePoses(solve(reversed), expected, 1e-6);

    MinimalProblem zoomed = problem;
    const double zoom = std::exp(random.uniform(-7, 7));
    for (solvers::RayMatch& ray : zoomed.rays) {
      ray.u *= zoom;
      ray.v *= zoom;
    }
    zoomed.points[0].u *= zoom;
    zoomed.points[0].v *= zoom;
    FocalPoses poses = solve(zoomed);
    for (FocalPose& pose : poses) pose.focalLength /= zoom;
    expectSamePoses(poses, expected, 1e-6);

    MinimalProblem moved = problem;
    const double scale = std::exp(random.uniform(-7, 7));
    const Eigen::Matrix3d turn = random.rotation();
    const Eigen::Vector3d shift = random.vector(-10, 10);
    for (solvers::RayMatch& ray : moved.rays) {
      ray.centre = scale * (turn * ray.centre + shift);
      ray.direction = turn * ray.direction;
    }
    moved.points[0].point = scale * (turn * moved.points[0].point + shift);
    poses = solve(moved);
    for (FocalPose& pose : poses) {
      expectValid(moved, {pose});
      pose.rotation = turn.transpose() * pose.rotation;
    }
    expectSamePoses(poses, expected, 1e-6);
  }
}

// Equal centres are recognized without camera numbers, and camera numbers without exactly equal centres.
TEST_P(H51fPatterns, RecognisesSharedCentres) {
  Random random(testSeed(), 60);
  const MinimalProblem problem = makeMinimalProblem(random, GetParam(), 1);
  const FocalPoses expected = solve(problem);
  MinimalProblem unnumbered = problem, inexact = problem;
  for (std::size_t j = 0; j < 5; ++j) {
    unnumbered.rays[j].camera = static_cast<int>(j);
    inexact.rays[j].centre += 1e-12 * random.direction();
  }
  expectSamePoses(solve(unnumbered), expected, 1e-9);
  expectSamePoses(solve(inexact), expected, 1e-6);
}

// The table of minimal problems has the largest number for all of them.
TEST(H51f, ConfigurationsHaveTheirOwnLargestNumbersOfSolutions) {
  const struct {
    RaysPerCamera pattern;
    std::size_t most;
  } rows[] = {{{3, 1, 1}, 50}, {{3, 2}, 50}, {{4, 1}, 36}};
  Random random(testSeed(), 71);
  for (const auto& row : rows)
    for (int i = 0; i < 100; ++i)
      EXPECT_LE(solve(makeMinimalProblem(random, row.pattern, 1)).size(), row.most) << nameOf(row.pattern);
}

TEST(H51f, FiveRaysOfOneCentreGoToTheirOwnSolver) {
  Random random(testSeed(), 70);
  MinimalProblem problem = makeMinimalProblem(random, {5}, 1);
  const FocalPoses solutions = solve(problem);
  expectValid(problem, solutions);
  EXPECT_TRUE(hasFocalPoseNear(solutions, problem.truth, kRecovered));
  for (std::size_t j = 0; j < 5; ++j) problem.rays[j].camera = static_cast<int>(j);
  expectSamePoses(solve(problem), solutions, 1e-12);
}

TEST(H51f, PublicFunctionReadsTheAdapter) {
  Random random(testSeed(), 80);
  const MinimalProblem problem = makeMinimalProblem(random, {2, 1, 1, 1}, 1);
  const FocalPoses solutions = hybrid_pose::h51f(makeAdapter(problem));
  expectSamePoses(solutions, solve(problem), 1e-9);
  EXPECT_TRUE(hasFocalPoseNear(solutions, problem.truth, kRecovered));
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

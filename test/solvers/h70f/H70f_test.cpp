// H70f in all patterns of shared centres, at every instruction set of this processor.
#include <gtest/gtest.h>

#include <functional>

#include "FocalPoseNear.hpp"
#include "GoldenProblems.hpp"
#include "H70fScenes.hpp"
#include "SimdLevels.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "solvers/MinimalProblems.hpp"
#include "solvers/h70f/solve.hpp"

namespace hybridgv {
namespace test {
namespace {

using math::SimdLevel;
using solvers::h70f::EndPoints;
using solvers::h70f::Groups;

constexpr double kRecovered = 1e-6;
constexpr double kSmallResidual = 1e-5;  // [px]

const RaysPerCamera kSixAndOne{6, 1};

std::vector<RaysPerCamera> patternsOfPaths() {
  std::vector<RaysPerCamera> patterns = h70fPatterns();
  patterns.erase(patterns.begin());
  return patterns;
}

FocalPoses solve(const MinimalProblem& problem, SimdLevel level, EndPoints* ends = nullptr) {
  EndPoints unused;
  FocalPoses solutions(solvers::kMaxSolutions);
  const int count =
      solvers::h70f::solve(level, problem.rays.data(), Groups(problem.rays.data()), solutions.data(), ends ? ends : &unused);
  solutions.resize(static_cast<std::size_t>(count));
  return solutions;
}

// As the library calls it.
FocalPoses solve(const MinimalProblem& problem) {
  FocalPoses solutions(solvers::kMaxSolutions);
  solutions.resize(static_cast<std::size_t>(solvers::h70f::solve(problem.rays.data(), nullptr, solutions.data())));
  return solutions;
}

// The poses satisfy the equations and no pose is there twice.
void expectValid(const MinimalProblem& problem, const FocalPoses& solutions) {
  for (const FocalPose& pose : solutions)
    EXPECT_LT(largestResidual(problem, pose, 0), kSmallResidual) << "f " << pose.focalLength;
  EXPECT_TRUE(areDistinct(solutions, 1e-9));
}

class H70fLevels : public testing::TestWithParam<SimdLevel> {
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

INSTANTIATE_TEST_SUITE_P(, H70fLevels, testing::ValuesIn(supportedLevels()),
                         [](const auto& info) { return math::toString(info.param); });

TEST_P(H70fLevels, FindsTheTruthAndAllSolutions) {
  constexpr std::uint64_t kCount = 25;
  for (const RaysPerCamera& pattern : patternsOfPaths()) {
    run([&pattern](Random& random) { return makeMinimalProblem(random, pattern, 0); }, kCount, 0);
    EXPECT_GE(found_, kCount - 1) << nameOf(pattern);
    EXPECT_GE(complete_, kCount - 1) << nameOf(pattern);
  }
}

// An image point at the principal point sends some paths to infinity; the truth is found all the same.
TEST_P(H70fLevels, FindsTheTruthInOtherScenes) {
  constexpr std::uint64_t kCount = 10;
  for (std::size_t i = 0; i < h70fScenes().size(); ++i)
    for (const RaysPerCamera& pattern : patternsOfPaths()) {
      const MinimalScene& scene = h70fScenes()[i];
      run([&](Random& random) { return scene.make(random, pattern); }, kCount, 1 + i);
      EXPECT_GE(found_, kCount - 1) << scene.name << ", " << nameOf(pattern);
      if (scene.finite) {
        EXPECT_GE(complete_, kCount - 1) << scene.name << ", " << nameOf(pattern);
      }
    }
}

// Data for which the solutions are not finitely many, not distinct or not all finite.
struct DegenerateCase {
  const char* name;
  std::function<void(MinimalProblem&, Random&)> change;
};

void moveQueryToRigCentre(MinimalProblem& problem, Random& random) {
  problem.truth.position = problem.rays[0].centre;
  const Eigen::Vector3d z = -problem.truth.position.normalized(), x = z.cross(random.direction()).normalized();
  problem.truth.rotation << x, z.cross(x), z;
  for (solvers::RayMatch& ray : problem.rays) ray = makeRayMatch(problem.truth, random.vector(-5, 5), ray.centre, ray.camera);
}

const std::vector<DegenerateCase>& degenerateCases() {
  static const std::vector<DegenerateCase> cases = {
      {"a ray twice", [](MinimalProblem& problem, Random&) { problem.rays[1] = problem.rays[0], problem.rays[1].camera = 9; }},
      {"all image points equal",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) {
           ray.u = problem.rays[0].u;
           ray.v = problem.rays[0].v;
         }
       }},
      {"all image points on a line through the principal point",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) ray.v = 0;
       }},
      {"parallel rays",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) ray.direction = Eigen::Vector3d(0, 0, 1);
       }},
      {"the query at the centre of a rig camera", moveQueryToRigCentre},
      {"rays without direction",
       [](MinimalProblem& problem, Random&) {
         for (solvers::RayMatch& ray : problem.rays) ray.direction.setZero();
       }},
      {"nearly equal centres",
       [](MinimalProblem& problem, Random& random) {
         const Eigen::Vector3d centre = problem.rays[0].centre;
         for (std::size_t j = 0; j < 5; ++j)
           problem.rays[j].camera = static_cast<int>(j) + 10, problem.rays[j].centre = centre + 1e-7 * random.direction();
       }},
      {"noise on many scales",
       [](MinimalProblem& problem, Random& random) {
         for (solvers::RayMatch& ray : problem.rays) {
           ray.u = std::exp(random.uniform(-20, 20));
           ray.centre = std::exp(random.uniform(-20, 20)) * random.direction();
         }
       }},
  };
  return cases;
}

TEST_P(H70fLevels, StopsOnDegenerateData) {
  for (std::size_t i = 0; i < degenerateCases().size(); ++i)
    for (std::uint64_t k = 0; k < 14; ++k) {
      const DegenerateCase& degenerate = degenerateCases()[i];
      Random random(testSeed() + 30 + i, k);
      MinimalProblem problem = makeMinimalProblem(random, h70fPatterns()[k], 0);
      degenerate.change(problem, random);
      if (Groups(problem.rays.data()).size(0) > 5) continue;
      EndPoints ends;
      for (const FocalPose& pose : solve(problem, GetParam(), &ends)) {
        EXPECT_TRUE(pose.rotation.allFinite() && pose.position.allFinite() && std::isfinite(pose.focalLength)) << degenerate.name;
        EXPECT_GT(pose.focalLength, 0) << degenerate.name;
      }
      EXPECT_LE(ends.steps, EndPoints::kMaxSteps) << degenerate.name;
      EXPECT_LE(ends.accepted, ends.paths) << degenerate.name;
    }
}

// A query at a centre that three rays or more share satisfies their equations whatever they are.
TEST_P(H70fLevels, ReturnsHardlyAnyImproperPose) {
  constexpr std::uint64_t kCount = 10;
  std::uint64_t improper = 0, problems = 0;
  for (const RaysPerCamera& pattern :
       {RaysPerCamera{5, 2}, RaysPerCamera{4, 3}, RaysPerCamera{3, 3, 1}, RaysPerCamera{4, 1, 1, 1}})
    for (std::uint64_t i = 0; i < kCount; ++i, ++problems) {
      Random random(testSeed() + 90, i);
      MinimalProblem problem = makeMinimalProblem(random, pattern, 0);
      moveQueryToRigCentre(problem, random);
      for (const FocalPose& pose : solve(problem, GetParam())) improper += (pose.position - problem.rays[0].centre).norm() < 1e-4;
    }
  EXPECT_LE(improper, problems / 10);
}

TEST_P(H70fLevels, SameResultEveryTime) {
  Random random(testSeed(), 40);
  const MinimalProblem problem = makeMinimalProblem(random, {2, 2, 1, 1, 1}, 0);
  const FocalPoses first = solve(problem, GetParam()), second = solve(problem, GetParam());
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(poseDistance(first[i], second[i]), 0);
}

class H70fPatterns : public testing::TestWithParam<RaysPerCamera> {};

INSTANTIATE_TEST_SUITE_P(, H70fPatterns, testing::ValuesIn(h70fPatterns()),
                         [](const auto& info) { return "RaysPerCamera" + nameOf(info.param); });

// Equal centres are recognized without camera numbers, and camera numbers without exactly equal centres.
TEST_P(H70fPatterns, RecognizesSharedCentres) {
  Random random(testSeed(), 60);
  const MinimalProblem problem = makeMinimalProblem(random, GetParam(), 0);
  const FocalPoses expected = solve(problem);
  EXPECT_TRUE(hasFocalPoseNear(expected, problem.truth, kRecovered));
  MinimalProblem unnumbered = problem, inexact = problem;
  for (std::size_t j = 0; j < 7; ++j) {
    unnumbered.rays[j].camera = static_cast<int>(j);
    inexact.rays[j].centre += 1e-12 * random.direction();
  }
  expectSamePoses(solve(unnumbered), expected, 1e-9);
  expectSamePoses(solve(inexact), expected, 1e-6);
}

// Solved by other means, see recordH70f.
TEST_P(H70fPatterns, FindsAllRecordedSolutions) {
  if (GetParam() == kSixAndOne) GTEST_SKIP() << "is not solved by following paths";
  const std::vector<GoldenProblem> problems = readGoldenProblems("h70f_" + nameOf(GetParam()) + ".txt", HYBRIDGV_RECORDED_DIR);
  ASSERT_FALSE(problems.empty());
  for (const GoldenProblem& recorded : problems) {
    const FocalPoses solutions = solve(recorded.problem);
    expectValid(recorded.problem, solutions);
    expectSamePoses(solutions, recorded.solutions, 1e-6);
  }
}

TEST_P(H70fPatterns, DoesNotDependOnTheOrderOfTheRays) {
  for (std::uint64_t i = 0; i < 5; ++i) {
    Random random(testSeed() + 50, i);
    MinimalProblem problem = makeMinimalProblem(random, GetParam(), 0);
    const FocalPoses expected = solve(problem);
    std::reverse(problem.rays.begin(), problem.rays.end());
    expectSamePoses(solve(problem), expected, 1e-6);
  }
}

// Each class has its own largest number of solutions; the table of minimal problems has the largest of all.
TEST(H70f, ClassesHaveTheirOwnNumbersOfSolutions) {
  const struct {
    RaysPerCamera pattern;
    int solutions;
  } rows[] = {{{5, 2}, 50},
              {{5, 1, 1}, 50},
              {{4, 3}, 76},
              {{4, 2, 1}, 84},
              {{4, 1, 1, 1}, 84},
              {{3, 3, 1}, 98},
              {{3, 2, 2}, 108},
              {{3, 2, 1, 1}, 108},
              {{3, 1, 1, 1, 1}, 108},
              {{2, 2, 2, 1}, 118},
              {{2, 2, 1, 1, 1}, 118},
              {{2, 1, 1, 1, 1, 1}, 118},
              {{1, 1, 1, 1, 1, 1, 1}, 118}};
  Random random(testSeed(), 71);
  for (const auto& row : rows) {
    EndPoints ends;
    solve(makeMinimalProblem(random, row.pattern, 0), math::simdLevel(), &ends);
    EXPECT_EQ(ends.paths, row.solutions) << nameOf(row.pattern);
  }
}

TEST(H70f, SixRaysOfOneCentreAreSolvedInClosedForm) {
  constexpr std::uint64_t kCount = 300;
  const auto scenes = {
      MinimalScene{"usual", [](Random& random, const RaysPerCamera& p) { return makeMinimalProblem(random, p, 0); }},
      h70fScenes()[0], h70fScenes()[1], h70fScenes()[2]};
  for (const MinimalScene& scene : scenes)
    for (std::uint64_t i = 0; i < kCount; ++i) {
      Random random(testSeed() + 70, i);
      const MinimalProblem problem = scene.make(random, kSixAndOne);
      const FocalPoses solutions = solve(problem);
      EXPECT_LE(solutions.size(), 9u);
      expectValid(problem, solutions);
      EXPECT_TRUE(hasFocalPoseNear(solutions, problem.truth, kRecovered)) << scene.name << " " << i;
    }
}

// Points in a plane leave the focal length open if six of the rays have one centre, and not otherwise.
TEST(H70f, FacadesNeedAnotherPatternThanSixAndOne) {
  for (std::uint64_t i = 0; i < 10; ++i) {
    Random random(testSeed() + 72, i);
    EXPECT_TRUE(solve(makePlanarProblem(random, kSixAndOne, 0)).empty());
    const MinimalProblem problem = makePlanarProblem(random, {5, 2}, 0);
    EXPECT_TRUE(hasFocalPoseNear(solve(problem), problem.truth, kRecovered));
  }
}

TEST(H70f, SevenRaysOfOneCentreHaveNoScale) {
  Random random(testSeed(), 73);
  MinimalProblem problem = makeMinimalProblem(random, {7}, 0);
  EXPECT_TRUE(solve(problem).empty());
  EXPECT_TRUE(hybrid_pose::h70f(makeAdapter(problem)).empty());
  for (std::size_t j = 0; j < 7; ++j) problem.rays[j].camera = static_cast<int>(j);
  EXPECT_TRUE(solve(problem).empty());
}

TEST(H70f, PublicFunctionReadsTheAdapter) {
  Random random(testSeed(), 80);
  MinimalProblem problem = makeMinimalProblem(random, {2, 2, 1, 1, 1}, 0);
  const FocalPoses solutions = hybrid_pose::h70f(makeAdapter(problem));
  expectSamePoses(solutions, solve(problem), 1e-9);
  EXPECT_TRUE(hasFocalPoseNear(solutions, problem.truth, kRecovered));
  problem.rays.insert(problem.rays.begin(), problem.rays[3]);
  expectSamePoses(hybrid_pose::h70f(makeAdapter(problem), {{7, 1, 2, 3, 4, 5, 6}, {}}), solutions, 1e-6);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

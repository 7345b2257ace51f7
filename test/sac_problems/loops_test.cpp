// Every minimal solver inside OpenGV's own loops.
#include "hybridgv/sac_problems/hybrid_pose/HybridPoseSacProblem.hpp"
#include "hybridgv/sac_problems/hybrid_pose/MultiHybridPoseSacProblem.hpp"

// The problems come first: OpenGV's loops need what they include.
#include <gtest/gtest.h>

#include <opengv/sac/Lmeds.hpp>
#include <opengv/sac/MultiRansac.hpp>
#include <opengv/sac/Ransac.hpp>
#include <ostream>
#include <string>
#include <tuple>

#include "FocalPoseNear.hpp"
#include "SolverConfigurations.hpp"
#include "damage.hpp"

namespace hybridgv {

void PrintTo(Solver solver, std::ostream* stream) { *stream << toString(solver); }

namespace {

using opengv::sac::Lmeds;
using opengv::sac::MultiRansac;
using opengv::sac::Ransac;
using sac_problems::hybrid_pose::HybridPoseSacProblem;
using sac_problems::hybrid_pose::MultiHybridPoseSacProblem;

struct Result {
  bool success;
  FocalPose model, refined;
  std::size_t inliers;
  int iterations;
};

std::size_t count(const std::vector<int>& inliers) { return inliers.size(); }
std::size_t count(const std::vector<std::vector<int>>& inliers) { return inliers[0].size() + inliers[1].size(); }

template <class Loop>
Result run(const NoncentralHybridAdapter& adapter, Solver solver, double focalLength, std::uint64_t seed) {
  using Problem = typename Loop::problem_t;
  Loop loop;
  loop.sac_model_ = std::make_shared<Problem>(adapter, solver, 4, 2, seed, test::focalLengthFor(solver, focalLength));
  loop.threshold_ = 1.0;
  loop.max_iterations_ = 200;
  loop.probability_ = 0.9999;
  Result result{};
  result.success = loop.computeModel();
  result.iterations = loop.iterations_;
  if (!result.success) return result;
  result.model = loop.model_coefficients_;
  result.inliers = count(loop.inliers_);
  loop.sac_model_->optimizeModelCoefficients(loop.inliers_, result.model, result.refined);
  return result;
}

using Run = Result (*)(const NoncentralHybridAdapter&, Solver, double, std::uint64_t);
struct NamedLoop {
  const char* name;
  Run run;
};
void PrintTo(const NamedLoop& loop, std::ostream* stream) { *stream << loop.name; }
const NamedLoop kLoops[] = {{"Ransac", &run<Ransac<HybridPoseSacProblem>>},
                            {"Lmeds", &run<Lmeds<HybridPoseSacProblem>>},
                            {"MultiRansac", &run<MultiRansac<MultiHybridPoseSacProblem>>}};

class SacLoops : public testing::TestWithParam<std::tuple<NamedLoop, Solver>> {
 protected:
  Result run(const test::MinimalProblem& problem, std::uint64_t seed) const {
    return std::get<0>(GetParam()).run(test::makeAdapter(problem), std::get<1>(GetParam()), problem.truth.focalLength, seed);
  }
  test::Random random_{test::testSeed()};
};

// 60 rays from three cameras and 40 points, every fifth an outlier, 0.1 px noise.
TEST_P(SacLoops, FindThePoseAmongOutliers) {
  test::MinimalProblem problem = test::makeMinimalProblem(random_, {20, 20, 20}, 40);
  test::addNoise(random_, 0.1, problem);
  test::addOutliers(random_, 5, problem);
  const Result result = run(problem, 1);
  ASSERT_TRUE(result.success);
  EXPECT_GE(result.inliers, 75u);
  EXPECT_TRUE(test::isFocalPoseNear(result.refined, problem.truth, 0.01, 0.2));
}

TEST_P(SacLoops, SameSeedGivesTheSameResult) {
  test::MinimalProblem problem = test::makeMinimalProblem(random_, {20, 20, 20}, 40);
  test::addNoise(random_, 0.1, problem);
  test::addOutliers(random_, 3, problem);
  const Result first = run(problem, 7), second = run(problem, 7), other = run(problem, 8);
  EXPECT_EQ(first.model.transformation(), second.model.transformation());
  EXPECT_EQ(first.model.focalLength, second.model.focalLength);
  EXPECT_EQ(first.refined.focalLength, second.refined.focalLength);
  EXPECT_EQ(first.iterations, second.iterations);
  EXPECT_NE(first.model.position, other.model.position);
}

// No rig camera has five rays: the samples come from several.
TEST(SacLoopsWithManyCameras, SolversThatFollowPathsFindThePose) {
  test::Random random(test::testSeed());
  test::MinimalProblem problem = test::makeMinimalProblem(random, std::vector<int>(12, 4), 20);
  test::addNoise(random, 0.1, problem);
  test::addOutliers(random, 6, problem);
  for (const NamedLoop& loop : {kLoops[0], kLoops[2]})
    for (const Solver solver : {Solver::H51f, Solver::H70f}) {
      const Result result = loop.run(test::makeAdapter(problem), solver, problem.truth.focalLength, 1);
      ASSERT_TRUE(result.success) << loop.name;
      EXPECT_GE(result.inliers, 52u) << loop.name;
      EXPECT_TRUE(test::isFocalPoseNear(result.refined, problem.truth, 0.01)) << loop.name;
    }
}

// Hard data, not a wrong call: no model, no exception, an end after 10 max_iterations_ samples.
TEST_P(SacLoops, DegenerateDataGiveNoModel) {
  test::MinimalProblem problem = test::makeMinimalProblem(random_, {6, 6}, 6);
  for (solvers::PointMatch& match : problem.points) match.u = match.v = 100;
  for (solvers::RayMatch& ray : problem.rays) ray.u = ray.v = 100;
  EXPECT_FALSE(run(problem, 1).success);
}

std::string name(const testing::TestParamInfo<std::tuple<NamedLoop, Solver>>& info) {
  return std::string(std::get<0>(info.param).name) + "_" + toString(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(All, SacLoops, testing::Combine(testing::ValuesIn(kLoops), testing::ValuesIn(allSolvers())), name);

}  // namespace
}  // namespace hybridgv

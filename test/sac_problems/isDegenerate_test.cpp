#include "sac_problems/hybrid_pose/isDegenerate.hpp"

#include <gtest/gtest.h>

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {
namespace {

using test::MinimalProblem;

class IsDegenerate : public testing::Test {
 protected:
  IsDegenerate() : problem_(test::makeMinimalProblem(random_, {2, 1}, 4)) {}
  bool isDegenerate(const MinimalProblem& problem) const {
    return hybrid_pose::isDegenerate(problem.rays.data(), static_cast<int>(problem.rays.size()), problem.points.data(),
                                     static_cast<int>(problem.points.size()));
  }
  test::Random random_{test::testSeed()};
  MinimalProblem problem_;
};

TEST_F(IsDegenerate, NotARandomSample) {
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(isDegenerate(test::makeMinimalProblem(random_, {2, 1, 2}, 1)));
    EXPECT_FALSE(isDegenerate(test::makeMinimalProblem(random_, {}, 4)));
  }
}

TEST_F(IsDegenerate, CoincidentImagePoints) {
  problem_.points[1].u = problem_.rays[2].u;
  EXPECT_FALSE(isDegenerate(problem_));
  problem_.points[1].v = problem_.rays[2].v;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(IsDegenerate, CoincidentPoints) {
  problem_.points[3].point = problem_.points[0].point;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(IsDegenerate, AllPointsInOnePlace) {
  for (solvers::PointMatch& match : problem_.points) match.point = problem_.points[0].point;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(IsDegenerate, ThreeCollinearPoints) {
  problem_.points[3].point = 3 * problem_.points[0].point - 2 * problem_.points[2].point;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(IsDegenerate, RepeatedRay) {
  problem_.rays[1].direction = problem_.rays[0].direction;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(IsDegenerate, OneLineSeenFromTwoCentres) {
  problem_.rays[2].direction = -problem_.rays[0].direction;
  EXPECT_FALSE(isDegenerate(problem_));
  problem_.rays[2].centre = problem_.rays[0].centre + 20 * problem_.rays[0].direction;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(IsDegenerate, RayThroughAPoint) {
  problem_.points[2].point = problem_.rays[1].centre + 7 * problem_.rays[1].direction;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(IsDegenerate, DoesNotDependOnTheUnits) {
  for (double scale : {1e-6, 1e6}) {
    MinimalProblem scaled = problem_;
    for (solvers::RayMatch& ray : scaled.rays) ray.centre *= scale, ray.u *= scale, ray.v *= scale;
    for (solvers::PointMatch& match : scaled.points) match.point *= scale, match.u *= scale, match.v *= scale;
    EXPECT_FALSE(isDegenerate(scaled));
    scaled.points[3].point = 3 * scaled.points[0].point - 2 * scaled.points[2].point;
    EXPECT_TRUE(isDegenerate(scaled));
  }
}

}  // namespace
}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv

#include "robust/SampleCheck.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "MinimalProblem.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"

namespace hybridgv {
namespace robust {
namespace {

using test::MinimalProblem;

class SampleCheck : public testing::Test {
 protected:
  SampleCheck() : problem_(test::makeMinimalProblem(random_, {2, 1}, 4)) {}
  bool isDegenerate(const MinimalProblem& problem) const {
    return robust::isDegenerate(problem.rays.data(), static_cast<int>(problem.rays.size()), problem.points.data(),
                                static_cast<int>(problem.points.size()));
  }
  test::Random random_{test::testSeed()};
  MinimalProblem problem_;
};

TEST_F(SampleCheck, NotARandomSample) {
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(isDegenerate(test::makeMinimalProblem(random_, {2, 1, 2}, 1)));
    EXPECT_FALSE(isDegenerate(test::makeMinimalProblem(random_, {}, 4)));
  }
}

TEST_F(SampleCheck, PointsSeenAtOnePlace) {
  problem_.points[1].u = problem_.points[3].u;
  EXPECT_FALSE(isDegenerate(problem_));
  problem_.points[1].v = problem_.points[3].v;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(SampleCheck, CoincidentPoints) {
  problem_.points[2].point = problem_.points[0].point;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(SampleCheck, AllPointsInOnePlace) {
  for (solvers::PointMatch& match : problem_.points) match.point = problem_.points[0].point;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(SampleCheck, FirstThreePointsCollinear) {
  problem_.points[2].point = 3 * problem_.points[0].point - 2 * problem_.points[1].point;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(SampleCheck, RepeatedRay) {
  problem_.rays[1].direction = problem_.rays[0].direction;
  EXPECT_TRUE(isDegenerate(problem_));
}

// The ray from `centre` towards a point, seen at the point's place in the query.
solvers::RayMatch rayTowards(const Eigen::Vector3d& point, const Eigen::Vector3d& centre, int camera, const FocalPose& query) {
  const Eigen::Vector2d image = test::project(query, point);
  return {image[0], image[1], centre, (point - centre).normalized(), camera};
}

bool solvedByH32f(const MinimalProblem& problem) {
  const FocalPoses poses = hybridgv::hybrid_pose::h32f(test::makeAdapter(problem));
  return std::any_of(poses.begin(), poses.end(),
                     [&](const FocalPose& pose) { return test::poseDistance(pose, problem.truth) < 1e-5; });
}

// One feature of the query that is matched in two map images gives two rays that meet: two equations, as a point.
TEST_F(SampleCheck, TwoRaysSeenAtOnePlaceAreGood) {
  int solved = 0;
  for (int i = 0; i < 20; ++i) {
    MinimalProblem problem = test::makeMinimalProblem(random_, {1, 1, 1}, 2);
    const Eigen::Vector3d meeting = problem.rays[0].centre + 20 * problem.rays[0].direction;
    for (int k = 0; k < 2; ++k) {
      solvers::RayMatch& ray = problem.rays[static_cast<std::size_t>(k)];
      ray = rayTowards(meeting, ray.centre, ray.camera, problem.truth);
    }
    EXPECT_FALSE(isDegenerate(problem));
    solved += solvedByH32f(problem);
  }
  EXPECT_GE(solved, 15);
}

// Two cameras that see along the line between them give two points of one line: its image is known.
TEST_F(SampleCheck, TwoRaysOnOneLineAreGood) {
  int solved = 0;
  for (int i = 0; i < 20; ++i) {
    MinimalProblem problem = test::makeMinimalProblem(random_, {1, 1, 1}, 2);
    const Eigen::Vector3d centre = problem.rays[0].centre, direction = problem.rays[0].direction;
    problem.rays[0] = rayTowards(centre + 17 * direction, centre, problem.rays[0].camera, problem.truth);
    problem.rays[1] = rayTowards(centre + 21 * direction, centre - 2 * direction, problem.rays[1].camera, problem.truth);
    EXPECT_FALSE(isDegenerate(problem));
    solved += solvedByH32f(problem);
  }
  EXPECT_GE(solved, 15);
}

TEST_F(SampleCheck, RayThroughAPoint) {
  problem_.points[2].point = problem_.rays[1].centre + 7 * problem_.rays[1].direction;
  EXPECT_TRUE(isDegenerate(problem_));
}

TEST_F(SampleCheck, DoesNotDependOnTheUnits) {
  for (double scale : {1e-6, 1e6}) {
    MinimalProblem scaled = problem_;
    for (solvers::RayMatch& ray : scaled.rays) {
      ray.centre *= scale;
      ray.u *= scale;
      ray.v *= scale;
    }
    for (solvers::PointMatch& match : scaled.points) {
      match.point *= scale;
      match.u *= scale;
      match.v *= scale;
    }
    EXPECT_FALSE(isDegenerate(scaled));
    scaled.points[2].point = 3 * scaled.points[0].point - 2 * scaled.points[1].point;
    EXPECT_TRUE(isDegenerate(scaled));
  }
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

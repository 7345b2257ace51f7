// What is P3P's own, beside the contract of all solvers: exactness, and the positions in which solutions coincide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "hybridgv/absolute_pose/methods.hpp"

namespace hybridgv {
namespace test {
namespace {

using Eigen::Vector3d;

FocalPoses solve(const MinimalProblem& problem) { return absolute_pose::p3p(makeAdapter(problem), problem.truth.focalLength); }

// Three points that a query sees from the position, in the direction in which all are in front of it.
MinimalProblem problemOf(Random& random, const Vector3d (&points)[3], const Vector3d& position) {
  MinimalProblem problem;
  problem.truth.focalLength = 800;
  problem.truth.position = position;
  const Vector3d z = ((points[0] + points[1] + points[2]) / 3 - position).normalized();
  const Vector3d x = z.cross(random.direction()).normalized();
  problem.truth.rotation << x, z.cross(x), z;
  for (const Vector3d& point : points) problem.points.push_back(makePointMatch(problem.truth, point));
  return problem;
}

// How many of the problems are solved to an accuracy; all that is returned must be a solution.
int countFound(int count, double accuracy, const std::function<MinimalProblem(Random&)>& make) {
  int found = 0;
  for (int i = 0; i < count; ++i) {
    Random random(testSeed() + 40, static_cast<std::uint64_t>(i));
    const MinimalProblem problem = make(random);
    const FocalPoses poses = solve(problem);
    found += distanceToNearest(poses, problem.truth) < accuracy;
    for (const FocalPose& pose : poses) EXPECT_LT(largestResidual(problem, pose, 3), 1e-4) << "problem " << i;
    EXPECT_TRUE(areDistinct(poses, 1e-7)) << "problem " << i;
  }
  return found;
}

TEST(P3p, FindsTheTruthAndReturnsOnlySolutions) {
  EXPECT_GE(countFound(20000, 1e-6, [](Random& random) { return makeMinimalProblem(random, {}, 3); }), 19999);
}

// Both ends of the cubic vanish where the circles through the query and two of the points have one radius.
TEST(P3p, FindsThePoseFromTheAxisOfAnEquilateralTriangle) {
  EXPECT_EQ(countFound(2000, 1e-6,
                       [](Random& random) {
                         const double d = random.uniform(-1, 0.7);
                         const Vector3d points[3] = {{d, 1, 1}, {1, d, 1}, {1, 1, d}};
                         return problemOf(random, points, Vector3d::Constant(random.uniform(-20, -5)));
                       }),
            2000);
}

TEST(P3p, FindsThePoseThatSeesAnIsoscelesTriangleSymmetrically) {
  EXPECT_EQ(countFound(2000, 1e-6,
                       [](Random& random) {
                         const double a = random.uniform(0.2, 1), b = random.uniform(0.2, 1);
                         const Vector3d points[3] = {{-a, 0, 0}, {a, 0, 0}, {0, b, random.uniform(-1, 1)}};
                         return problemOf(random, points, {0, random.uniform(-3, 3), random.uniform(-8, -4)});
                       }),
            2000);
}

// On the cylinder over the circumcircle and above a vertex two solutions coincide: they are determined to half the digits.
TEST(P3p, FindsDoubleSolutions) {
  const auto onCylinder = [](Random& random) {
    Vector3d points[3];
    const double turn = random.uniform(0, 2 * Random::kPi);
    for (int i = 0; i < 3; ++i) {
      const double angle = turn + 2 * Random::kPi / 3 * (i + random.uniform(-0.2, 0.2));
      points[i] = {std::cos(angle), std::sin(angle), 0};
    }
    const double angle = random.uniform(0, 2 * Random::kPi);
    return problemOf(random, points, {std::cos(angle), std::sin(angle), random.uniform(-8, -3)});
  };
  const auto aboveVertex = [](Random& random) {
    const Vector3d points[3] = {random.vector(-1, 1), random.vector(-1, 1), random.vector(-1, 1)};
    const Vector3d normal = (points[1] - points[0]).cross(points[2] - points[0]).normalized();
    return problemOf(random, points, points[0] + random.uniform(3, 8) * normal);
  };
  EXPECT_GE(countFound(2000, 1e-3, onCylinder), 1980);
  EXPECT_GE(countFound(2000, 1e-3, aboveVertex), 1960);
}

// One point is far from the other two, the more so the thinner the triangle. Whatever is returned is a rotation to rounding.
TEST(P3p, PosesFromThinTrianglesAreRotations) {
  int poses = 0;
  for (const double thin : {1e-4, 1e-6, 1e-8, 1e-10, 1e-11})
    for (std::uint64_t i = 0; i < 200; ++i) {
      Random random(testSeed() + 41, i);
      MinimalProblem problem;
      problem.truth.focalLength = 1000;
      problem.truth.rotation = random.rotation();
      for (const double depth : {1 / thin, random.uniform(1, 2), random.uniform(1, 2)}) {
        const Vector3d ray(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 1);
        problem.points.push_back(makePointMatch(problem.truth, problem.truth.rotation * (depth * ray)));
      }
      for (const FocalPose& pose : solve(problem)) {
        EXPECT_LT((pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-13) << thin << ", " << i;
        EXPECT_GT(pose.rotation.determinant(), 0);
        ++poses;
      }
    }
  EXPECT_GT(poses, 100) << "there is something to check";
}

// Homogeneous image points are bearing vectors, of any angle below 90 degrees.
TEST(P3p, TakesBearingVectors) {
  Random random(testSeed(), 41);
  for (int trial = 0; trial < 200; ++trial) {
    const FocalPose truth = cameraLookingAtOrigin(random, random.uniform(1, 3), 1);
    std::vector<Vector3d> bearings, points;
    while (points.size() < 3) {
      const Vector3d point = random.vector(-5, 5), seen = toCamera(truth, point);
      if (seen[2] < 0.02 * seen.norm()) continue;
      points.push_back(point);
      bearings.push_back(seen.normalized());
    }
    const FocalPoses poses = absolute_pose::p3p(NoncentralHybridAdapter({}, {}, {}, {}, {}, bearings, points), 1);
    EXPECT_LT(distanceToNearest(poses, truth), 1e-5) << trial;
  }
}

TEST(P3p, ReturnsAtMostFourPosesWithTheGivenFocalLength) {
  Random random(testSeed(), 42);
  std::size_t most = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const MinimalProblem problem = makeMinimalProblem(random, {}, 3);
    const FocalPoses poses = absolute_pose::p3p(makeAdapter(problem), problem.truth.focalLength, {2, 0, 1});
    most = std::max(most, poses.size());
    for (const FocalPose& pose : poses) EXPECT_EQ(pose.focalLength, problem.truth.focalLength);
  }
  EXPECT_EQ(most, 4u);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

#include "hybridgv/hybrid_pose/residuals.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "MinimalProblem.hpp"
#include "hybridgv/distortion.hpp"

namespace hybridgv {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using hybrid_pose::reprojectionError;
using hybrid_pose::sampsonError;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Pair {
  FocalPose query, map;
  Vector3d point;
};

Pair randomPair(test::Random& random) {
  Pair pair;
  pair.query = test::cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000));
  pair.map = test::cameraLookingAtOrigin(random, random.uniform(15, 25), random.uniform(500, 2000));
  do pair.point = random.vector(-5, 5);
  while (!test::isVisible(pair.query, pair.point) || !test::isVisible(pair.map, pair.point));
  return pair;
}

Vector3d homogeneous(const Vector2d& pixel) { return {pixel[0], pixel[1], 1}; }

double sampson(const Pair& pair, double distortion, const Vector2d& inQuery, const Vector2d& inMap) {
  const Vector3d bearing(inMap[0], inMap[1], pair.map.focalLength);
  return sampsonError(pair.query, distortion, homogeneous(inQuery), bearing, pair.map.position, pair.map.rotation,
                      pair.map.focalLength);
}

// Image points of these scenes are at most 700 px from the principal point.
constexpr double kDistortions[] = {-6e-7, -1e-7, 0, 3e-7};

TEST(ReprojectionError, IsTheDistanceToTheProjection) {
  test::Random random(test::testSeed(), 1);
  for (int i = 0; i < 100; ++i) {
    const Pair pair = randomPair(random);
    const Vector2d offset(random.uniform(-20, 20), random.uniform(-20, 20));
    const Vector3d observed = homogeneous(test::project(pair.query, pair.point) + offset);
    EXPECT_NEAR(reprojectionError(pair.query, observed, pair.point), offset.norm(), 1e-9);
    EXPECT_NEAR(reprojectionError(pair.query, -3 * observed, pair.point), offset.norm(), 1e-9);
  }
}

TEST(ReprojectionError, IsMeasuredInTheDistortedImage) {
  test::Random random(test::testSeed(), 8);
  for (const double distortion : kDistortions)
    for (int i = 0; i < 30; ++i) {
      const Pair pair = randomPair(random);
      const Vector3d seen = *distort(distortion, homogeneous(test::project(pair.query, pair.point)));
      const Vector2d offset(random.uniform(-20, 20), random.uniform(-20, 20));
      const Vector3d observed = seen + Vector3d(offset[0], offset[1], 0);
      EXPECT_NEAR(reprojectionError(pair.query, distortion, observed, pair.point), offset.norm(), 1e-9);
    }
}

TEST(ReprojectionError, IsInfiniteWhereTheLensSeesNothing) {
  test::Random random(test::testSeed(), 9);
  const Pair pair = randomPair(random);
  const Vector3d exact = homogeneous(test::project(pair.query, pair.point));
  const double beyond = 0.26 / exact.head<2>().squaredNorm();
  EXPECT_EQ(reprojectionError(pair.query, beyond, exact, pair.point), kInfinity);
  EXPECT_EQ(reprojectionError(pair.query, NAN, exact, pair.point), kInfinity);
}

TEST(ReprojectionError, IsInfiniteForPointsNotInFrontAndForNonFiniteInput) {
  test::Random random(test::testSeed(), 2);
  const Pair pair = randomPair(random);
  const Vector3d observed = homogeneous(test::project(pair.query, pair.point));
  EXPECT_EQ(reprojectionError(pair.query, observed, 2 * pair.query.position - pair.point), kInfinity);
  EXPECT_EQ(reprojectionError(pair.query, observed, pair.query.position), kInfinity);
  EXPECT_EQ(reprojectionError(pair.query, observed, {NAN, 0, 0}), kInfinity);
  EXPECT_EQ(reprojectionError(pair.query, {0, 0, 0}, pair.point), kInfinity);
}

// The smallest joint move of both pixels that satisfies the epipolar constraint, by Newton's method on the constraint along its
// gradient: the Sampson error is its first step.
TEST(SampsonError, IsToFirstOrderTheDistanceToTheEpipolarConstraint) {
  test::Random random(test::testSeed(), 3);
  for (int i = 0; i < 200; ++i) {
    const Pair pair = randomPair(random);
    const double distortion = kDistortions[i % 4];
    const Vector2d q = distort(distortion, homogeneous(test::project(pair.query, pair.point)))->head<2>();
    const Vector2d m = test::project(pair.map, pair.point);
    EXPECT_LT(sampson(pair, distortion, q, m), 1e-7);

    // The constraint as a function of the four pixel coordinates, and its gradient by differences.
    const auto constraint = [&](const Vector2d& x, const Vector2d& y) {
      const Vector3d pinhole = undistort(distortion, homogeneous(x));
      const Vector3d w = pair.query.rotation * Vector3d(pinhole[0], pinhole[1], pair.query.focalLength);
      const Vector3d d = pair.map.rotation * Vector3d(y[0], y[1], pair.map.focalLength);
      return w.dot((pair.map.position - pair.query.position).cross(d));
    };
    const double h = 1e-3;
    Eigen::Matrix<double, 4, 1> gradient;
    for (int k = 0; k < 2; ++k) {
      const Vector2d e = h * Vector2d::Unit(k);
      gradient[k] = (constraint(q + e, m) - constraint(q - e, m)) / (2 * h);
      gradient[k + 2] = (constraint(q, m + e) - constraint(q, m - e)) / (2 * h);
    }
    const double move = random.uniform(0.001, 0.01);
    const Vector2d dq = move * gradient.head<2>().normalized() * gradient.head<2>().norm() / gradient.norm();
    const Vector2d dm = move * gradient.tail<2>() / gradient.norm();
    EXPECT_NEAR(sampson(pair, distortion, q + dq, m + dm), move, 1e-3 * move);
    EXPECT_NEAR(sampson(pair, distortion, q - dq, m - dm), move, 1e-3 * move);
  }
}

TEST(SampsonError, TakesTheQueryFocalLengthWhereTheRigCamerasIsUnknown) {
  test::Random random(test::testSeed(), 4);
  for (int i = 0; i < 20; ++i) {
    const Pair pair = randomPair(random);
    const Vector3d q = homogeneous(test::project(pair.query, pair.point) + Vector2d(3, -4));
    const Vector3d b = pair.map.rotation.transpose() * (pair.point - pair.map.position);
    const auto error = [&](double g) { return sampsonError(pair.query, q, b, pair.map.position, pair.map.rotation, g); };
    EXPECT_EQ(error(0), error(pair.query.focalLength));
    EXPECT_GT(error(2 * pair.query.focalLength), error(pair.query.focalLength));
  }
}

TEST(SampsonError, DoesNotDependOnTheLengthsOfItsHomogeneousArguments) {
  test::Random random(test::testSeed(), 5);
  const Pair pair = randomPair(random);
  const Vector3d q = homogeneous(test::project(pair.query, pair.point) + Vector2d(3, -4));
  const Vector3d b = pair.map.rotation.transpose() * (pair.point - pair.map.position);
  const auto error = [&](double sq, double sb) {
    return sampsonError(pair.query, sq * q, sb * b, pair.map.position, pair.map.rotation, 800);
  };
  EXPECT_NEAR(error(-2, 0.1), error(1, 1), 1e-9);
}

TEST(SampsonError, IsInfiniteUnlessTheRaysMeetInFrontOfBothCameras) {
  test::Random random(test::testSeed(), 6);
  const Pair pair = randomPair(random);
  const Vector3d q = homogeneous(test::project(pair.query, pair.point));
  const Vector3d b = pair.map.rotation.transpose() * (pair.point - pair.map.position);
  FocalPose turned = pair.query;
  turned.rotation = pair.query.rotation * Eigen::Vector3d(-1, -1, 1).asDiagonal();
  EXPECT_EQ(sampsonError(pair.query, q, -b, pair.map.position, pair.map.rotation, 0), kInfinity) << "behind the map camera";
  FocalPose behind = pair.query;
  behind.position = 2 * pair.point - pair.query.position;
  EXPECT_EQ(sampsonError(behind, q, b, pair.map.position, pair.map.rotation, 0), kInfinity) << "behind the query";
  EXPECT_EQ(sampsonError(pair.query, q, b, pair.query.position, pair.map.rotation, 0), kInfinity) << "equal centres";
  const double unseen = -1.01 / q.head<2>().squaredNorm();
  EXPECT_EQ(sampsonError(pair.query, unseen, q, b, pair.map.position, pair.map.rotation, 0), kInfinity) << "seen nowhere";
  EXPECT_EQ(sampsonError(pair.query, NAN, q, b, pair.map.position, pair.map.rotation, 0), kInfinity);
  EXPECT_EQ(sampsonError(pair.query, {NAN, 0, 1}, b, pair.map.position, pair.map.rotation, 0), kInfinity);
  EXPECT_EQ(sampsonError(pair.query, q, Vector3d::Zero(), pair.map.position, pair.map.rotation, 0), kInfinity);
}

// Omnidirectional cameras: turning a camera so that the ray points backwards leaves a valid correspondence, and near the optical
// axis the pinhole image and the tangent plane of the sphere agree.
TEST(SampsonError, AcceptsBearingVectorsThatPointBackwards) {
  test::Random random(test::testSeed(), 7);
  for (int i = 0; i < 100; ++i) {
    const Pair pair = randomPair(random);
    const Vector3d exact = homogeneous(test::project(pair.query, pair.point));
    const Vector3d q = exact + Vector3d(random.uniform(-5, 5), random.uniform(-5, 5), 0);
    Matrix3d towards;  // rig camera whose axis is the ray
    towards.col(2) = (pair.point - pair.map.position).normalized();
    towards.col(0) = towards.col(2).unitOrthogonal();
    towards.col(1) = towards.col(2).cross(towards.col(0));
    const Matrix3d away = towards * Vector3d(1, -1, -1).asDiagonal();
    EXPECT_LT(sampsonError(pair.query, exact, -Vector3d::UnitZ(), pair.map.position, away, 1000), 1e-6);
    const double forwards = sampsonError(pair.query, q, Vector3d::UnitZ(), pair.map.position, towards, 1000);
    const double backwards = sampsonError(pair.query, q, -Vector3d::UnitZ(), pair.map.position, away, 1000);
    EXPECT_NEAR(backwards, forwards, 1e-9 * (1 + forwards));
  }
}

}  // namespace
}  // namespace hybridgv

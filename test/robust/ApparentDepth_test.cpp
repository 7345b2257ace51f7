#include "robust/ApparentDepth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "HybridScene.hpp"
#include "hybridgv/distortion.hpp"

namespace hybridgv {
namespace {

using namespace robust;
using correspondences::RayMatch;

// What a query sees of a point on a viewing ray of a rig camera.
struct Meeting {
  Meeting(test::Random& random, double distortion) : pose(test::cameraLookingAtOrigin(random, 20, random.uniform(500, 2000))) {
    pose.distortion = distortion;
    point = random.vector(-4, 4);
    ray.centre = pose.position + random.uniform(0.1, 20) * random.direction();
    ray.direction = (point - ray.centre).normalized();
    const std::optional<Eigen::Vector3d> seen = distort(distortion, test::project(pose, point).homogeneous());
    ray.u = seen->x();
    ray.v = seen->y();
    inverse = 1 / pose.rotation.col(2).dot(point - pose.position);
  }
  // The place where the point on the ray at another depth is seen.
  std::optional<Eigen::Vector2d> placeAt(double inverseDepth) const {
    const double along =
        (1 / inverseDepth - pose.rotation.col(2).dot(ray.centre - pose.position)) / pose.rotation.col(2).dot(ray.direction);
    const std::optional<Eigen::Vector3d> seen =
        distort(pose.distortion, test::project(pose, ray.centre + along * ray.direction).homogeneous());
    return seen ? std::optional<Eigen::Vector2d>(seen->head<2>()) : std::nullopt;
  }

  QueryPose pose;
  Eigen::Vector3d point;
  RayMatch ray{};
  double inverse;
};

class ApparentDepthOf : public testing::TestWithParam<double> {};

TEST_P(ApparentDepthOf, IsThatOfThePoint) {
  test::Random random(test::testSeed(), 160);
  for (int i = 0; i < 1000; ++i) {
    const Meeting meeting(random, GetParam());
    const ApparentDepth depth = apparentDepth(meeting.ray, meeting.pose);
    EXPECT_NEAR(depth.inverse / meeting.inverse, 1, 1e-6);
  }
}

TEST_P(ApparentDepthOf, PlaceIsThePoint) {
  test::Random random(test::testSeed(), 165);
  for (int i = 0; i < 1000; ++i) {
    const Meeting meeting(random, GetParam());
    const std::optional<ApparentPlace> place = apparentPlace(meeting.ray, meeting.pose);
    ASSERT_TRUE(place);
    const double distance = (meeting.point - meeting.pose.position).norm();
    EXPECT_NEAR((place->position - meeting.point).norm() / distance, 0, 1e-5);
    EXPECT_NEAR(place->perPixel.cross(meeting.point - meeting.pose.position).norm(), 0, 1e-5 * place->perPixel.norm() * distance);
  }
}

TEST(ApparentPlace, IsNoneInTheRigCameraAndBehindTheQuery) {
  test::Random random(test::testSeed(), 166);
  for (int i = 0; i < 100; ++i) {
    Meeting meeting(random, 0);
    QueryPose turned = meeting.pose;
    turned.rotation = turned.rotation * Eigen::AngleAxisd(3.14159265, Eigen::Vector3d::UnitY()).toRotationMatrix();
    meeting.ray.v = -meeting.ray.v;
    EXPECT_FALSE(apparentPlace(meeting.ray, turned));
    meeting.ray.centre = meeting.pose.position;
    EXPECT_FALSE(apparentPlace(meeting.ray, meeting.pose));
  }
}

TEST_P(ApparentDepthOf, ThePlaceMovesAsThePointOnTheRayDoes) {
  test::Random random(test::testSeed(), 161);
  int seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const Meeting meeting(random, GetParam());
    const double other = meeting.inverse * random.uniform(0.5, 2);
    const std::optional<Eigen::Vector2d> moved = movedToDepth(meeting.ray, meeting.pose, other), there = meeting.placeAt(other);
    ASSERT_EQ(moved.has_value(), there.has_value());
    if (!moved) continue;
    ++seen;
    EXPECT_LT((*moved - *there).norm(), 1e-6 * (1 + there->norm()));
  }
  EXPECT_GT(seen, 900);
}

INSTANTIATE_TEST_SUITE_P(, ApparentDepthOf, testing::Values(0., -1e-7, 1e-8));

TEST(ApparentDepth, ChangesWithTheImagePointAsItSays) {
  test::Random random(test::testSeed(), 162);
  for (int i = 0; i < 1000; ++i) {
    Meeting meeting(random, 0);
    const ApparentDepth depth = apparentDepth(meeting.ray, meeting.pose);
    const std::optional<Eigen::Vector2d> ahead = movedToDepth(meeting.ray, meeting.pose, meeting.inverse + depth.perPixel);
    ASSERT_TRUE(ahead);
    EXPECT_NEAR((*ahead - Eigen::Vector2d(meeting.ray.u, meeting.ray.v)).norm(), 1, 1e-6);
  }
}

// Across the line nothing is said about the depth.
TEST(ApparentDepth, AnErrorAcrossTheEpipolarLineChangesNothing) {
  test::Random random(test::testSeed(), 163);
  for (int i = 0; i < 1000; ++i) {
    Meeting meeting(random, 0);
    const Eigen::Vector2d here(meeting.ray.u, meeting.ray.v), along = *meeting.placeAt(0.9 * meeting.inverse) - here;
    const Eigen::Vector2d across = Eigen::Vector2d(-along.y(), along.x()).normalized();
    meeting.ray.u += across.x();
    meeting.ray.v += across.y();
    EXPECT_NEAR(apparentDepth(meeting.ray, meeting.pose).inverse / meeting.inverse, 1, 1e-6);
  }
}

TEST(ApparentDepth, WhereTheQueryIsInTheRigCameraItIsUnknown) {
  test::Random random(test::testSeed(), 164);
  Meeting meeting(random, 0);
  meeting.ray.centre = meeting.pose.position;
  meeting.ray.direction = (meeting.point - meeting.ray.centre).normalized();
  EXPECT_EQ(apparentDepth(meeting.ray, meeting.pose).perPixel, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(movedToDepth(meeting.ray, meeting.pose, 1));
}

TEST(ApparentDepth, WithoutAViewingDirectionThePlaceDoesNotMove) {
  test::Random random(test::testSeed(), 165);
  Meeting meeting(random, 0);
  meeting.ray.u = 1000;
  meeting.pose.distortion = -2e-6;
  EXPECT_FALSE(movedToDepth(meeting.ray, meeting.pose, meeting.inverse));
}

}  // namespace
}  // namespace hybridgv

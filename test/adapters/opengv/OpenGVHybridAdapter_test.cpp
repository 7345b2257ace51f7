#include "hybridgv/adapters/OpenGVHybridAdapter.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/NoncentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#include <opengv/relative_pose/NoncentralRelativeAdapter.hpp>
#include <type_traits>

#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "expectRefused.hpp"
#include "hybridgv/absolute_pose/methods.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"

namespace hybridgv {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using opengv::absolute_pose::CentralAbsoluteAdapter;
using opengv::absolute_pose::NoncentralAbsoluteAdapter;
using opengv::relative_pose::NoncentralRelativeAdapter;

// The data of OpenGV's adapters for a problem; bearing vectors of the query formed with the nominal focal length. OpenGV keeps
// the cameras of both viewpoints in one list: the last one is the query.
struct OpenGVData {
  OpenGVData(const test::MinimalProblem& problem, test::Random& random, double nominalFocalLength) {
    for (const solvers::RayMatch& ray : problem.rays) {
      while (offsets.size() <= static_cast<std::size_t>(ray.camera)) {
        offsets.push_back(ray.centre);
        rotations.push_back(random.rotation());
      }
      const auto camera = static_cast<std::size_t>(ray.camera);
      bearings1.push_back(rotations[camera].transpose() * ray.direction);
      bearings2.push_back(Vector3d(ray.u, ray.v, nominalFocalLength).normalized());
      cameras1.push_back(ray.camera);
    }
    cameras2.assign(problem.rays.size(), static_cast<int>(offsets.size()));
    offsets.push_back(Vector3d::Zero());
    rotations.push_back(Matrix3d::Identity());
    for (const solvers::PointMatch& match : problem.points) {
      bearings.push_back(Vector3d(match.u, match.v, nominalFocalLength).normalized());
      points.push_back(match.point);
    }
  }
  NoncentralRelativeAdapter relative() const { return {bearings1, bearings2, cameras1, cameras2, offsets, rotations}; }

  opengv::bearingVectors_t bearings1, bearings2, bearings;
  std::vector<int> cameras1, cameras2;
  opengv::translations_t offsets;
  opengv::rotations_t rotations;
  opengv::points_t points;
};

TEST(OpenGVHybridAdapter, GivesImagePointsRaysAndPoints) {
  test::Random random(test::testSeed());
  const test::MinimalProblem problem = test::makeMinimalProblem(random, {2, 1}, 2);
  const OpenGVData data(problem, random, 800);
  const NoncentralRelativeAdapter relative = data.relative();
  const CentralAbsoluteAdapter absolute(data.bearings, data.points);
  const OpenGVHybridAdapter adapter(relative, absolute, 800);
  ASSERT_EQ(adapter.getNumberCorrespondences2d2d(), 3u);
  ASSERT_EQ(adapter.getNumberCorrespondences2d3d(), 2u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(adapter.getImagePoint2d2d(i).isApprox(Vector3d(problem.rays[i].u, problem.rays[i].v, 1), 1e-12));
    EXPECT_TRUE((adapter.getCamRotation(i) * adapter.getBearingVector(i)).isApprox(problem.rays[i].direction, 1e-12));
    EXPECT_EQ(adapter.getCamOffset(i), problem.rays[i].centre);
    EXPECT_EQ(adapter.getCamIndex(i), problem.rays[i].camera);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(adapter.getImagePoint2d3d(i).isApprox(Vector3d(problem.points[i].u, problem.points[i].v, 1), 1e-12));
    EXPECT_EQ(adapter.getPoint(i), problem.points[i].point);
  }
}

TEST(OpenGVHybridAdapter, EitherOneIsOptional) {
  test::Random random(test::testSeed());
  const OpenGVData data(test::makeMinimalProblem(random, {2}, 4), random, 1);
  const NoncentralRelativeAdapter relative = data.relative();
  const CentralAbsoluteAdapter absolute(data.bearings, data.points);
  EXPECT_EQ(OpenGVHybridAdapter(relative).getNumberCorrespondences2d2d(), 2u);
  EXPECT_EQ(OpenGVHybridAdapter(relative).getNumberCorrespondences2d3d(), 0u);
  EXPECT_EQ(OpenGVHybridAdapter(absolute).getNumberCorrespondences2d2d(), 0u);
  EXPECT_EQ(OpenGVHybridAdapter(absolute).getNumberCorrespondences2d3d(), 4u);
}

// An adapter of OpenGV need not know how many cameras there are: equal centres are one camera.
TEST(OpenGVHybridAdapter, CamerasAreRecognisedByTheirCentre) {
  test::Random random(test::testSeed());
  OpenGVData data(test::makeMinimalProblem(random, {1, 1, 1, 1, 1}, 0), random, 1);
  data.offsets[2] = data.offsets[0], data.rotations[2] = data.rotations[0];  // the same camera again
  data.offsets[3] = data.offsets[0];                                         // the same centre, another rotation
  const NoncentralRelativeAdapter relative = data.relative();
  const OpenGVHybridAdapter adapter(relative);
  const std::vector<int> expected{0, 1, 0, 0, 2};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(adapter.getCamIndex(i), expected[i]);
}

class WeightedRelative : public NoncentralRelativeAdapter {
 public:
  using NoncentralRelativeAdapter::NoncentralRelativeAdapter;
  explicit WeightedRelative(const NoncentralRelativeAdapter& other) : NoncentralRelativeAdapter(other) {}
  double getWeight(std::size_t index) const override { return 0.5 + static_cast<double>(index); }
};
class WeightedAbsolute : public CentralAbsoluteAdapter {
 public:
  using CentralAbsoluteAdapter::CentralAbsoluteAdapter;
  double getWeight(std::size_t index) const override { return 0.25 + static_cast<double>(index); }
};

TEST(OpenGVHybridAdapter, PassesWeightsOn) {
  test::Random random(test::testSeed());
  const OpenGVData data(test::makeMinimalProblem(random, {2}, 4), random, 1);
  const WeightedRelative relative(data.relative());
  const WeightedAbsolute absolute(data.bearings, data.points);
  const OpenGVHybridAdapter adapter(relative, absolute);
  EXPECT_EQ(adapter.getWeight2d2d(1), 1.5);
  EXPECT_EQ(adapter.getWeight2d3d(3), 3.25);
}

// OpenGV's adapters are referred to, so that temporaries would dangle.
static_assert(std::is_constructible<OpenGVHybridAdapter, const CentralAbsoluteAdapter&>::value, "");
static_assert(!std::is_constructible<OpenGVHybridAdapter, CentralAbsoluteAdapter>::value, "");
static_assert(!std::is_constructible<OpenGVHybridAdapter, NoncentralRelativeAdapter, double>::value, "");
static_assert(!std::is_constructible<OpenGVHybridAdapter, NoncentralRelativeAdapter&, CentralAbsoluteAdapter>::value, "");
static_assert(!std::is_constructible<OpenGVHybridAdapter, NoncentralRelativeAdapter, CentralAbsoluteAdapter&>::value, "");
static_assert(!std::is_constructible<OpenGVHybridAdapter, NoncentralRelativeAdapter, CentralAbsoluteAdapter>::value, "");

TEST(OpenGVHybridAdapter, NamesWhatAPinholeCameraCannotSee) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  test::Random random(test::testSeed());
  const OpenGVData good(test::makeMinimalProblem(random, {3}, 4), random, 1);
  for (const Vector3d& bad : {Vector3d(0, 0, -1), Vector3d(1, 0, 0), Vector3d(nan, 0, 1), Vector3d(0, 0, nan)}) {
    OpenGVData data = good;
    data.bearings2[1] = bad;
    const NoncentralRelativeAdapter relative = data.relative();
    test::expectRefused("getBearingVector2(1)", [&] { OpenGVHybridAdapter adapter(relative); });
    data.bearings[2] = bad;
    const CentralAbsoluteAdapter absolute(data.bearings, data.points);
    test::expectRefused("getBearingVector(2)", [&] { OpenGVHybridAdapter adapter(absolute); });
  }
}

TEST(OpenGVHybridAdapter, TheQueryIsOneCameraInTheOrigin) {
  test::Random random(test::testSeed());
  OpenGVData data(test::makeMinimalProblem(random, {3}, 4), random, 1);
  const NoncentralRelativeAdapter relative = data.relative();
  const std::vector<int> cameras(4, 1);
  const NoncentralAbsoluteAdapter absolute(data.bearings, cameras, data.points, data.offsets, data.rotations);
  data.offsets[1] = Vector3d(0, 0.1, 0);
  test::expectRefused("getCamOffset2(0)", [&] { OpenGVHybridAdapter adapter(relative); });
  test::expectRefused("getCamOffset(0)", [&] { OpenGVHybridAdapter adapter(absolute); });
  data.offsets[1].setZero();
  data.rotations[1] = random.rotation();
  test::expectRefused("getCamRotation2(0)", [&] { OpenGVHybridAdapter adapter(relative); });
  test::expectRefused("getCamRotation(0)", [&] { OpenGVHybridAdapter adapter(absolute); });
}

TEST(OpenGVHybridAdapter, NominalFocalLengthMustBePositive) {
  test::Random random(test::testSeed());
  const OpenGVData data(test::makeMinimalProblem(random, {}, 4), random, 1);
  const CentralAbsoluteAdapter absolute(data.bearings, data.points);
  for (double wrong : {0., -1., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    test::expectRefused("nominalFocalLength", [&] { OpenGVHybridAdapter adapter(absolute, wrong); });
}

double smallestDifference(const opengv::transformations_t& transformations, const FocalPose& pose) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const opengv::transformation_t& t : transformations)
    smallest = std::min(smallest, (t - pose.transformation()).cwiseAbs().maxCoeff());
  return smallest;
}

const FocalPose& nearest(const FocalPoses& poses, const FocalPose& truth) {
  return *std::min_element(poses.begin(), poses.end(), [&](const FocalPose& a, const FocalPose& b) {
    return test::poseDistance(a, truth) < test::poseDistance(b, truth);
  });
}

// Bearing vectors formed with the true focal length: OpenGV knows it, this library finds it, and both must agree on the pose.
// (gp3p is made for rays from different centres and loses digits where they share one: it agrees in most problems only.)
TEST(OpenGVHybridAdapter, SolversAgreeWithOpenGV) {
  test::Random random(test::testSeed());
  int agreeWithGp3p = 0;
  for (int i = 0; i < 50; ++i) {
    const test::MinimalProblem problem = test::makeMinimalProblem(random, {1}, 6);
    const double focalLength = problem.truth.focalLength;
    const OpenGVData data(problem, random, focalLength);
    const NoncentralRelativeAdapter relative = data.relative();
    const CentralAbsoluteAdapter absolute(data.bearings, data.points);
    const OpenGVHybridAdapter adapter(relative, absolute, focalLength);
    for (const FocalPoses& poses : {absolute_pose::p4pf(adapter), hybrid_pose::h13f(adapter)}) {
      ASSERT_FALSE(poses.empty()) << "problem " << i;
      const FocalPose& pose = nearest(poses, problem.truth);
      EXPECT_NEAR(pose.focalLength / focalLength, 1, 1e-6) << "problem " << i;
      EXPECT_LT(smallestDifference(opengv::absolute_pose::p3p_kneip(absolute), pose), 1e-5) << "problem " << i;
      EXPECT_LT(smallestDifference(opengv::absolute_pose::upnp(absolute), pose), 1e-5) << "problem " << i;
      agreeWithGp3p += smallestDifference(opengv::absolute_pose::gp3p(absolute), pose) < 1e-4;
    }
  }
  EXPECT_GT(agreeWithGp3p, 60) << "of 100";
}

// With bearing vectors of a wrong nominal focal length f0, the result is f/f0 in the unit 1 and f in the unit of f0.
TEST(OpenGVHybridAdapter, FocalLengthHasTheUnitOfTheNominalOne) {
  test::Random random(test::testSeed());
  const test::MinimalProblem problem = test::makeMinimalProblem(random, {1}, 3);
  const OpenGVData data(problem, random, 700);
  const NoncentralRelativeAdapter relative = data.relative();
  const CentralAbsoluteAdapter absolute(data.bearings, data.points);
  EXPECT_TRUE(test::hasFocalPoseNear(hybrid_pose::h13f(OpenGVHybridAdapter(relative, absolute, 700)), problem.truth, 1e-6));
  FocalPose inUnitOne = problem.truth;
  inUnitOne.focalLength /= 700;
  EXPECT_TRUE(test::hasFocalPoseNear(hybrid_pose::h13f(OpenGVHybridAdapter(relative, absolute)), inUnitOne, 1e-6));
}

}  // namespace
}  // namespace hybridgv

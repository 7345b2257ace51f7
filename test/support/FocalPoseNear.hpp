// Whether poses are the expected ones, as assertions that say what differs: EXPECT_TRUE(isFocalPoseNear(pose, truth, 1e-6)).
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace test {

inline testing::AssertionResult describeDifference(bool holds, const FocalPose& pose, const FocalPose& expected) {
  return (holds ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "rotations differ by " << (pose.rotation - expected.rotation).norm() << ", focal lengths by "
         << 100 * (pose.focalLength / expected.focalLength - 1) << " % (" << pose.focalLength << " instead of "
         << expected.focalLength << "), positions by " << (pose.position - expected.position).norm() << " ("
         << pose.position.transpose() << " instead of " << expected.position.transpose() << ")";
}

// Within `tolerance` of the expected pose by poseDistance, and within `positionTolerance` in position.
inline testing::AssertionResult isFocalPoseNear(const FocalPose& pose, const FocalPose& expected, double tolerance,
                                                double positionTolerance = std::numeric_limits<double>::infinity()) {
  const double moved = (pose.position - expected.position).norm();
  const bool isNear = poseDistance(pose, expected) < tolerance && moved <= positionTolerance;
  return describeDifference(isNear, pose, expected);
}

// One of the poses is within `tolerance` of the expected one.
inline testing::AssertionResult hasFocalPoseNear(const FocalPoses& poses, const FocalPose& expected, double tolerance) {
  const FocalPose* nearest = nullptr;
  for (const FocalPose& pose : poses)
    if (!nearest || poseDistance(pose, expected) < poseDistance(*nearest, expected)) nearest = &pose;
  if (!nearest) return testing::AssertionFailure() << "there are no poses";
  return isFocalPoseNear(*nearest, expected, tolerance) << ", the nearest of " << poses.size() << " poses";
}

// No pose is there twice.
inline testing::AssertionResult areDistinct(const FocalPoses& poses, double tolerance) {
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!(poseDistance(poses[i], poses[j]) > tolerance))
        return describeDifference(false, poses[i], poses[j]) << ", poses " << j << " and " << i << " of " << poses.size();
  return testing::AssertionSuccess();
}

// Both lists hold the same poses.
inline void expectSamePoses(const FocalPoses& a, const FocalPoses& b, double tolerance) {
  EXPECT_EQ(a.size(), b.size());
  for (const FocalPose& pose : a) EXPECT_TRUE(hasFocalPoseNear(b, pose, tolerance));
}

}  // namespace test
}  // namespace hybridgv

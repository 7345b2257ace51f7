// Results that are equal to the last bit.
#pragma once

#include <gtest/gtest.h>

#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace test {

inline void expectEqual(const sac::HybridRansacResult& a, const sac::HybridRansacResult& b) {
  EXPECT_EQ(a.success, b.success);
  EXPECT_EQ(a.pose.rotation, b.pose.rotation);
  EXPECT_EQ(a.pose.position, b.pose.position);
  EXPECT_EQ(a.pose.focalLength, b.pose.focalLength);
  EXPECT_EQ(a.distortion, b.distortion);
  EXPECT_EQ(a.simpleRadialK1StandardDeviation, b.simpleRadialK1StandardDeviation);
  EXPECT_EQ(a.inliers2d2d, b.inliers2d2d);
  EXPECT_EQ(a.inliers2d3d, b.inliers2d3d);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.iterationsPerSolver, b.iterationsPerSolver);
  EXPECT_EQ(a.localOptimizations, b.localOptimizations);
  EXPECT_EQ(a.score, b.score);
  EXPECT_EQ(a.covariance, b.covariance);
}

}  // namespace test
}  // namespace hybridgv

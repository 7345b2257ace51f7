#include "robust/PrincipalAxes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "Random.hpp"

namespace hybridgv {
namespace robust {
namespace {

TEST(PrincipalAxes, AreThoseOfABox) {
  test::Random random(test::testSeed(), 9850);
  const Eigen::Matrix3d rotation = random.rotation();
  const Eigen::Vector3d centre = random.vector(-100, 100);
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d corner(k & 1 ? 1 : -1, k & 2 ? 5 : -5, k & 4 ? 0.1 : -0.1);
    corners.push_back(centre + rotation * corner);
  }
  const PrincipalAxes axes(corners);
  EXPECT_NEAR((axes.centre - centre).norm(), 0, 1e-12 * centre.norm());
  EXPECT_NEAR((axes.deviations - Eigen::Vector3d(0.1, 1, 5)).norm(), 0, 1e-9);
  EXPECT_NEAR(std::abs(axes.directions.col(0).dot(rotation.col(2))), 1, 1e-9);
  EXPECT_NEAR(std::abs(axes.directions.col(2).dot(rotation.col(1))), 1, 1e-9);
}

TEST(PrincipalAxes, OfOnePlaceHaveNoExtent) {
  for (const std::size_t count : {1, 5}) {
    const PrincipalAxes axes(std::vector<Eigen::Vector3d>(count, Eigen::Vector3d(1, 2, 3)));
    EXPECT_LT(axes.deviations.maxCoeff(), 1e-7);
    EXPECT_TRUE(axes.directions.allFinite());
  }
}

}  // namespace
}  // namespace robust
}  // namespace hybridgv

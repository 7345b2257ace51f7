#include "hybridgv/distortion.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "Random.hpp"

namespace hybridgv {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 600;

// Distortions from strong barrel to strong pincushion, in units of 1 / kRadius^2.
constexpr double kDistortions[] = {-0.7, -0.3, -0.05, -1e-9, 0, 1e-9, 0.1, 0.3};

TEST(Distortion, DistortAndUndistortAreInverse) {
  test::Random random(test::testSeed(), 1);
  for (const double lambda : kDistortions)
    for (int i = 0; i < 100; ++i) {
      const double c = lambda / (kRadius * kRadius);
      const Vector3d seen(random.uniform(-400, 400), random.uniform(-400, 400), 1);
      const std::optional<Vector3d> back = distort(c, undistort(c, seen));
      ASSERT_TRUE(back.has_value());
      EXPECT_LT((*back - seen).norm(), 1e-10);
      EXPECT_LT((undistort(c, -2 * seen) - undistort(c, seen)).norm(), 1e-12) << "of a multiple";
    }
}

TEST(Distortion, BarrelDistortionPullsTowardsTheCentre) {
  const Vector3d point(300, -400, 1);
  EXPECT_LT(distort(-1e-6, point)->norm(), point.norm());
  EXPECT_GT(distort(1e-7, point)->norm(), point.norm());
  EXPECT_EQ(*distort(0, point), point);
  EXPECT_EQ(undistort(0, point), point);
}

TEST(Distortion, WhatCannotBeSeenHasNoImagePoint) {
  EXPECT_FALSE(distort(1e-6, {500, 0, 1}).has_value());
  EXPECT_FALSE(distort(1e-6, {NAN, 0, 1}).has_value());
  EXPECT_FALSE(distort(1e-6, {1, 0, 0}).has_value());
  EXPECT_TRUE(distort(1e-6, {499, 0, 1}).has_value());
  EXPECT_EQ(undistort(-1e-6, {1000, 0, 1}), Vector3d(1000, 0, 0));
}

TEST(Distortion, WhatIsNotFiniteHasNoImagePointAndIsNoLens) {
  for (const double wrong : {NAN, INFINITY, -INFINITY}) {
    EXPECT_EQ(undistort(wrong, {3, 4, 1}), Vector3d::Zero());
    EXPECT_EQ(undistort(1e-7, {wrong, 4, 1}), Vector3d::Zero());
    EXPECT_FALSE(distort(wrong, {3, 4, 1}).has_value());
    EXPECT_THROW(toSimpleRadial(wrong, -1e-7, {1, 2}), std::invalid_argument);
    EXPECT_THROW(toSimpleRadial(800, wrong, {1, 2}), std::invalid_argument);
    EXPECT_EQ(toSimpleRadial(800, -1e-7, {100, 200, wrong}).k1, 0);
  }
  EXPECT_EQ(undistort(1e-7, {3, 4, 0}), Vector3d::Zero());
  EXPECT_THROW(toSimpleRadial(0, -1e-7, {1, 2}), std::invalid_argument);
}

TEST(SimpleRadialModel, IsThatOfTheLensWhereTheImagePointsAre) {
  for (const double lambda : {-0.3, -0.05, -1e-9, 0., 1e-9, 0.1}) {
    const double c = lambda / (kRadius * kRadius), focalLength = 900;
    std::vector<double> radii;
    for (int i = 1; i <= 100; ++i) radii.push_back(kRadius * i / 100);
    const SimpleRadial model = toSimpleRadial(focalLength, c, radii);
    double largest = 0;
    for (const double r : radii) {
      const double x = r / (1 + c * r * r) / focalLength;
      largest = std::max(largest, std::abs(model.focalLength * x * (1 + model.k1 * x * x) - r));
    }
    EXPECT_LT(largest, 200 * lambda * lambda + 1e-9) << lambda;
    if (std::abs(lambda) < 0.01) {
      EXPECT_NEAR(model.k1, c * focalLength * focalLength, 1e-6 + 1e-3 * std::abs(lambda));
    }
    EXPECT_EQ(std::signbit(model.k1), lambda < 0) << lambda;
  }
}

// A lens of the model SIMPLE_RADIAL, for which the best division model is known: the way there and back gives k1 again.
TEST(SimpleRadialModel, RecoversKnownLenses) {
  for (const double k1 : {-0.2, -0.05, 0.1}) {
    // The division model with the least squares of the radii, by a search over c and f.
    const double focalLength = 1000;
    std::vector<double> radii, xs;
    for (int i = 1; i <= 200; ++i) {
      const double x = 0.6 * i / 200;
      xs.push_back(x);
      radii.push_back(focalLength * x * (1 + k1 * x * x));
    }
    double c = k1 / (focalLength * focalLength), f = focalLength;
    for (int step = 0; step < 50; ++step) {
      Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
      Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
      for (std::size_t i = 0; i < xs.size(); ++i) {
        const double U = f * xs[i], root = std::sqrt(1 - 4 * c * U * U), r = 2 * U / (1 + root);
        const double byU = (1 + c * r * r) * (1 + c * r * r) / (1 - c * r * r), byC = r * r * r / (1 - c * r * r);
        const Eigen::Vector2d j(byU * xs[i], byC * 1e-6);
        normal += j * j.transpose();
        gradient += (r - radii[i]) * j;
      }
      const Eigen::Vector2d move = -normal.inverse() * gradient;
      f += move[0];
      c += 1e-6 * move[1];
    }
    const SimpleRadial model = toSimpleRadial(f, c, radii);
    EXPECT_NEAR(model.k1, k1, 0.03 * std::abs(k1));
    EXPECT_NEAR(model.focalLength, focalLength, 0.003 * focalLength);
  }
}

TEST(SimpleRadialModel, IsAPinholeWhereTheRadiiSayNothing) {
  for (const std::vector<double>& radii : {std::vector<double>{}, {0, 0}, {100, 100, 100}, {100, 1e6}}) {
    const SimpleRadial model = toSimpleRadial(800, -1e-7, radii);
    EXPECT_EQ(model.focalLength, 800);
    EXPECT_EQ(model.k1, 0);
  }
}

}  // namespace
}  // namespace hybridgv

#include "hybridgv/adapters/sfm/Camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "SfmScene.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Eigen::Vector3d;
using test::makeCamera;

class CameraModels : public ::testing::TestWithParam<CameraModel> {};

TEST_P(CameraModels, UndistortAndDistortAreInverse) {
  test::Random random(test::testSeed());
  const Camera camera = makeCamera(GetParam());
  const double f = focalLength(camera);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d imagePoint(f * random.uniform(-0.7, 0.7), f * random.uniform(-0.5, 0.5), 1);
    const auto pixel = distort(camera, imagePoint);
    ASSERT_TRUE(pixel) << imagePoint.transpose();
    const auto back = undistort(camera, (*pixel)[0], (*pixel)[1]);
    ASSERT_TRUE(back) << imagePoint.transpose();
    EXPECT_LT((*back - imagePoint).norm(), 1e-9 * f) << imagePoint.transpose();
  }
}

TEST_P(CameraModels, PrincipalPointIsTheOrigin) {
  const auto pixel = distort(makeCamera(GetParam()), Vector3d(0, 0, 1));
  ASSERT_TRUE(pixel);
  const auto back = undistort(makeCamera(GetParam()), (*pixel)[0], (*pixel)[1]);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, Vector3d(0, 0, 1));
}

TEST_P(CameraModels, WrongNumberOfParametersIsNamed) {
  Camera camera = makeCamera(GetParam());
  camera.parameters.push_back(0);
  EXPECT_THROW(undistort(camera, 1, 1), std::invalid_argument);
  EXPECT_THROW(distort(camera, Vector3d(1, 1, 1)), std::invalid_argument);
  EXPECT_THROW(focalLength(camera), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(All, CameraModels,
                         ::testing::Values(CameraModel::SimplePinhole, CameraModel::Pinhole, CameraModel::SimpleRadial,
                                           CameraModel::Radial, CameraModel::OpenCV, CameraModel::NvmRadial),
                         [](const auto& test) {
                           std::string name = toString(test.param);
                           name.erase(std::remove(name.begin(), name.end(), '_'), name.end());
                           return name;
                         });

// The formulas of CameraModel, written out for one point (x, y) = (0.3, -0.2), r^2 = 0.13.
TEST(Camera, DistortFollowsTheFormulas) {
  const double x = 0.3, y = -0.2, r2 = x * x + y * y;
  const auto expectPixel = [&](CameraModel model, double expectedX, double expectedY) {
    const Camera camera = makeCamera(model);
    const double f = focalLength(camera);
    const auto pixel = distort(camera, {f * x, f * y, 1});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((*pixel)[0], expectedX, 1e-9) << toString(model);
    EXPECT_NEAR((*pixel)[1], expectedY, 1e-9) << toString(model);
  };
  expectPixel(CameraModel::SimplePinhole, 700 * x + 510, 700 * y + 390);
  expectPixel(CameraModel::Pinhole, 720 * x + 510, 690 * y + 390);
  const double simple = 1 - 0.11 * r2;
  expectPixel(CameraModel::SimpleRadial, 650 * simple * x + 500, 650 * simple * y + 400);
  const double radial = 1 - 0.2 * r2 + 0.06 * r2 * r2;
  expectPixel(CameraModel::Radial, 800 * radial * x + 495, 800 * radial * y + 405);
  const double k = 1 - 0.15 * r2 + 0.03 * r2 * r2, p1 = 0.0015, p2 = -0.001;
  expectPixel(CameraModel::OpenCV, 760 * (k * x + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + 505,
              770 * (k * y + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + 395);
}

TEST(Camera, NvmFormulaRemovesTheDistortion) {
  const Camera camera = makeCamera(CameraModel::NvmRadial);
  const double x = 0.3, y = -0.2, factor = 1 + 0.08 * (x * x + y * y);
  const auto imagePoint = undistort(camera, 710 * x, 705 * y);
  ASSERT_TRUE(imagePoint);
  EXPECT_NEAR((*imagePoint)[0], 710 * factor * x, 1e-9);
  EXPECT_NEAR((*imagePoint)[1], 710 * factor * y, 1e-9);
}

TEST(Camera, PixelsOutsideTheInvertibleRangeHaveNoImagePoint) {
  Camera camera = makeCamera(CameraModel::SimpleRadial);
  camera.parameters = {1000, 0, 0, -0.3};
  // r (1 - 0.3 r^2) grows up to r = 1/sqrt(0.9), where it is 2/3 of that.
  const double largest = 1 / std::sqrt(0.9), image = 2 * largest / 3;
  EXPECT_FALSE(undistort(camera, 1000 * image + 0.1, 0));
  EXPECT_FALSE(undistort(camera, 0, -1e9));
  EXPECT_FALSE(distort(camera, {1000 * largest + 0.1, 0, 1}));
  for (const double share : {0.5, 0.9, 0.99, 0.9999, 1.0}) {
    const double inside = 1000 * image * share;
    const auto point = undistort(camera, 0.6 * inside, 0.8 * inside);
    ASSERT_TRUE(point) << share;
    const double r = point->head<2>().norm() / 1000;
    EXPECT_LE(r, largest * (1 + 1e-7));
    EXPECT_NEAR(r * (1 - 0.3 * r * r), image * share, 1e-12);
  }
}

TEST(Camera, StrongDistortionIsInvertedWhereverTheFormulaGrows) {
  test::Random random(test::testSeed(), 1);
  for (int i = 0; i < 20000; ++i) {
    Camera camera = makeCamera(CameraModel::Radial);
    camera.parameters = {1, 0, 0, random.uniform(-2, 2), random.uniform(-2, 2)};
    const double r = random.uniform(0, 1.5), angle = random.uniform(0, 6.28);
    const auto pixel = distort(camera, {r * std::cos(angle), r * std::sin(angle), 1});
    if (!pixel) continue;  // beyond the turning point
    const auto back = undistort(camera, (*pixel)[0], (*pixel)[1]);
    ASSERT_TRUE(back) << i;
    // Near the turning point a pixel fixes the radius only to the square root of the rounding error.
    EXPECT_NEAR(back->head<2>().norm(), r, 1e-6) << i;
    const auto again = distort(camera, *back);
    if (again) {
      EXPECT_LT((*again - *pixel).norm(), 1e-12) << i;
    }
  }
}

// k1 > 0 and a tiny k2 < 0: the formula grows up to a radius of about 5e14, which 9 k1^2 - 20 k2 in double precision does not
// show.
TEST(Camera, AlmostCubicDistortionIsInverted) {
  Camera camera = makeCamera(CameraModel::Radial);
  camera.parameters = {1, 0, 0, 1, -1e-30};
  const auto point = undistort(camera, 1e30, 0);
  ASSERT_TRUE(point);
  EXPECT_NEAR((*point)[0], 1e10, 10);
  EXPECT_FALSE(undistort(camera, 1e60, 0));
}

TEST(Camera, TangentialDistortionIsInvertedOrRefused) {
  test::Random random(test::testSeed(), 2);
  int solved = 0;
  for (int i = 0; i < 20000; ++i) {
    Camera camera = makeCamera(CameraModel::OpenCV);
    for (const std::size_t k : {4, 5}) camera.parameters[k] = random.uniform(-0.4, 0.4);
    for (const std::size_t k : {6, 7}) camera.parameters[k] = random.uniform(-0.02, 0.02);
    const double x = random.uniform(-1500, 2500), y = random.uniform(-1500, 2500);
    const auto point = undistort(camera, x, y);
    if (!point) continue;
    ++solved;
    const auto back = distort(camera, *point);
    ASSERT_TRUE(back) << i;
    EXPECT_LT((*back - Vector3d(x, y, 1)).norm(), 1e-7) << i;
  }
  EXPECT_GT(solved, 5000);
}

TEST(Camera, RejectsBadArguments) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  Camera camera = makeCamera(CameraModel::SimplePinhole);
  EXPECT_THROW(undistort(camera, nan, 0), std::invalid_argument);
  EXPECT_THROW(undistort(camera, 0, infinity), std::invalid_argument);
  EXPECT_THROW(distort(camera, Vector3d(nan, 0, 1)), std::invalid_argument);
  EXPECT_THROW(distort(camera, Vector3d(1, 1, 0)), std::invalid_argument);
  for (const double f : {0.0, -1.0, nan, infinity}) {
    camera.parameters[0] = f;
    EXPECT_THROW(undistort(camera, 1, 1), std::invalid_argument) << f;
    EXPECT_THROW(focalLength(camera), std::invalid_argument) << f;
  }
  EXPECT_THROW(focalLength(Camera()), std::invalid_argument);
}

TEST(Camera, HugeValuesGiveNoNumbersThatAreNotFinite) {
  Camera camera = makeCamera(CameraModel::Radial);
  camera.parameters = {1e-300, 0, 0, 1e300, -1e300};
  const auto point = undistort(camera, 1e300, 1e300);
  if (point) {
    EXPECT_TRUE(point->allFinite());
  }
  const auto pixel = distort(camera, {1e300, 1e300, 1});
  if (pixel) {
    EXPECT_TRUE(pixel->allFinite());
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

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

TEST_P(CameraModels, EveryPixelOfTheImageHasARayThatProjectsBack) {
  const Camera camera = makeCamera(GetParam());
  const bool isCentred = GetParam() == CameraModel::NvmRadial;
  const double left = isCentred ? -500 : 0, top = isCentred ? -400 : 0;
  for (double x = left; x <= left + 1000; x += 20)
    for (double y = top; y <= top + 800; y += 20) {
      const auto ray = bearingVector(camera, x, y);
      ASSERT_TRUE(ray) << x << " " << y;
      EXPECT_NEAR(ray->norm(), 1, 1e-15);
      const auto pixel = project(camera, 3 * *ray);
      ASSERT_TRUE(pixel) << x << " " << y;
      EXPECT_LT((*pixel - Vector3d(x, y, 1)).norm(), 1e-12 * 1000) << x << " " << y;
    }
}

TEST_P(CameraModels, RaysOfProjectionsAreTheDirections) {
  test::Random random(test::testSeed(), 7);
  const Camera camera = makeCamera(GetParam());
  for (int i = 0; i < 3000; ++i) {
    Vector3d direction = random.direction();
    direction[2] = std::abs(direction[2]) + 0.6;  // up to 59 degrees off the axis
    const auto pixel = project(camera, direction);
    ASSERT_TRUE(pixel) << direction.transpose();
    const auto ray = bearingVector(camera, (*pixel)[0], (*pixel)[1]);
    ASSERT_TRUE(ray) << direction.transpose();
    EXPECT_LT((*ray - direction.normalized()).norm(), 1e-12) << direction.transpose();
  }
}

// No second branch: a ray that comes back from any pixel, however far outside the image, projects to that pixel.
TEST_P(CameraModels, PixelsFarOutsideHaveNoRayOrOneThatProjectsBack) {
  test::Random random(test::testSeed(), 8);
  const Camera camera = makeCamera(GetParam());
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10, random.uniform(2, 8)), x = size * random.uniform(-1, 1), y = size * random.uniform(-1, 1);
    const auto ray = bearingVector(camera, x, y);
    if (!ray) continue;
    const auto pixel = project(camera, *ray);
    ASSERT_TRUE(pixel) << x << " " << y;
    EXPECT_LT((*pixel - Vector3d(x, y, 1)).norm(), 1e-7 * (1000 + size)) << x << " " << y;
  }
}

TEST_P(CameraModels, UndistortAndDistortAreInverse) {
  if (!hasImagePlane(GetParam())) GTEST_SKIP() << "no image plane";
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
    const auto ray = bearingVector(camera, (*pixel)[0], (*pixel)[1]);
    ASSERT_TRUE(ray) << imagePoint.transpose();
    EXPECT_LT((*ray - Vector3d(imagePoint[0], imagePoint[1], f).normalized()).norm(), 1e-12) << imagePoint.transpose();
  }
}

TEST_P(CameraModels, PrincipalPointIsTheAxis) {
  const Camera camera = makeCamera(GetParam());
  const auto pixel = project(camera, Vector3d(0, 0, 2));
  ASSERT_TRUE(pixel);
  EXPECT_EQ(bearingVector(camera, (*pixel)[0], (*pixel)[1]).value(), Vector3d(0, 0, 1));
  if (!hasImagePlane(GetParam())) return;
  EXPECT_EQ(distort(camera, Vector3d(0, 0, 1)).value(), *pixel);
  EXPECT_EQ(undistort(camera, (*pixel)[0], (*pixel)[1]).value(), Vector3d(0, 0, 1));
}

TEST_P(CameraModels, WrongNumberOfParametersIsNamed) {
  Camera camera = makeCamera(GetParam());
  camera.parameters.push_back(0);
  EXPECT_THROW(bearingVector(camera, 1, 1), std::invalid_argument);
  EXPECT_THROW(project(camera, Vector3d(1, 1, 1)), std::invalid_argument);
  EXPECT_THROW(undistort(camera, 1, 1), std::invalid_argument);
  EXPECT_THROW(distort(camera, Vector3d(1, 1, 1)), std::invalid_argument);
  EXPECT_THROW(focalLength(camera), std::invalid_argument);
}

std::vector<CameraModel> allModels() {
  std::vector<CameraModel> models = test::colmapModels();
  models.push_back(CameraModel::NvmRadial);
  return models;
}

INSTANTIATE_TEST_SUITE_P(All, CameraModels, ::testing::ValuesIn(allModels()), [](const auto& test) {
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

// The same for a point (X, Y, Z) = (0.6, -0.3, 0.9) and the models that start from the angle to the axis or from the sphere, with
// numbers that were worked out apart from the library (test/adapters/sfm/cameraFormulas.py).
TEST(Camera, ProjectFollowsTheFormulas) {
  const auto expectPixel = [&](CameraModel model, double expectedX, double expectedY) {
    const auto pixel = project(makeCamera(model), {0.6, -0.3, 0.9});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((*pixel)[0], expectedX, 1e-9) << toString(model);
    EXPECT_NEAR((*pixel)[1], expectedY, 1e-9) << toString(model);
  };
  expectPixel(CameraModel::OpenCVFisheye, 746.286283399, 274.908725661);
  expectPixel(CameraModel::FullOpenCV, 916.120302183, 193.558764496);
  expectPixel(CameraModel::Fov, 877.133146125, 205.832317386);
  expectPixel(CameraModel::SimpleRadialFisheye, 744.325874402, 277.837062799);
  expectPixel(CameraModel::RadialFisheye, 751.974914254, 275.012542873);
  expectPixel(CameraModel::ThinPrismFisheye, 761.099187205, 270.085635396);
  expectPixel(CameraModel::RadTanThinPrismFisheye, 733.138214448, 282.295098951);
  expectPixel(CameraModel::SimpleDivision, 893.608329052, 203.195835474);
  expectPixel(CameraModel::Division, 957.95239067, 175.09234716);
  expectPixel(CameraModel::SimpleFisheye, 717.702217703, 291.148891149);
  expectPixel(CameraModel::Fisheye, 728.431223432, 284.852136852);
  expectPixel(CameraModel::Eucm, 788.966119513, 253.082109646);
  expectPixel(CameraModel::Equirectangular, 593.583520905, 331.105068591);
}

TEST(Camera, FisheyeCamerasAndPanoramasSeeBehindThemselves) {
  const Vector3d behind(0.3, 0.2, -0.4);
  for (const CameraModel model :
       {CameraModel::SimpleFisheye, CameraModel::Fisheye, CameraModel::RadialFisheye, CameraModel::Equirectangular}) {
    const Camera camera = makeCamera(model);
    const auto pixel = project(camera, behind);
    ASSERT_TRUE(pixel) << toString(model);
    const auto ray = bearingVector(camera, (*pixel)[0], (*pixel)[1]);
    ASSERT_TRUE(ray) << toString(model);
    EXPECT_LT((*ray - behind.normalized()).norm(), 1e-12) << toString(model);
    if (hasImagePlane(model)) {
      EXPECT_FALSE(undistort(camera, (*pixel)[0], (*pixel)[1])) << toString(model);
    }
  }
  for (const CameraModel model : {CameraModel::Pinhole, CameraModel::OpenCV, CameraModel::FullOpenCV, CameraModel::Fov})
    EXPECT_FALSE(project(makeCamera(model), behind)) << toString(model);
}

TEST(Camera, RadiiBeyondTheGrowthOfAFisheyeFormulaHaveNoRay) {
  Camera camera = makeCamera(CameraModel::SimpleRadialFisheye);
  camera.parameters = {1000, 0, 0, -0.3};
  const double largest = 1 / std::sqrt(0.9), image = 2 * largest / 3;  // as for the radial model, of the angle
  EXPECT_FALSE(bearingVector(camera, 1000 * image + 0.1, 0));
  const auto ray = bearingVector(camera, 1000 * image - 1e-3, 0);
  ASSERT_TRUE(ray);
  EXPECT_LT(std::atan2(ray->x(), ray->z()), largest);
  EXPECT_FALSE(project(camera, {std::sin(largest + 0.01), 0, std::cos(largest + 0.01)}));
  camera.parameters[3] = 0.1;  // grows for ever: up to 180 degrees
  const double pi = std::acos(-1.0), last = 1000 * pi * (1 + 0.1 * pi * pi);
  EXPECT_TRUE(bearingVector(camera, 0.999 * last, 0));
  EXPECT_FALSE(bearingVector(camera, 1.001 * last, 0));
}

TEST(Camera, RationalDistortionIsInvertedUpToItsTurningPointOrPole) {
  test::Random random(test::testSeed(), 3);
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    Camera camera = makeCamera(CameraModel::FullOpenCV);
    camera.parameters = {1, 1, 0, 0};
    for (int k = 0; k < 8; ++k) camera.parameters.push_back(k == 2 || k == 3 ? 0 : random.uniform(-1, 1));
    const double r = random.uniform(0, 2), angle = random.uniform(0, 6.28);
    const auto pixel = distort(camera, {r * std::cos(angle), r * std::sin(angle), 1});
    if (!pixel) continue;
    ++seen;
    const auto back = undistort(camera, (*pixel)[0], (*pixel)[1]);
    ASSERT_TRUE(back) << i;
    EXPECT_NEAR(back->head<2>().norm(), r, 1e-5) << i;
  }
  EXPECT_GT(seen, 5000);
}

TEST(Camera, ModelsInClosedFormEndWhereTheirFormulasEnd) {
  Camera camera = makeCamera(CameraModel::Division);
  camera.parameters = {1000, 1000, 0, 0, 0.25};  // rays up to r = 1, pixels up to 2
  EXPECT_TRUE(bearingVector(camera, 1999, 0));
  EXPECT_FALSE(bearingVector(camera, 2001, 0));
  EXPECT_TRUE(project(camera, {0.999, 0, 1}));
  EXPECT_FALSE(project(camera, {1.001, 0, 1}));
  camera.parameters[4] = -0.25;  // beyond the pixel 2 it looks behind itself
  EXPECT_LT(bearingVector(camera, 2001, 0).value().z(), 0);
  camera = makeCamera(CameraModel::Fov);
  camera.parameters = {1000, 1000, 0, 0, 1};
  EXPECT_TRUE(bearingVector(camera, 1570, 0));
  EXPECT_FALSE(bearingVector(camera, 1571, 0));
  camera.parameters[4] = 0;
  EXPECT_EQ(project(camera, {0.3, 0.4, 1}).value(), Vector3d(300, 400, 1));
  camera = makeCamera(CameraModel::Eucm);
  camera.parameters = {1000, 1000, 0, 0, 1, 1};
  EXPECT_TRUE(bearingVector(camera, 999, 0));
  EXPECT_FALSE(bearingVector(camera, 1001, 0));
  camera = makeCamera(CameraModel::Equirectangular);
  EXPECT_TRUE(bearingVector(camera, 1000, 800));
  EXPECT_FALSE(bearingVector(camera, 1000.1, 400));
  EXPECT_FALSE(bearingVector(camera, 500, -0.1));
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

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>

#include "SfmScene.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/ransacOptions.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Eigen::Vector3d;

const std::vector<CameraModel> kAllModels{CameraModel::SimplePinhole, CameraModel::Pinhole, CameraModel::SimpleRadial,
                                          CameraModel::Radial,        CameraModel::OpenCV,  CameraModel::NvmRadial};

SparseModel makeModel(std::uint64_t stream, std::size_t points = 150) {
  test::Random random(test::testSeed(), stream);
  return test::makeScene(random, 8, points, 0.4, kAllModels);
}

double sampsonError(const LocalizationProblem& problem, std::size_t i) {
  const NoncentralHybridAdapter& a = problem.adapter;
  return hybrid_pose::sampsonError(*problem.reference, a.getImagePoint2d2d(i), a.getBearingVector(i), a.getCamOffset(i),
                                   a.getCamRotation(i), a.getRigFocalLength(i));
}

double reprojectionError(const LocalizationProblem& problem, std::size_t i) {
  return hybrid_pose::reprojectionError(*problem.reference, problem.adapter.getImagePoint2d3d(i), problem.adapter.getPoint(i));
}

std::size_t countOtherObservers(const SparseModel& model, std::size_t point, std::size_t query) {
  std::set<std::size_t> images;
  for (const TrackElement& e : model.points[point].track) images.insert(e.image);
  images.erase(query);
  return images.size();
}

TEST(LocalizationProblem, ExactModelsGiveExactCorrespondences) {
  const SparseModel model = makeModel(1);
  for (std::size_t query = 0; query < model.images.size(); ++query) {
    const LocalizationProblem problem = makeLocalizationProblem(model, query);
    EXPECT_EQ(problem.imageName, model.images[query].name);
    ASSERT_TRUE(problem.reference);
    EXPECT_EQ(problem.reference->rotation, model.images[query].rotation);
    EXPECT_EQ(problem.reference->position, model.images[query].position);
    EXPECT_EQ(problem.reference->focalLength, focalLength(model.cameras[model.images[query].camera]));
    ASSERT_GT(problem.points2d3d.size(), 20u);
    ASSERT_GT(problem.points2d2d.size(), 2u);
    ASSERT_EQ(problem.adapter.getNumberCorrespondences2d3d(), problem.points2d3d.size());
    ASSERT_EQ(problem.adapter.getNumberCorrespondences2d2d(), problem.points2d2d.size());
    for (std::size_t i = 0; i < problem.points2d3d.size(); ++i) {
      EXPECT_LT((problem.adapter.getPoint(i) - model.points[problem.points2d3d[i]].position).norm(), 1e-9);
      EXPECT_LT(reprojectionError(problem, i), 1e-8);
    }
    for (std::size_t i = 0; i < problem.points2d2d.size(); ++i) EXPECT_LT(sampsonError(problem, i), 1e-8);
  }
}

LocalizationProblemOptions keepingDistortion() {
  LocalizationProblemOptions options;
  options.undistortQuery = false;
  return options;
}

// Raw pixels, relative to the middle of the image: what is not undistorted uses nothing of the calibration but the pixels' shape.
TEST(LocalizationProblem, KeepsTheQuerysDistortionIfAskedTo) {
  const SparseModel model = makeModel(16);
  for (std::size_t query = 0; query < model.images.size(); ++query) {
    const Camera& camera = model.cameras[model.images[query].camera];
    const LocalizationProblem problem = makeLocalizationProblem(model, query, keepingDistortion());
    EXPECT_FALSE(problem.isUndistorted);
    EXPECT_EQ(problem.imageWidth, camera.width);
    EXPECT_EQ(problem.imageHeight, camera.height);
    const bool hasTwo =
        camera.model == CameraModel::Pinhole || camera.model == CameraModel::OpenCV || camera.model == CameraModel::NvmRadial;
    const double aspect = hasTwo ? camera.parameters[0] / camera.parameters[1] : 1;
    ASSERT_GT(problem.keypoints2d3d.size(), 20u);
    for (std::size_t i = 0; i < problem.keypoints2d3d.size(); ++i) {
      const Observation& o = model.images[query].observations[problem.keypoints2d3d[i]];
      const Vector3d raw(o.x - static_cast<double>(camera.width) / 2, aspect * (o.y - static_cast<double>(camera.height) / 2), 1);
      EXPECT_LT((problem.adapter.getImagePoint2d3d(i) - raw).norm(), 1e-9);
    }
    const LocalizationProblem undistorted = makeLocalizationProblem(model, query);
    EXPECT_TRUE(undistorted.isUndistorted);
    EXPECT_FALSE(undistorted.referenceK1);
    if (camera.model == CameraModel::SimpleRadial) {
      EXPECT_EQ(problem.referenceK1, camera.parameters[3]);
    } else if (camera.model == CameraModel::NvmRadial) {
      EXPECT_EQ(problem.referenceK1, -camera.parameters[4]);
    } else if (camera.model == CameraModel::SimplePinhole) {
      EXPECT_EQ(problem.referenceK1, 0);
    }
  }
}

TEST(LocalizationProblem, KeepsThePrincipalPointWhereTheImagesSizeIsUnknown) {
  SparseModel model = makeModel(17);
  for (Camera& camera : model.cameras) camera.width = camera.height = 0;
  const Camera& camera = model.cameras[model.images[0].camera];
  const LocalizationProblem problem = makeLocalizationProblem(model, 0, keepingDistortion());
  ASSERT_EQ(camera.model, CameraModel::SimplePinhole);
  const Observation& o = model.images[0].observations[problem.keypoints2d3d[0]];
  EXPECT_LT((problem.adapter.getImagePoint2d3d(0) - Vector3d(o.x - camera.parameters[1], o.y - camera.parameters[2], 1)).norm(),
            1e-9);
  EXPECT_EQ(problem.imageWidth, 0u);
}

TEST(LocalizationProblem, FisheyeQueriesAreUndistortedInAnyCase) {
  test::Random random(test::testSeed(), 18);
  const SparseModel model = test::makeScene(random, 8, 150, 0.4, {CameraModel::OpenCVFisheye});
  EXPECT_TRUE(makeLocalizationProblem(model, 0, keepingDistortion()).isUndistorted);
}

TEST(RansacOptions, FollowFromTheQuerysImage) {
  const SparseModel model = makeModel(19);
  LocalizationProblem problem = makeLocalizationProblem(model, 2, keepingDistortion());
  sac::HybridRansacOptions options = ransacOptions(problem);
  EXPECT_EQ(options.queryCamera, sac::QueryCamera::Radial);
  EXPECT_NEAR(options.imageRadiusPx, std::hypot(1000, 800) / 2, 1e-9);
  sac::HybridRansacOptions own;
  own.imageRadiusPx = 700;
  own.seed = 5;
  EXPECT_EQ(ransacOptions(problem, own).imageRadiusPx, 700);
  EXPECT_EQ(ransacOptions(problem, own).seed, 5u);
  EXPECT_EQ(ransacOptions(makeLocalizationProblem(model, 2)).queryCamera, sac::QueryCamera::Pinhole);
  problem.imageWidth = problem.imageHeight = 0;
  EXPECT_EQ(ransacOptions(problem).imageRadiusPx, 0);
}

TEST(LocalizationProblem, MapImagesMayHaveAnyCameraModel) {
  test::Random random(test::testSeed(), 31);
  const SparseModel model = test::makeScene(random, 18, 120, 0.4, test::colmapModels());
  for (std::size_t query = 0; query < model.images.size(); ++query) {
    const CameraModel camera = model.cameras[model.images[query].camera].model;
    SCOPED_TRACE(toString(camera));
    if (!hasImagePlane(camera)) {
      EXPECT_THROW(makeLocalizationProblem(model, query), std::invalid_argument);
      continue;
    }
    const LocalizationProblem problem = makeLocalizationProblem(model, query);
    ASSERT_GT(problem.points2d3d.size(), 10u);
    for (std::size_t i = 0; i < problem.points2d3d.size(); ++i) {
      EXPECT_LT((problem.adapter.getPoint(i) - model.points[problem.points2d3d[i]].position).norm(), 1e-9);
      EXPECT_LT(reprojectionError(problem, i), 1e-8);
    }
    for (std::size_t i = 0; i < problem.points2d2d.size(); ++i) EXPECT_LT(sampsonError(problem, i), 1e-8);
  }
}

// A map image with a fisheye camera that sees points to the side and behind itself.
TEST(LocalizationProblem, RaysMayLeaveAMapImageInAnyDirection) {
  test::Random random(test::testSeed(), 32);
  SparseModel model = test::makeScene(random, 6, 80, 1, {CameraModel::Pinhole, CameraModel::SimpleFisheye});
  for (std::size_t i = 1; i < model.images.size(); i += 2) {  // turned by 100 degrees away from the scene
    Image& image = model.images[i];
    image.rotation = image.rotation * Eigen::AngleAxisd(1.75, Vector3d::UnitY()).toRotationMatrix();
    for (Observation& o : image.observations) {
      if (o.point == Observation::kNoPoint) continue;
      const Vector3d x = image.rotation.transpose() * (model.points[o.point].position - image.position);
      const Vector3d pixel = project(model.cameras[image.camera], x).value();
      o.x = pixel[0];
      o.y = pixel[1];
    }
  }
  const LocalizationProblem problem = makeLocalizationProblem(model, 0);
  ASSERT_EQ(problem.points2d3d.size(), 80u);
  for (std::size_t i = 0; i < problem.points2d3d.size(); ++i)
    EXPECT_LT((problem.adapter.getPoint(i) - model.points[problem.points2d3d[i]].position).norm(), 1e-9);
  EXPECT_TRUE(makeLocalizationProblem(model, 1).points2d3d.empty());  // as a query it has no pinhole image of them
}

TEST(LocalizationProblem, NumberOfOtherObserversDecidesTheKind) {
  const SparseModel model = makeModel(2);
  const std::size_t query = 3;
  const LocalizationProblem problem = makeLocalizationProblem(model, query, {0, 4});
  std::set<std::size_t> rays, points, expectedRays, expectedPoints;
  rays.insert(problem.points2d2d.begin(), problem.points2d2d.end());
  points.insert(problem.points2d3d.begin(), problem.points2d3d.end());
  for (const Observation& o : model.images[query].observations) {
    if (o.point == Observation::kNoPoint) continue;
    const std::size_t others = countOtherObservers(model, o.point, query);
    if (others == 1) expectedRays.insert(o.point);
    if (others >= 2) expectedPoints.insert(o.point);
  }
  EXPECT_EQ(rays, expectedRays);
  EXPECT_EQ(points, expectedPoints);
}

TEST(LocalizationProblem, TellsTheRig) {
  const SparseModel model = makeModel(3);
  const LocalizationProblem problem = makeLocalizationProblem(model, 2);
  EXPECT_TRUE(std::is_sorted(problem.rigImages.begin(), problem.rigImages.end()));
  EXPECT_EQ(std::count(problem.rigImages.begin(), problem.rigImages.end(), 2u), 0);
  for (std::size_t i = 0; i < problem.points2d2d.size(); ++i) {
    const Image& image = model.images[problem.rigImages.at(static_cast<std::size_t>(problem.adapter.getCamIndex(i)))];
    EXPECT_EQ(problem.adapter.getCamOffset(i), image.position);
    EXPECT_EQ(problem.adapter.getCamRotation(i), image.rotation);
    EXPECT_EQ(problem.adapter.getRigFocalLength(i), focalLength(model.cameras[image.camera]));
    EXPECT_NEAR(problem.adapter.getBearingVector(i).norm(), 1, 1e-15);
  }
}

// Moving what the query has observed moves the problem's image points and nothing else.
TEST(LocalizationProblem, QueryDoesNotInfluenceItsOwnMap) {
  const SparseModel model = makeModel(4);
  const std::size_t query = 1;
  const LocalizationProblem before = makeLocalizationProblem(model, query);
  SparseModel moved = model;
  for (Observation& o : moved.images[query].observations) {
    o.x += 5;
    o.y -= 3;
  }
  moved.images[query].position += Vector3d(1, 2, 3);
  for (Point& point : moved.points) point.position.setZero();  // the model's own triangulation used the query
  const LocalizationProblem after = makeLocalizationProblem(moved, query);
  ASSERT_EQ(before.points2d2d, after.points2d2d);
  ASSERT_EQ(before.points2d3d, after.points2d3d);
  for (std::size_t i = 0; i < before.points2d3d.size(); ++i) {
    EXPECT_EQ(before.adapter.getPoint(i), after.adapter.getPoint(i));
    EXPECT_GT((before.adapter.getImagePoint2d3d(i) - after.adapter.getImagePoint2d3d(i)).norm(), 4);
  }
  for (std::size_t i = 0; i < before.points2d2d.size(); ++i) {
    EXPECT_EQ(before.adapter.getBearingVector(i), after.adapter.getBearingVector(i));
    EXPECT_EQ(before.adapter.getCamOffset(i), after.adapter.getCamOffset(i));
  }
}

// Two map cameras at a distance 2 d see a point at height 10 at the angle 2 atan(d / 10), the query stands between them.
SparseModel twoCamerasAndAQuery(double d) {
  SparseModel model;
  model.cameras = {test::makeCamera(CameraModel::SimplePinhole)};
  for (const double x : {-d, d, 0.0}) {
    Image image;
    image.id = static_cast<std::uint32_t>(model.images.size());
    image.name = "image";
    image.position = Vector3d(x, 0, 0);
    image.observations = {{510 - 70 * x, 390, 0}};  // f = 700
    model.images.push_back(image);
  }
  Point point;
  point.position = Vector3d(0, 0, 10);
  point.track = {{0, 0}, {1, 0}, {2, 0}};
  model.points = {point};
  return model;
}

TEST(LocalizationProblem, WeakParallaxGivesARayOfTheFirstImage) {
  const double twoDegrees = 10 * std::tan(1 * test::Random::kPi / 180);
  EXPECT_EQ(makeLocalizationProblem(twoCamerasAndAQuery(1.01 * twoDegrees), 2).points2d3d.size(), 1u);
  const LocalizationProblem weak = makeLocalizationProblem(twoCamerasAndAQuery(0.99 * twoDegrees), 2);
  EXPECT_EQ(weak.points2d3d.size(), 0u);
  ASSERT_EQ(weak.points2d2d.size(), 1u);
  EXPECT_EQ(weak.rigImages, std::vector<std::size_t>{0});
  LocalizationProblemOptions options;
  options.minParallaxDeg = 1;
  EXPECT_EQ(makeLocalizationProblem(twoCamerasAndAQuery(0.99 * twoDegrees), 2, options).points2d3d.size(), 1u);
}

TEST(LocalizationProblem, BadTriangulationGivesARay) {
  SparseModel model = twoCamerasAndAQuery(2);
  model.images[1].observations[0].y += 9;  // half of it remains in each image
  EXPECT_EQ(makeLocalizationProblem(model, 2).points2d2d.size(), 1u);
  LocalizationProblemOptions options;
  options.maxMapReprojectionErrorPx = 5;
  EXPECT_EQ(makeLocalizationProblem(model, 2, options).points2d3d.size(), 1u);
}

TEST(LocalizationProblem, PointBehindTheMapImagesGivesARay) {
  SparseModel model = twoCamerasAndAQuery(2);
  std::swap(model.images[0].observations[0], model.images[1].observations[0]);  // the rays meet at height -10
  EXPECT_EQ(makeLocalizationProblem(model, 2).points2d2d.size(), 1u);
}

TEST(LocalizationProblem, ImagesThatSeeAPointTwiceCountOnce) {
  SparseModel model = twoCamerasAndAQuery(2);
  for (const std::size_t i : {0, 2}) {
    model.images[i].observations.insert(model.images[i].observations.begin(), {123, 45, 0});
    model.points[0].track[i].observation = 1;
    model.points[0].track.push_back({i, 0});
  }
  const LocalizationProblem problem = makeLocalizationProblem(model, 2);
  ASSERT_EQ(problem.points2d3d.size(), 1u);
  EXPECT_LT((problem.adapter.getPoint(0) - Vector3d(0, 0, 10)).norm(), 1e-9);
  EXPECT_LT(reprojectionError(problem, 0), 1e-9);
}

TEST(LocalizationProblem, UnregisteredImagesAndPixelsThatCannotBeUndistortedAreIgnored) {
  SparseModel model = twoCamerasAndAQuery(2);
  model.images[1].registered = false;
  EXPECT_EQ(makeLocalizationProblem(model, 2).points2d2d.size(), 1u);
  model = twoCamerasAndAQuery(2);
  model.cameras.push_back(test::makeCamera(CameraModel::SimpleRadial));
  model.images[1].camera = 1;
  model.images[1].observations[0].x = 5000;
  EXPECT_EQ(makeLocalizationProblem(model, 2).points2d2d.size(), 1u);
  EXPECT_EQ(makeLocalizationProblem(model, 1).points2d3d.size(), 0u);
}

// The square of such a coordinate overflows.
TEST(LocalizationProblem, HugeImageCoordinatesHaveADirection) {
  SparseModel model;
  model.cameras.push_back(test::makeCamera(CameraModel::SimplePinhole));
  model.points.push_back({1, Vector3d(0, 0, 9), {}, -1, {{0, 0}, {1, 0}}});
  for (std::uint32_t i = 0; i < 2; ++i) {
    Image image;
    image.id = i;
    image.name = "a";
    image.observations = {{1e200, 1e200, 0}};
    model.images.push_back(image);
  }
  const LocalizationProblem problem = makeLocalizationProblem(model, 0);
  ASSERT_EQ(problem.adapter.getNumberCorrespondences2d2d(), 1u);
  EXPECT_LT((problem.adapter.getBearingVector(0) - Vector3d(1, 1, 0).normalized()).norm(), 1e-15);
}

TEST(LocalizationProblem, RejectsBadArguments) {
  const SparseModel model = makeModel(5);
  EXPECT_THROW(makeLocalizationProblem(model, model.images.size()), std::invalid_argument);
  EXPECT_THROW(makeLocalizationProblem(model, 0, {-1, 4}), std::invalid_argument);
  EXPECT_THROW(makeLocalizationProblem(model, 0, {2, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  const auto expectRejected = [&](const std::function<void(SparseModel&)>& damage) {
    SparseModel damaged = model;
    damage(damaged);
    EXPECT_THROW(makeLocalizationProblem(damaged, 0), std::invalid_argument);
  };
  expectRejected([](SparseModel& m) { m.images[0].registered = false; });
  expectRejected([](SparseModel& m) { m.images[0].camera = 99; });
  expectRejected([](SparseModel& m) { m.images[0].observations[0].point = m.points.size(); });
  expectRejected([](SparseModel& m) {
    for (Point& point : m.points) point.track.push_back({99, 0});
  });
}

TEST(LocalizationProblem, FeaturesAreTheKeypointsOfTheQuery) {
  LocalizationProblemOptions options;
  options.raysBesidePoints = true;
  const LocalizationProblem problem = makeLocalizationProblem(makeModel(6, 400), 0, options);
  ASSERT_GT(problem.keypoints2d2d.size() + problem.keypoints2d3d.size(), 50u);
  for (std::size_t i = 0; i < problem.keypoints2d2d.size(); ++i)
    EXPECT_EQ(problem.adapter.getFeature2d2d(i), static_cast<int>(problem.keypoints2d2d[i]));
  for (std::size_t i = 0; i < problem.keypoints2d3d.size(); ++i)
    EXPECT_EQ(problem.adapter.getFeature2d3d(i), static_cast<int>(problem.keypoints2d3d[i]));
}

class Outliers : public ::testing::TestWithParam<double> {};

TEST_P(Outliers, AreTheShareAskedForAndNoneKeepsItsImagePoint) {
  const LocalizationProblem problem = makeLocalizationProblem(makeModel(6, 400), 0);
  const LocalizationProblem damaged = injectOutliers(problem, GetParam(), 7);
  const auto check = [&](std::size_t count, const std::vector<bool>& flags, auto getImagePoint) {
    ASSERT_EQ(flags.size(), count);
    EXPECT_EQ(std::count(flags.begin(), flags.end(), true), std::lround(GetParam() * static_cast<double>(count)));
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(flags[i], getImagePoint(problem.adapter, i) != getImagePoint(damaged.adapter, i)) << i;
  };
  check(problem.points2d2d.size(), damaged.isOutlier2d2d, [](const auto& a, std::size_t i) { return a.getImagePoint2d2d(i); });
  check(problem.points2d3d.size(), damaged.isOutlier2d3d, [](const auto& a, std::size_t i) { return a.getImagePoint2d3d(i); });
  for (std::size_t i = 0; i < problem.points2d2d.size(); ++i) {
    EXPECT_EQ(problem.adapter.getBearingVector(i), damaged.adapter.getBearingVector(i));
    EXPECT_EQ(problem.adapter.getCamIndex(i), damaged.adapter.getCamIndex(i));
    EXPECT_EQ(problem.adapter.getCamOffset(i), damaged.adapter.getCamOffset(i));
    EXPECT_EQ(problem.adapter.getCamRotation(i), damaged.adapter.getCamRotation(i));
    EXPECT_EQ(problem.adapter.getRigFocalLength(i), damaged.adapter.getRigFocalLength(i));
  }
  for (std::size_t i = 0; i < problem.points2d3d.size(); ++i) EXPECT_EQ(problem.adapter.getPoint(i), damaged.adapter.getPoint(i));
}

INSTANTIATE_TEST_SUITE_P(Shares, Outliers, ::testing::Values(0.0, 0.05, 0.3, 0.5, 1.0),
                         [](const auto& info) { return std::to_string(std::lround(100 * info.param)) + "Percent"; });

// The image points are permuted, none is lost or doubled, and each is still of the same feature.
TEST(InjectOutliers, Permutes) {
  const LocalizationProblem problem = makeLocalizationProblem(makeModel(7), 0);
  const auto imagePoints = [](const NoncentralHybridAdapter& a) {
    std::vector<std::tuple<double, double, int>> result;
    for (std::size_t i = 0; i < a.getNumberCorrespondences2d2d(); ++i)
      result.emplace_back(a.getImagePoint2d2d(i)[0], a.getImagePoint2d2d(i)[1], a.getFeature2d2d(i));
    for (std::size_t i = 0; i < a.getNumberCorrespondences2d3d(); ++i)
      result.emplace_back(a.getImagePoint2d3d(i)[0], a.getImagePoint2d3d(i)[1], a.getFeature2d3d(i));
    std::sort(result.begin(), result.end());
    return result;
  };
  EXPECT_EQ(imagePoints(problem.adapter), imagePoints(injectOutliers(problem, 0.6, 3).adapter));
}

TEST(InjectOutliers, DependsOnTheSeedOnly) {
  const LocalizationProblem problem = makeLocalizationProblem(makeModel(8), 0);
  EXPECT_EQ(injectOutliers(problem, 0.4, 5).isOutlier2d3d, injectOutliers(problem, 0.4, 5).isOutlier2d3d);
  EXPECT_NE(injectOutliers(problem, 0.4, 5).isOutlier2d3d, injectOutliers(problem, 0.4, 6).isOutlier2d3d);
}

TEST(InjectOutliers, LeavesASingleCorrespondence) {
  const LocalizationProblem problem = makeLocalizationProblem(twoCamerasAndAQuery(2), 2);
  const LocalizationProblem same = injectOutliers(problem, 1, 1);
  EXPECT_EQ(same.isOutlier2d3d, std::vector<bool>{false});
  EXPECT_EQ(same.adapter.getImagePoint2d3d(0), problem.adapter.getImagePoint2d3d(0));
}

TEST(InjectOutliers, RejectsBadShares) {
  const LocalizationProblem problem = makeLocalizationProblem(makeModel(9), 0);
  for (const double share : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(injectOutliers(problem, share, 1), std::invalid_argument) << share;
}

TEST(ProblemFile, KeepsTheProblem) {
  const test::TemporaryFolder folder;
  const LocalizationProblem problem = makeLocalizationProblem(makeModel(10), 4);
  writeProblem(folder.file("some name.txt"), problem);
  const LocalizationProblem read = readProblem(folder.file("some name.txt"));
  const NoncentralHybridAdapter &a = problem.adapter, &b = read.adapter;
  EXPECT_EQ(read.imageName, "some name");
  EXPECT_EQ(read.imageWidth, problem.imageWidth);
  EXPECT_EQ(read.imageHeight, problem.imageHeight);
  ASSERT_TRUE(read.reference);
  EXPECT_LT((read.reference->rotation - problem.reference->rotation).norm(), 1e-14);
  EXPECT_LT((read.reference->position - problem.reference->position).norm(), 1e-13);
  EXPECT_EQ(read.reference->focalLength, problem.reference->focalLength);
  ASSERT_EQ(a.getNumberCorrespondences2d2d(), b.getNumberCorrespondences2d2d());
  ASSERT_EQ(a.getNumberCorrespondences2d3d(), b.getNumberCorrespondences2d3d());
  for (std::size_t i = 0; i < a.getNumberCorrespondences2d2d(); ++i) {
    EXPECT_EQ(a.getImagePoint2d2d(i), b.getImagePoint2d2d(i));
    EXPECT_EQ(a.getCamIndex(i), b.getCamIndex(i));
    EXPECT_EQ(a.getCamOffset(i), b.getCamOffset(i));
    EXPECT_LT((a.getCamRotation(i) - b.getCamRotation(i)).norm(), 1e-14);
    EXPECT_EQ(a.getRigFocalLength(i), b.getRigFocalLength(i));
    EXPECT_LT((a.getCamRotation(i) * a.getBearingVector(i) - b.getCamRotation(i) * b.getBearingVector(i)).norm(), 1e-15);
  }
  for (std::size_t i = 0; i < a.getNumberCorrespondences2d3d(); ++i) {
    EXPECT_EQ(a.getImagePoint2d3d(i), b.getImagePoint2d3d(i));
    EXPECT_EQ(a.getPoint(i), b.getPoint(i));
  }
}

// x_query = R X + t in the file: with R = I, t = (0, 0, 5) the query stands at (0, 0, -5).
TEST(ProblemFile, PoseIsTheInverseOfFocalPose) {
  const test::TemporaryFolder folder;
  const LocalizationProblem problem =
      readProblem(folder.write("a.txt", "query 500 0.5 0.5 0.5 0.5 1 2 5\np3 0 0 1 1 1 # comment\n"));
  // q = (1, 1, 1, 1) / 2 maps x -> y -> z -> x: R X = (X_z, X_x, X_y)
  Eigen::Matrix3d R;
  R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  ASSERT_TRUE(problem.reference);
  EXPECT_LT((problem.reference->rotation - R.transpose()).norm(), 1e-15);
  EXPECT_LT((problem.reference->position + R.transpose() * Vector3d(1, 2, 5)).norm(), 1e-15);
}

// q = (1, 1, 1, 1) / 2 maps x -> y -> z -> x.
TEST(ProblemFile, RigCamerasMayHaveFocalLengthAndRotation) {
  const test::TemporaryFolder folder;
  const LocalizationProblem problem = readProblem(
      folder.write("a.txt",
                   "cam 7 1 1 1 900 0.5 0.5 0.5 0.5 # calibrated\ncam 8 1 2 1 # not\nimage 640 480\ncam 9 0 0 0 0 1 0 0 0\n"
                   "p2 1 2 7 0 3 4\np2 1 2 8 0 3 4\np2 1 2 9 0 3 4\n"));
  const NoncentralHybridAdapter& adapter = problem.adapter;
  EXPECT_EQ(adapter.getRigFocalLength(0), 900);
  EXPECT_LT((adapter.getCamRotation(0) * Vector3d(1, 2, 3) - Vector3d(3, 1, 2)).norm(), 1e-14);
  EXPECT_LT((adapter.getCamRotation(0) * adapter.getBearingVector(0) - Vector3d(0, 0.6, 0.8)).norm(), 1e-14);
  EXPECT_EQ(adapter.getRigFocalLength(1), 0);
  EXPECT_EQ(adapter.getRigFocalLength(2), 0);
  EXPECT_EQ(adapter.getCamRotation(1), Eigen::Matrix3d::Identity());
  EXPECT_EQ(problem.imageWidth, 640u);
  EXPECT_EQ(problem.imageHeight, 480u);
  EXPECT_FALSE(problem.isUndistorted);
}

TEST(ProblemFile, NeedsNoReference) {
  const test::TemporaryFolder folder;
  const LocalizationProblem problem = readProblem(folder.write("a.txt", "p2 1 2 7 0 3 4\ncam 7 1 1 1\n"));
  EXPECT_FALSE(problem.reference);
  EXPECT_LT((problem.adapter.getBearingVector(0) - Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  writeProblem(folder.file("b.txt"), problem);
  EXPECT_FALSE(readProblem(folder.file("b.txt")).reference);
  EXPECT_THROW(writeProblem(folder.file("missing/b.txt"), problem), FileError);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

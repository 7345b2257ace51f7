// The models of ../shared/realdata (skipped where that folder is absent): what is in them, and the problems made from them
// against problems that were made from the same models by other means.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace sfm {
namespace {

const std::string kFolder = HYBRIDGV_REALDATA_DIR;

class RealData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(kFolder)) GTEST_SKIP() << "no folder " << kFolder;
  }
};

std::size_t countRegistered(const SparseModel& model) {
  return static_cast<std::size_t>(
      std::count_if(model.images.begin(), model.images.end(), [](const Image& image) { return image.registered; }));
}

std::size_t countTrackElements(const SparseModel& model) {
  std::size_t result = 0;
  for (const Point& point : model.points) result += point.track.size();
  return result;
}

// Of every observation under the model's own poses and points [px of the undistorted image].
std::vector<double> reprojectionErrors(const SparseModel& model) {
  std::vector<double> result;
  for (const Point& point : model.points)
    for (const TrackElement& e : point.track) {
      const Image& image = model.images[e.image];
      const Camera& camera = model.cameras[image.camera];
      const Observation& o = image.observations[e.observation];
      const auto imagePoint = undistort(camera, o.x, o.y);
      EXPECT_TRUE(imagePoint) << image.name;
      if (!imagePoint) continue;
      const FocalPose pose{image.rotation, image.position, focalLength(camera)};
      result.push_back(hybrid_pose::reprojectionError(pose, *imagePoint, point.position));
    }
  return result;
}

TEST_F(RealData, KermitHasElevenImagesOfWhichNineHavePoses) {
  const SparseModel model = readModel(kFolder + "/kermit/bundle.out");
  EXPECT_EQ(model.images.size(), 11u);
  EXPECT_EQ(countRegistered(model), 9u);
  EXPECT_EQ(model.points.size(), 634u);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    if (!model.images[i].registered) continue;
    EXPECT_GT(focalLength(model.cameras[i]), 637);
    EXPECT_LT(focalLength(model.cameras[i]), 729);
  }
  EXPECT_LT(test::median(reprojectionErrors(model)), 0.5);
}

TEST_F(RealData, BalbianelloHasFiveImages) {
  const SparseModel model = readModel(kFolder + "/balbianello/Balbianello.out");
  EXPECT_EQ(model.images.size(), 5u);
  EXPECT_EQ(countRegistered(model), 5u);
  EXPECT_EQ(model.points.size(), 544u);
  EXPECT_LT(test::median(reprojectionErrors(model)), 0.5);
}

TEST_F(RealData, CraneHasEightImagesOfOneCamera) {
  const SparseModel model = readModel(kFolder + "/crane");
  ASSERT_EQ(model.cameras.size(), 1u);
  EXPECT_EQ(model.cameras[0].model, CameraModel::SimpleRadial);
  EXPECT_NEAR(focalLength(model.cameras[0]), 2332.47, 1e-9);
  EXPECT_EQ(countRegistered(model), 8u);
  EXPECT_EQ(model.points.size(), 2122u);
  EXPECT_EQ(countTrackElements(model), 6037u);
  EXPECT_LT(test::median(reprojectionErrors(model)), 1.5);
}

// The problem of the same image, made by other means: the same image points, points and rays in both.
void expectAgreement(const LocalizationProblem& ours, const LocalizationProblem& other) {
  const NoncentralHybridAdapter &a = ours.adapter, &b = other.adapter;
  ASSERT_TRUE(ours.reference && other.reference);
  EXPECT_LT((ours.reference->rotation - other.reference->rotation).norm(), 1e-12);
  EXPECT_LT((ours.reference->position - other.reference->position).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(ours.reference->focalLength, other.reference->focalLength);
  ASSERT_EQ(a.getNumberCorrespondences2d2d(), b.getNumberCorrespondences2d2d());
  ASSERT_EQ(a.getNumberCorrespondences2d3d(), b.getNumberCorrespondences2d3d());

  // An image point may occur twice, where two points of the model have the same feature.
  for (std::size_t i = 0; i < a.getNumberCorrespondences2d3d(); ++i) {
    double distance = 1e9;
    for (std::size_t j = 0; j < b.getNumberCorrespondences2d3d(); ++j)
      if ((a.getImagePoint2d3d(i) - b.getImagePoint2d3d(j)).norm() < 1e-4)
        distance = std::min(distance, (a.getPoint(i) - b.getPoint(j)).norm());
    EXPECT_LT(distance, 1e-6) << ours.imageName << ", 2D-3D " << i;
  }
  for (std::size_t i = 0; i < a.getNumberCorrespondences2d2d(); ++i) {
    const Eigen::Vector3d ray = a.getCamRotation(i) * a.getBearingVector(i);
    double distance = 1e9;
    for (std::size_t j = 0; j < b.getNumberCorrespondences2d2d(); ++j)
      if ((a.getImagePoint2d2d(i) - b.getImagePoint2d2d(j)).norm() < 1e-4)
        distance = std::min(distance, (a.getCamOffset(i) - b.getCamOffset(j)).norm() + (ray - b.getBearingVector(j)).norm());
    EXPECT_LT(distance, 1e-9) << ours.imageName << ", 2D-2D " << i;
  }
}

void expectAgreement(const std::string& file, const std::string& name) {
  const SparseModel model = readModel(kFolder + "/" + file);
  for (std::size_t i = 0; i < model.images.size(); ++i)
    if (model.images[i].registered)
      expectAgreement(makeLocalizationProblem(model, i),
                      readProblem(kFolder + "/problems/" + name + "_" + std::to_string(i) + ".txt"));
}

TEST_F(RealData, ProblemsOfKermitAgreeWithTheRecordedOnes) { expectAgreement("kermit/bundle.out", "kermit"); }
TEST_F(RealData, ProblemsOfBalbianelloAgreeWithTheRecordedOnes) { expectAgreement("balbianello/Balbianello.out", "balbianello"); }

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

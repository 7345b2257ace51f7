// Maps whose points do not lie where their images see them: a common offset is corrected, anything else refused.
#include "DamagedMaps.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Eigen::Vector3d;

void expectRefused(const SparseModel& model, const std::string& reason) {
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  try {
    readModel(folder.path());
    ADD_FAILURE() << "was accepted";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("contradicts itself"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  }
  ReadReport report;
  EXPECT_NO_THROW(readModel(folder.path(), {false, false}, &report));
  EXPECT_TRUE(report.isEmpty());
  EXPECT_EQ(report.medianErrorPx, -1);
}

TEST(Consistency, MedianErrorIsReported) {
  const TextMap map(scene());
  ReadReport report;
  readModel(map.folder.path(), {}, &report);
  EXPECT_GE(report.medianErrorPx, 0);
  EXPECT_LT(report.medianErrorPx, 1e-9);
}

TEST(Consistency, MapsOfAnotherImageSizeAreRefused) {
  SparseModel model = scene();
  for (Camera& camera : model.cameras)
    for (std::size_t i = 0; i < (camera.model == CameraModel::OpenCV ? 4u : 3u); ++i) camera.parameters[i] *= 0.25;
  expectRefused(model, "median");
}

TEST(Consistency, MapsWithAnotherFocalLengthAreRefusedWithTheFactor) {
  test::Random random(test::testSeed(), 43);
  SparseModel model = test::makeScene(random, 5, 40, 1, {CameraModel::SimplePinhole});
  model.cameras[0].parameters[0] /= 1.6;
  expectRefused(model, "1.6 times");
}

TEST(Consistency, PointsOfAnotherMapAreRefused) {
  SparseModel model = scene();
  test::Random random(test::testSeed(), 44);
  for (Point& point : model.points) point.position = random.vector(-1.5, 1.5);
  expectRefused(model, "different maps");
}

TEST(Consistency, MirroredPosesAreRefused) {
  SparseModel model = scene();
  for (Image& image : model.images) image.rotation = image.rotation * Vector3d(1, -1, -1).asDiagonal();
  expectRefused(model, "cannot look");
}

TEST(Consistency, AShareOfWrongMatchesIsNoContradiction) {
  SparseModel model = scene();
  test::Random random(test::testSeed(), 45);
  for (std::size_t i = 0; i < model.points.size(); i += 3) model.points[i].position = random.vector(-100, 100);
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  EXPECT_NO_THROW(readModel(folder.path(), kStrict));
}

TEST(Consistency, PrincipalPointsOfColmapMapsAreMovedToo) {
  SparseModel model = scene();
  for (Image& image : model.images)
    for (Observation& o : image.observations) {
      o.x -= 500;
      o.y -= 400;
    }
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  const SparseModel moved = expectMends(folder.path(), {{Mend::OriginOfImagePositions, 2}});
  EXPECT_NEAR(moved.cameras[0].parameters[1], 10, 1e-6);
  EXPECT_NEAR(moved.cameras[0].parameters[2], -10, 1e-6);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

// Rigs and frames of COLMAP 3.12 and later are carried along.
#include "DamagedMaps.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Eigen::Vector3d;

// Two cameras on a rig, the second one turned and shifted; three frames of two images, and one of one.
SparseModel riggedScene() {
  test::Random random(test::testSeed(), 46);
  SparseModel model = test::makeScene(random, 7, 40, 1, {CameraModel::Pinhole, CameraModel::SimpleRadial});
  model.rigs = {
      {11, {{{0, model.cameras[0].id}, {}}, {{0, model.cameras[1].id}, {0.8, 0, 0.6, 0, 0.1, 0.2, 0.3}}, {{1, 77}, {}}}}};
  const auto pose = [](const Image& image) {
    const Eigen::Quaterniond q(Eigen::Matrix3d(image.rotation.transpose()));
    const Vector3d t = -(image.rotation.transpose() * image.position);
    return std::array<double, 7>{q.w(), q.x(), q.y(), q.z(), t[0], t[1], t[2]};
  };
  const Eigen::Matrix3d mount = Eigen::Quaterniond(0.8, 0, 0.6, 0).toRotationMatrix();
  for (std::size_t i = 0; i < 7; i += 2) {
    Frame frame{static_cast<std::uint32_t>(500 + i), 11, pose(model.images[i]), {{{0, model.cameras[0].id}, model.images[i].id}}};
    if (i + 1 < 7) {  // x_sensor = mount * x_rig + t
      Image& second = model.images[i + 1];
      second.rotation = model.images[i].rotation * mount.transpose();
      second.position = model.images[i].position - second.rotation * Vector3d(0.1, 0.2, 0.3);
      second.observations.clear();
      frame.data.push_back({{0, model.cameras[1].id}, second.id});
      frame.data.push_back({{1, 77}, 123456789012ULL});
    }
    model.frames.push_back(frame);
  }
  for (Point& point : model.points) {
    const auto isGone = [](const TrackElement& e) { return e.image % 2 == 1; };
    point.track.erase(std::remove_if(point.track.begin(), point.track.end(), isGone), point.track.end());
  }
  return model;
}

void expectSameRigs(const SparseModel& a, const SparseModel& b) {
  ASSERT_EQ(a.rigs.size(), b.rigs.size());
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.rigs.size(); ++i) {
    EXPECT_EQ(a.rigs[i].id, b.rigs[i].id);
    ASSERT_EQ(a.rigs[i].sensors.size(), b.rigs[i].sensors.size());
    for (std::size_t k = 0; k < a.rigs[i].sensors.size(); ++k) {
      EXPECT_EQ(a.rigs[i].sensors[k].sensor.type, b.rigs[i].sensors[k].sensor.type);
      EXPECT_EQ(a.rigs[i].sensors[k].sensor.id, b.rigs[i].sensors[k].sensor.id);
      EXPECT_EQ(a.rigs[i].sensors[k].sensorFromRig, b.rigs[i].sensors[k].sensorFromRig);
    }
  }
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].id, b.frames[i].id);
    EXPECT_EQ(a.frames[i].rigId, b.frames[i].rigId);
    EXPECT_EQ(a.frames[i].rigFromWorld, b.frames[i].rigFromWorld);
    ASSERT_EQ(a.frames[i].data.size(), b.frames[i].data.size());
    for (std::size_t k = 0; k < a.frames[i].data.size(); ++k) EXPECT_EQ(a.frames[i].data[k].id, b.frames[i].data[k].id);
  }
}

TEST(RigFiles, RigsAndFramesAreKept) {
  const SparseModel model = riggedScene();
  const TemporaryFolder text, binary;
  writeColmapText(text.path(), model);
  expectSameRigs(expectMends(text.path(), {}), model);
  writeColmapBinary(binary.path(), model);
  expectSameRigs(expectMends(binary.path(), {}), model);
}

// Byte by byte as COLMAP 3.12 writes them.
TEST(RigFiles, BinaryLayout) {
  const SparseModel model = riggedScene();
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), model);
  EXPECT_EQ(folder.read("rigs.bin").size(), 8u + 4 + 4 + 8 + (8 + 1 + 56) + (8 + 1));
  EXPECT_EQ(folder.read("frames.bin").size(), 8u + 4 * (4 + 4 + 56 + 4) + (3 * 3 + 1) * 16);
}

TEST(RigFiles, FramesLoseRemovedImages) {
  SparseModel model = riggedScene();
  const TextMap map(model);
  map.change("images.txt", [](const std::string& text) { return withoutImages(text, {1, 6}); });
  const SparseModel pruned = expectMends(map.folder.path(), {{Mend::TrackOfMissingImage, 40}, {Mend::FrameOfMissingImage, 2}});
  ASSERT_EQ(pruned.frames.size(), 3u);
  EXPECT_EQ(pruned.frames[0].data.size(), 2u);
  const TemporaryFolder copy;
  writeColmapBinary(copy.path(), pruned);
  expectSameRigs(expectMends(copy.path(), {}), pruned);
}

TEST(RigFiles, UnregisteredImagesAreNotWrittenInFrames) {
  SparseModel model = riggedScene();
  model.images[1].registered = false;
  const TemporaryFolder copy;
  writeColmapText(copy.path(), model);
  const SparseModel read = expectMends(copy.path(), {});
  EXPECT_EQ(read.images.size(), 6u);
  EXPECT_EQ(read.frames[0].data.size(), 2u);
}

TEST(RigFiles, ContradictionsAreTold) {
  SparseModel model = riggedScene();
  model.frames[2].rigFromWorld[4] += 0.01;
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  expectMends(folder.path(), {{Mend::FrameContradictsImage, 2}});
}

TEST(RigFiles, ImagesWithoutAFrameAreGivenOne) {
  SparseModel model = riggedScene();
  model.frames.pop_back();  // of the last image, camera 0
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  const SparseModel read = expectMends(folder.path(), {});
  ASSERT_EQ(read.frames.size(), 4u);
  EXPECT_EQ(read.rigs.size(), 1u);
  EXPECT_EQ(read.frames[3].rigId, 11u);
  EXPECT_EQ(read.frames[3].data.at(0).id, model.images[6].id);
}

TEST(RigFiles, FilesOfAnotherModelDoNotStayBehind) {
  const TemporaryFolder folder;
  writeColmapText(folder.path(), riggedScene());
  EXPECT_TRUE(std::filesystem::exists(folder.file("frames.txt")));
  writeColmapText(folder.path(), scene());
  EXPECT_FALSE(std::filesystem::exists(folder.file("frames.txt")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("rigs.txt")));
}

TEST(RigFiles, DamagedFilesLeaveTheMapReadable) {
  const SparseModel model = riggedScene();
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), model);
  const std::string frames = folder.read("frames.bin");
  for (std::size_t length = 0; length < frames.size(); length += 7) {
    folder.write("frames.bin", frames.substr(0, length));
    const SparseModel read = expectMends(folder.path(), {{Mend::RigOrFrameInvalid, 1}});
    EXPECT_TRUE(read.frames.empty());
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

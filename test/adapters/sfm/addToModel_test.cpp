#include "hybridgv/adapters/sfm/addToModel.hpp"

#include <gtest/gtest.h>

#include <set>

#include "SfmQuery.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using test::makeQuery;
using test::QueryScene;
using test::TemporaryFolder;

// The image of the query is not in the map at all.
struct Added {
  explicit Added(std::uint64_t stream) {
    test::Random random(test::testSeed(), stream);
    // The last image has a camera that no other has.
    SparseModel model =
        test::makeScene(random, 9, 150, 0.5, {CameraModel::SimpleRadial, CameraModel::OpenCV, CameraModel::SimplePinhole});
    model.images[5].camera = model.images[2].camera = 0;
    scene = makeQuery(std::move(model), 8);
    scene.map.images.pop_back();
    scene.map.cameras.pop_back();
    localization = std::make_unique<QueryLocalization>(localizeQuery(scene.map, scene.query));
  }
  std::size_t add(SparseModel& model) const { return addToModel(model, scene.query, *localization); }

  QueryScene scene;
  std::unique_ptr<QueryLocalization> localization;
};

TEST(AddToModel, InliersContinueTheirTracks) {
  const Added added(1);
  ASSERT_TRUE(added.localization->success);
  SparseModel model = added.scene.map;
  const std::size_t index = added.add(model);
  ASSERT_EQ(index, added.scene.map.images.size());
  const Image& image = model.images[index];
  EXPECT_EQ(image.id, added.scene.query.id);
  EXPECT_EQ(image.name, added.scene.query.name);
  EXPECT_EQ(image.rotation, added.localization->result.pose.rotation);
  EXPECT_EQ(image.position, added.localization->result.pose.position);
  EXPECT_EQ(model.cameras[image.camera].id, added.scene.query.camera.id);
  EXPECT_EQ(model.cameras[image.camera].parameters, added.localization->camera.parameters);
  ASSERT_EQ(image.observations.size(), added.scene.query.keypoints.size());
  std::size_t tracked = 0;
  for (std::size_t i = 0; i < image.observations.size(); ++i) {
    const Observation& o = image.observations[i];
    EXPECT_EQ(o.x, added.scene.query.keypoints[i].x);
    if (o.point == Observation::kNoPoint) continue;
    ++tracked;
    const TrackElement& last = model.points[o.point].track.back();
    EXPECT_EQ(last.image, index);
    EXPECT_EQ(last.observation, i);
  }
  EXPECT_EQ(tracked, static_cast<std::size_t>(added.localization->result.numberInliers2d3d));
}

// All bytes of the old model are in the new one, apart from counts and longer tracks.
TEST(AddToModel, TheRestIsWrittenBitByBit) {
  const Added added(2);
  const TemporaryFolder before, after;
  writeColmapBinary(before.path(), added.scene.map);
  SparseModel model = readModel(before.path());
  added.add(model);
  writeColmapBinary(after.path(), model);
  for (const char* file : {"cameras.bin", "images.bin"}) {
    const std::string a = before.read(file), b = after.read(file);
    ASSERT_GT(b.size(), a.size());
    EXPECT_TRUE(b.compare(8, a.size() - 8, a, 8) == 0) << file;
  }
  ReadReport report;
  ReadOptions strict;
  strict.strict = true;
  const SparseModel read = readModel(after.path(), strict, &report);
  EXPECT_TRUE(report.isEmpty());
  for (std::size_t i = 0; i < read.points.size(); ++i) {
    EXPECT_EQ(read.points[i].position, added.scene.map.points[i].position);
    ASSERT_GE(read.points[i].track.size(), added.scene.map.points[i].track.size());
  }
}

TEST(AddToModel, NumbersThatAreTakenAreReplaced) {
  const Added added(3);
  SparseModel model = added.scene.map;
  model.images[0].id = added.scene.query.id;
  model.cameras[1].id = added.scene.query.camera.id;
  const Image& image = model.images[added.add(model)];
  EXPECT_EQ(image.id, 1u);
  EXPECT_EQ(model.cameras[image.camera].id, 1u);
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), model);
}

TEST(AddToModel, CamerasOfTheModelAreShared) {
  Added added(4);
  added.scene.query.camera = added.scene.map.cameras[1];
  added.localization->camera = added.scene.map.cameras[1];
  SparseModel model = added.scene.map;
  EXPECT_EQ(model.images[added.add(model)].camera, 1u);
  EXPECT_EQ(model.cameras.size(), added.scene.map.cameras.size());
}

TEST(AddToModel, KeypointsAndPointsAreUsedOnce) {
  Added added(5);
  QueryImage& query = added.scene.query;
  // A second keypoint half a pixel beside the first one, with the same matches.
  const std::size_t keypoint = added.localization->problem.keypoints2d3d[0], point = added.localization->problem.points2d3d[0];
  query.keypoints.push_back(query.keypoints[keypoint]);
  query.keypoints.back().x += 0.5;
  for (ImageMatches& matches : query.matches) {
    const std::size_t count = matches.pairs.size();
    for (std::size_t i = 0; i < count; ++i)
      if (matches.pairs[i][0] == keypoint)
        matches.pairs.push_back({static_cast<std::uint32_t>(query.keypoints.size() - 1), matches.pairs[i][1]});
  }
  *added.localization = localizeQuery(added.scene.map, query);
  ASSERT_TRUE(added.localization->success);
  SparseModel model = added.scene.map;
  const std::size_t index = added.add(model);
  std::size_t count = 0;
  for (const TrackElement& e : model.points[point].track) count += e.image == index;
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(model.images[index].observations.back().point, Observation::kNoPoint);  // the farther one
}

TEST(AddToModel, ImagesWithoutRegistrationAreReplaced) {
  const Added added(6);
  SparseModel model = added.scene.map;
  Image lost;
  lost.id = 4242;
  lost.name = added.scene.query.name;
  lost.camera = 0;
  lost.registered = false;
  lost.carried = true;
  lost.observations.push_back({1, 2, 7});
  model.points[7].track.push_back({model.images.size(), 0});
  model.images.push_back(lost);
  const std::size_t index = added.add(model);
  EXPECT_EQ(index, model.images.size() - 1);
  EXPECT_EQ(model.images[index].id, 4242u);
  EXPECT_TRUE(model.images[index].registered);
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), model);  // the tracks are valid
  EXPECT_THROW(added.add(model), std::invalid_argument);
}

TEST(AddToModel, WrongCallsAreNamed) {
  const Added added(7);
  SparseModel model = added.scene.map;
  QueryLocalization failed = *added.localization;
  failed.success = false;
  EXPECT_THROW(addToModel(model, added.scene.query, failed), std::invalid_argument);
  QueryImage other = added.scene.query;
  other.name = "other.jpg";
  EXPECT_THROW(addToModel(model, other, *added.localization), std::invalid_argument);
  SparseModel small = model;
  small.points.resize(3);
  for (Image& image : small.images) image.observations.clear();
  EXPECT_THROW(added.add(small), std::invalid_argument);
}

// Two cameras on one mount: the frame of the query is that of another image, or a new one with the mount's pose.
TEST(AddToModel, FramesAreExtended) {
  Added added(8);
  QueryImage& query = added.scene.query;
  SparseModel model = added.scene.map;
  const std::uint32_t first = model.cameras[0].id, own = query.camera.id;
  const std::vector<double> mount{1, 0, 0, 0, -0.5, 0, 0};
  const SensorRig rig{3, {{{0, first}, {}}, {{0, own}, mount}}};
  for (std::size_t i = 0; i < model.cameras.size(); ++i)
    model.rigs.push_back({static_cast<std::uint32_t>(20 + i), {{{0, model.cameras[i].id}, {}}}});
  query.rig = rig;
  query.frame = Frame{77, 3, {}, {{{0, first}, 999}, {{0, own}, query.id}}};
  const std::size_t index = added.add(model);
  ASSERT_EQ(model.rigs.size(), added.scene.map.cameras.size() + 1);
  ASSERT_EQ(model.frames.size(), 1u);
  EXPECT_EQ(model.frames[0].id, 77u);
  EXPECT_EQ(model.frames[0].data.size(), 1u);
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), model);
  ReadReport report;
  const SparseModel read = readModel(folder.path(), {}, &report);
  EXPECT_EQ(report.count(Mend::FrameContradictsImage), 0u);
  EXPECT_EQ(read.frames.size(), model.images.size());
  EXPECT_EQ(read.images[index].name, query.name);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

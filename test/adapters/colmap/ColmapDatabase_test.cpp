#include "hybridgv/adapters/colmap/ColmapDatabase.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "DatabaseFile.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/colmap/DatabaseQueries.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using test::DatabaseFile;
using test::makeQuery;
using test::QueryScene;
using test::TemporaryFolder;

QueryScene makeQueryScene(std::uint64_t stream) {
  test::Random random(test::testSeed(), stream);
  SparseModel map = test::makeScene(random, 7, 120, 0.6, {CameraModel::SimpleRadial, CameraModel::OpenCV});
  for (Image& image : map.images) image.camera = image.camera == 0 ? 0 : 1;
  // The query has a camera of its own, and one number among those of the others.
  Camera own = map.cameras[0];
  own.id = 77;
  map.images[3].camera = map.cameras.size();
  map.cameras.push_back(own);
  return makeQuery(std::move(map), 3);
}

// A scene in a database, floats for doubles.
struct Stored {
  explicit Stored(std::uint64_t stream) : scene(makeQueryScene(stream)), path(folder.file("database.db")), file(path) {
    for (Image& image : scene.map.images)
      for (Observation& o : image.observations) {
        o.x = static_cast<float>(o.x);
        o.y = static_cast<float>(o.y);
      }
    for (Keypoint& k : scene.query.keypoints) {
      k.x = static_cast<float>(k.x);
      k.y = static_cast<float>(k.y);
    }
    file.createTables();
    file.addScene(scene);
  }
  DatabaseQueryOptions allPairs() const {
    DatabaseQueryOptions options;
    options.minMatches = 1;
    return options;
  }
  QueryImage read(const DatabaseQueryOptions& options) const {
    return DatabaseQueries(ColmapDatabase(path), scene.map, options).read(scene.query.name);
  }

  TemporaryFolder folder;
  QueryScene scene;
  std::string path;
  DatabaseFile file;
};

void expectSameMatches(const QueryImage& a, const QueryImage& b) {
  ASSERT_EQ(a.matches.size(), b.matches.size());
  for (std::size_t i = 0; i < a.matches.size(); ++i) {
    EXPECT_EQ(a.matches[i].image, b.matches[i].image);
    EXPECT_EQ(a.matches[i].pairs, b.matches[i].pairs);
  }
}

template <class Call>
void expectFileError(const std::string& words, const Call& call) {
  try {
    call();
    ADD_FAILURE() << words << ": nothing thrown";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(ColmapDatabase, GivesTheQueryThatWasStored) {
  const Stored stored(1);
  for (const MatchTable table : {MatchTable::Verified, MatchTable::Raw}) {
    DatabaseQueryOptions options = stored.allPairs();
    options.table = table;
    const QueryImage query = stored.read(options);
    EXPECT_EQ(query.id, stored.scene.query.id);
    EXPECT_EQ(query.name, stored.scene.query.name);
    EXPECT_EQ(query.camera.id, 77u);
    EXPECT_EQ(query.camera.parameters, stored.scene.query.camera.parameters);
    EXPECT_EQ(query.knowledge, CameraKnowledge::Unknown);
    ASSERT_EQ(query.keypoints.size(), stored.scene.query.keypoints.size());
    for (std::size_t i = 0; i < query.keypoints.size(); ++i) {
      // Stored as single precision.
      EXPECT_EQ(query.keypoints[i].x, static_cast<float>(stored.scene.query.keypoints[i].x));
      EXPECT_EQ(query.keypoints[i].y, static_cast<float>(stored.scene.query.keypoints[i].y));
    }
    expectSameMatches(query, stored.scene.query);
    EXPECT_TRUE(query.notes.empty());
    EXPECT_FALSE(query.rig);
    EXPECT_FALSE(query.frame);
  }
  EXPECT_EQ(DatabaseQueries(ColmapDatabase(stored.path), stored.scene.map).namesNotInMap(),
            std::vector<std::string>{stored.scene.query.name});
}

// Column 0 belongs to the smaller number, whoever is the query.
TEST(ColmapDatabase, BothOrdersOfAPairAreTheSameMatches) {
  const Stored stored(2);
  const ColmapDatabase database(stored.path);
  const std::uint32_t query = stored.scene.query.id;
  const std::uint32_t other = stored.scene.map.images[stored.scene.query.matches[0].image].id;
  const DatabaseMatches there = database.matches(MatchTable::Verified, query, other);
  const DatabaseMatches back = database.matches(MatchTable::Verified, other, query);
  ASSERT_EQ(there.pairs.size(), back.pairs.size());
  ASSERT_FALSE(there.pairs.empty());
  for (std::size_t i = 0; i < there.pairs.size(); ++i) {
    EXPECT_EQ(there.pairs[i][0], back.pairs[i][1]);
    EXPECT_EQ(there.pairs[i][1], back.pairs[i][0]);
  }
}

// A database that was made anew counts its images differently.
TEST(ColmapDatabase, ImagesAreJoinedByName) {
  Stored stored(3);
  for (Image& image : stored.scene.map.images) image.id += 5000;
  expectSameMatches(stored.read(stored.allPairs()), stored.scene.query);
}

TEST(ColmapDatabase, PairsThatShowNothingAreLeftOut) {
  Stored stored(4);
  const std::vector<ImageMatches>& matches = stored.scene.query.matches;
  ASSERT_GE(matches.size(), 5u);
  const auto setConfig = [&](std::size_t i, int config) {
    const std::uint64_t a = stored.scene.query.id, b = stored.scene.map.images[matches[i].image].id;
    stored.file.run("UPDATE two_view_geometries SET config = " + std::to_string(config) +
                    " WHERE pair_id = " + std::to_string(2147483647 * std::min(a, b) + std::max(a, b)));
  };
  setConfig(0, 0);
  setConfig(1, 1);
  setConfig(2, 7);
  setConfig(3, 6);
  const QueryImage query = stored.read(stored.allPairs());
  EXPECT_EQ(query.leftOut.unverifiedPairs, 2u);
  EXPECT_EQ(query.leftOut.watermarkPairs, 1u);
  EXPECT_EQ(query.matches.size(), matches.size() - 3);
  DatabaseQueryOptions options = stored.allPairs();
  options.ignoreWatermarks = false;
  EXPECT_EQ(stored.read(options).matches.size(), matches.size() - 2);
  options.minMatches = 1000000;
  EXPECT_EQ(stored.read(options).leftOut.pairsWithFewMatches, matches.size() - 2);
}

// Rows of no matches have no blob, or an empty one.
TEST(ColmapDatabase, EmptyPairsAreNoMatches) {
  Stored stored(5);
  stored.file.run("UPDATE two_view_geometries SET rows = 0, data = NULL");
  EXPECT_TRUE(stored.read(stored.allPairs()).matches.empty());
  stored.file.run("UPDATE two_view_geometries SET cols = 0, data = x''");
  const QueryImage query = stored.read(stored.allPairs());
  EXPECT_TRUE(query.matches.empty());
  EXPECT_EQ(query.leftOut.pairsDamaged, 0u);
}

TEST(ColmapDatabase, KeypointsHaveTwoFourOrSixColumns) {
  for (const std::size_t columns : {2, 4, 6}) {
    const TemporaryFolder folder;
    DatabaseFile file(folder.file("d.db"));
    file.createTables();
    file.addKeypoints(12, {{0.5, 1.5}, {100.25, 7}}, columns);
    const ColmapDatabase database(folder.file("d.db"));
    const std::vector<Keypoint> keypoints = database.keypoints(12);
    ASSERT_EQ(keypoints.size(), 2u);
    EXPECT_EQ(keypoints[1].x, 100.25);
    EXPECT_EQ(keypoints[1].y, 7);
    EXPECT_EQ(database.keypointCount(12), 2u);
    EXPECT_EQ(database.keypointCount(13), 0u);
    EXPECT_TRUE(database.keypoints(13).empty());
  }
}

TEST(ColmapDatabase, MapsOfOtherFeaturesAreNamed) {
  Stored stored(6);
  const std::vector<ImageMatches>& matches = stored.scene.query.matches;
  Image &more = stored.scene.map.images[matches[0].image], &moved = stored.scene.map.images[matches[1].image];
  const std::size_t count = more.observations.size();
  more.observations.push_back({1, 2, Observation::kNoPoint});
  moved.observations[0].x += 0.02;
  const QueryImage query = stored.read(stored.allPairs());
  EXPECT_EQ(query.leftOut.imagesThatDiffer, 2u);
  EXPECT_EQ(query.matches.size(), matches.size() - 2);
  ASSERT_EQ(query.notes.size(), 2u);
  EXPECT_EQ(query.notes[0], "image " + more.name + " has " + std::to_string(count) + " keypoints in the database and " +
                                std::to_string(count + 1) + " in the map");
  EXPECT_NE(query.notes[1].find("image " + moved.name + " has other keypoints"), std::string::npos);
}

TEST(ColmapDatabase, CamerasOfTheMapAreKnown) {
  Stored stored(7);
  const Image& other = stored.scene.map.images[0];
  Camera& camera = stored.scene.map.cameras[other.camera];
  stored.file.run("UPDATE images SET camera_id = " + std::to_string(camera.id) +
                  " WHERE image_id = " + std::to_string(stored.scene.query.id));
  camera.parameters[0] = 1234;  // the map has refined it
  camera.id += 100;             // and counts differently
  const QueryImage query = stored.read(stored.allPairs());
  EXPECT_EQ(query.knowledge, CameraKnowledge::Known);
  EXPECT_EQ(query.camera.parameters, camera.parameters);
  EXPECT_EQ(query.camera.id, camera.id);
  DatabaseQueryOptions options = stored.allPairs();
  options.useCamerasOfMap = false;
  EXPECT_EQ(stored.read(options).knowledge, CameraKnowledge::Unknown);
}

TEST(ColmapDatabase, PriorFocalLengthsAreToldFromGuesses) {
  Stored stored(8);
  stored.file.run("UPDATE cameras SET prior_focal_length = 1 WHERE camera_id = 77");
  EXPECT_EQ(stored.read(stored.allPairs()).knowledge, CameraKnowledge::Prior);
}

TEST(ColmapDatabase, RigsAndFramesAreRead) {
  Stored stored(9);
  stored.file.createRigTables();
  const std::string id = std::to_string(stored.scene.query.id);
  const std::vector<double> pose{1, 0, 0, 0, 0.5, 0, 0};
  stored.file.run("INSERT INTO rigs VALUES (4, 100, 0)");
  stored.file.run("INSERT INTO rig_sensors VALUES (4, 77, 0, ?1), (4, 3, 1, NULL)", {DatabaseFile::bytesOf(pose)});
  stored.file.run("INSERT INTO frames VALUES (9, 4)");
  stored.file.run("INSERT INTO frame_data VALUES (9, 1000, 100, 0), (9, " + id + ", 77, 0), (9, " + id + ", 3, 1)");
  const QueryImage query = stored.read(stored.allPairs());
  ASSERT_TRUE(query.rig);
  EXPECT_EQ(query.rig->id, 4u);
  ASSERT_EQ(query.rig->sensors.size(), 3u);
  EXPECT_EQ(query.rig->sensors[0].sensor.id, 100u);
  EXPECT_EQ(query.rig->sensors[1].sensorFromRig, pose);
  EXPECT_EQ(query.rig->sensors[2].sensor.type, 1);
  ASSERT_TRUE(query.frame);
  EXPECT_EQ(query.frame->id, 9u);
  EXPECT_EQ(query.frame->rigId, 4u);
  EXPECT_EQ(query.frame->data.size(), 3u);
}

TEST(ColmapDatabase, ColumnsAreFoundByName) {
  Stored stored(10);
  stored.file.run("ALTER TABLE two_view_geometries RENAME TO old");
  stored.file.run(
      "CREATE TABLE two_view_geometries (config INTEGER, camera1 BLOB, data BLOB, cols INTEGER, rows INTEGER, pair_id"
      " INTEGER PRIMARY KEY)");
  stored.file.run("INSERT INTO two_view_geometries SELECT config, NULL, data, cols, rows, pair_id FROM old");
  expectSameMatches(stored.read(stored.allPairs()), stored.scene.query);
  stored.file.run("ALTER TABLE two_view_geometries RENAME TO inlier_matches");  // before COLMAP 3.2
  expectSameMatches(stored.read(stored.allPairs()), stored.scene.query);
}

TEST(ColmapDatabase, WhatIsMissingIsNamed) {
  for (const char* table : {"cameras", "images", "keypoints", "two_view_geometries"}) {
    Stored stored(11);
    stored.file.run(std::string("DROP TABLE ") + table);
    expectFileError(std::string("there is no table ") + table, [&] { stored.read(stored.allPairs()); });
  }
  Stored stored(12);
  stored.file.run("ALTER TABLE keypoints RENAME COLUMN cols TO columns");
  expectFileError("table keypoints has no column cols", [&] { stored.read(stored.allPairs()); });
  EXPECT_THROW(DatabaseQueries(ColmapDatabase(Stored(13).path), stored.scene.map).read("nobody.jpg"), std::invalid_argument);
}

TEST(ColmapDatabase, FilesThatAreNoDatabaseAreRefusedWithWords) {
  const TemporaryFolder folder;
  expectFileError("no such file", [&] { ColmapDatabase database(folder.file("missing.db")); });
  expectFileError("is a folder", [&] { ColmapDatabase database(folder.path()); });
  expectFileError("the file is empty", [&] { ColmapDatabase database(folder.write("empty.db", "")); });
  expectFileError("no SQLite database", [&] { ColmapDatabase database(folder.write("text.db", std::string(5000, 'x'))); });
  DatabaseFile file(folder.file("other.db"));
  file.run("CREATE TABLE songs (title TEXT)");
  expectFileError("no database of COLMAP", [&] { ColmapDatabase database(folder.file("other.db")); });
}

TEST(ColmapDatabase, DamagedRowsAreNamed) {
  Stored stored(14);
  const std::string id = std::to_string(stored.scene.query.id);
  stored.file.run("UPDATE keypoints SET rows = rows + 1 WHERE image_id = " + id);
  expectFileError("table keypoints: image " + id + ": ", [&] { stored.read(stored.allPairs()); });
  stored.file.run("UPDATE keypoints SET rows = 'many' WHERE image_id = " + id);
  expectFileError("table keypoints: rows is not an integer", [&] { stored.read(stored.allPairs()); });
  stored.file.run("UPDATE keypoints SET rows = -1 WHERE image_id = " + id);
  expectFileError("table keypoints: rows is -1", [&] { stored.read(stored.allPairs()); });
  stored.file.run("UPDATE cameras SET model = 99 WHERE camera_id = 77");
  expectFileError("its model is not known", [&] { stored.read(stored.allPairs()); });
  stored.file.run("UPDATE cameras SET model = 4 WHERE camera_id = 77");
  expectFileError("OPENCV", [&] { stored.read(stored.allPairs()); });
  stored.file.run("DELETE FROM cameras WHERE camera_id = 77");
  expectFileError("there is no camera 77", [&] { stored.read(stored.allPairs()); });
}

TEST(ColmapDatabase, DamagedPairsAreNotedAndTheOthersUsed) {
  Stored stored(15);
  const std::size_t count = stored.scene.query.matches.size();
  stored.file.run(
      "UPDATE two_view_geometries SET rows = 9223372036854775807, cols = 9223372036854775807 WHERE pair_id ="
      " (SELECT min(pair_id) FROM two_view_geometries)");
  const QueryImage query = stored.read(stored.allPairs());
  EXPECT_EQ(query.leftOut.pairsDamaged, 1u);
  EXPECT_EQ(query.matches.size(), count - 1);
  ASSERT_EQ(query.notes.size(), 1u);
  EXPECT_NE(query.notes[0].find("table two_view_geometries: images "), std::string::npos) << query.notes[0];
}

// COLMAP leaves its databases in this mode; the last changes of a program that still runs are in another file.
TEST(ColmapDatabase, IsReadWhileAnotherProgramHasItOpen) {
  Stored stored(16);
  stored.file.run("PRAGMA journal_mode = WAL");
  stored.file.run("UPDATE cameras SET prior_focal_length = 1");
  ASSERT_TRUE(std::filesystem::exists(stored.path + "-wal"));
  EXPECT_EQ(stored.read(stored.allPairs()).knowledge, CameraKnowledge::Prior);
  const ColmapDatabase database(stored.path);
  database.keypoints(stored.scene.query.id);
  stored.file.run("UPDATE cameras SET prior_focal_length = 0");  // a reader does not stand in the way
}

TEST(ColmapDatabase, FoldersThatCannotBeWrittenDoNotMatter) {
  if (geteuid() == 0) GTEST_SKIP() << "root can write everywhere";
  Stored stored(17);
  stored.file.run("PRAGMA journal_mode = WAL");
  const TemporaryFolder folder;
  { DatabaseFile(stored.path).run("PRAGMA wal_checkpoint(TRUNCATE)"); }
  const std::string copy = folder.file("database.db");
  std::filesystem::copy_file(stored.path, copy);
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_EQ(ColmapDatabase(copy).images().size(), stored.scene.map.images.size());
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(ColmapDatabase, PathsMayHoldAnyCharacter) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a?b#c%20d e.db");
  {
    DatabaseFile file(path);
    file.createTables();
    file.addImage(3, "x.jpg", 1);
  }
  EXPECT_EQ(ColmapDatabase(path).images().size(), 1u);
}

TEST(ColmapDatabase, IsNeverWritten) {
  const Stored stored(18);
  const std::string before = stored.folder.read("database.db");
  stored.read(stored.allPairs());
  EXPECT_TRUE(stored.folder.read("database.db") == before);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

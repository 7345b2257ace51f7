// A thousand databases with something wrong: an error or a note each.
#include <gtest/gtest.h>

#include "DatabaseFile.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/colmap/DatabaseQueries.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using test::DatabaseFile;
using test::QueryScene;
using test::Random;

QueryScene makeSmallScene() {
  Random random(test::testSeed(), 1);
  return test::makeQuery(test::makeScene(random, 5, 30, 0.8, {CameraModel::SimpleRadial, CameraModel::OpenCV}), 2);
}

// A value that somebody may have left in a cell.
std::string foreignValue(Random& random) {
  static const std::vector<std::string> kValues{"NULL",
                                                "-1",
                                                "0",
                                                "1",
                                                "2",
                                                "3",
                                                "7",
                                                "1e300",
                                                "'text'",
                                                "x''",
                                                "x'00'",
                                                "9223372036854775807",
                                                "-9223372036854775808",
                                                "4294967296",
                                                "zeroblob(24)",
                                                "randomblob(80)",
                                                "1.5"};
  return kValues[random.index(kValues.size())];
}

const std::vector<std::pair<std::string, std::string>>& cells() {
  static const std::vector<std::pair<std::string, std::string>> kCells{{"cameras", "camera_id"},
                                                                       {"cameras", "model"},
                                                                       {"cameras", "width"},
                                                                       {"cameras", "height"},
                                                                       {"cameras", "params"},
                                                                       {"cameras", "prior_focal_length"},
                                                                       {"images", "image_id"},
                                                                       {"images", "name"},
                                                                       {"images", "camera_id"},
                                                                       {"keypoints", "image_id"},
                                                                       {"keypoints", "rows"},
                                                                       {"keypoints", "cols"},
                                                                       {"keypoints", "data"},
                                                                       {"two_view_geometries", "pair_id"},
                                                                       {"two_view_geometries", "rows"},
                                                                       {"two_view_geometries", "cols"},
                                                                       {"two_view_geometries", "data"},
                                                                       {"two_view_geometries", "config"},
                                                                       {"rigs", "rig_id"},
                                                                       {"rigs", "ref_sensor_id"},
                                                                       {"rig_sensors", "rig_id"},
                                                                       {"rig_sensors", "sensor_from_rig"},
                                                                       {"frames", "rig_id"},
                                                                       {"frame_data", "frame_id"},
                                                                       {"frame_data", "sensor_type"},
                                                                       {"frame_data", "data_id"}};
  return kCells;
}

// The tables without any constraint, so that everything can be written into them.
void copyWithoutConstraints(DatabaseFile& file) {
  for (const char* table : {"cameras", "images", "keypoints", "two_view_geometries"}) {
    file.run(std::string("CREATE TABLE copy AS SELECT * FROM ") + table);
    file.run(std::string("DROP TABLE ") + table);
    file.run(std::string("ALTER TABLE copy RENAME TO ") + table);
  }
}

std::string oneRow(const std::string& table, Random& random) {
  return " WHERE rowid = (SELECT rowid FROM " + table + " ORDER BY rowid LIMIT 1 OFFSET " + std::to_string(random.index(4)) + ")";
}

// One bit of a blob.
void flipBit(DatabaseFile& file, const std::string& table, const std::string& column, Random& random) {
  const std::string at = std::to_string(1 + random.index(64));
  file.run("UPDATE " + table + " SET " + column + " = substr(" + column + ", 1, " + at + " - 1) || CAST(?1 AS BLOB) || substr(" +
               column + ", " + at + " + 1)" + oneRow(table, random),
           {std::string(1, static_cast<char>(random.index(256)))});
}

void damage(DatabaseFile& file, Random& random) {
  const auto& [table, column] = cells()[random.index(cells().size())];
  switch (random.index(8)) {
    case 0:
      return file.run("DELETE FROM " + table + oneRow(table, random));
    case 1:
      return file.run("INSERT INTO " + table + " SELECT * FROM " + table + " LIMIT 1");
    case 2:
      return flipBit(file, "keypoints", "data", random);
    case 3:
      return flipBit(file, "two_view_geometries", "data", random);
    case 4:
      return flipBit(file, "cameras", "params", random);
    case 5:
      return random.index(3) == 0 ? file.run("DROP TABLE " + table)
                                  : file.run("ALTER TABLE " + table + " RENAME COLUMN " + column + " TO other");
    default:
      return file.run("UPDATE " + table + " SET " + column + " = " + foreignValue(random) + oneRow(table, random));
  }
}

// Reads everything there is. Counts what was refused.
struct Outcome {
  std::size_t errors = 0, notes = 0, queries = 0;
};
void readAll(const std::string& path, const SparseModel& map, Outcome& outcome) {
  try {
    DatabaseQueryOptions options;
    options.minMatches = 1;
    DatabaseQueries queries(ColmapDatabase(path), map, options);
    for (const DatabaseImage& image : queries.database().images()) {
      try {
        const QueryImage query = queries.read(image.name);
        outcome.notes += query.notes.size();
        makeLocalizationProblem(map, query);
        ++outcome.queries;
      } catch (const FileError&) {
        ++outcome.errors;
      } catch (const std::invalid_argument&) {  // a camera that cannot be estimated
        ++outcome.errors;
      }
    }
  } catch (const FileError&) {
    ++outcome.errors;
  }
}

TEST(DamagedDatabases, AThousandGiveAnErrorOrANote) {
  const QueryScene scene = makeSmallScene();
  const test::TemporaryFolder folder;
  {
    DatabaseFile whole(folder.file("whole.db"));
    whole.createTables();
    whole.createRigTables();
    whole.addScene(scene);
    whole.run("INSERT INTO rigs VALUES (1, 100, 0)");
    whole.run("INSERT INTO rig_sensors VALUES (1, 103, 0, zeroblob(56))");
    for (const Image& image : scene.map.images) {
      const std::string id = std::to_string(image.id), camera = std::to_string(scene.map.cameras[image.camera].id);
      whole.run("INSERT INTO frames VALUES (" + id + ", 1)");
      whole.run("INSERT INTO frame_data VALUES (" + id + ", " + id + ", " + camera + ", 0)");
    }
    copyWithoutConstraints(whole);
  }
  const std::string bytes = folder.read("whole.db");
  Outcome outcome;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    Random random(test::testSeed(), 100 + i);
    const std::string path = folder.write("damaged.db", bytes);
    {
      DatabaseFile file(path);
      for (int k = 0; k <= static_cast<int>(random.index(2)); ++k) {
        try {
          damage(file, random);
        } catch (const std::runtime_error&) {  // the column or table is gone already
        }
      }
    }
    const std::string before = folder.read("damaged.db");
    readAll(path, scene.map, outcome);
    ASSERT_TRUE(folder.read("damaged.db") == before) << "the database was written";
  }
  EXPECT_GT(outcome.errors, 300u);
  EXPECT_GT(outcome.notes, 50u);
  EXPECT_GT(outcome.queries, 1000u);
}

// Pages of the file, not only what is in the tables: SQLite's own checks speak.
TEST(DamagedDatabases, DamagedPagesAreRefused) {
  const QueryScene scene = makeSmallScene();
  const test::TemporaryFolder folder;
  {
    DatabaseFile whole(folder.file("whole.db"));
    whole.createTables();
    whole.addScene(scene);
  }
  const std::string bytes = folder.read("whole.db");
  Outcome outcome;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(test::testSeed(), 5000 + i);
    std::string damaged = bytes;
    if (random.index(3) == 0)
      damaged.resize(random.index(damaged.size()));
    else
      for (int k = 0; k < 20; ++k) damaged[random.index(damaged.size())] = static_cast<char>(random.index(256));
    readAll(folder.write("damaged.db", damaged), scene.map, outcome);
  }
  EXPECT_GT(outcome.errors, 20u);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

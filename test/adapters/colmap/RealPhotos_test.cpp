// Ten photographs in a real database, with maps of six and five of them (HYBRIDGV_REALDATA_DIR/photos); skipped where they are absent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/colmap/DatabaseQueries.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "statistics.hpp"

namespace hybridgv {
namespace sfm {
namespace {

const std::string kFolder = std::string(HYBRIDGV_REALDATA_DIR) + "/photos";

// A query and where it was, by a reconstruction of all ten.
struct Reference {
  std::string map, name;
  double focalLength = 0, k1 = 0;
};

std::vector<Reference> readReferences() {
  std::vector<Reference> references;
  std::ifstream in(kFolder + "/reference.txt");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    Reference r;
    double width = 0, height = 0;
    std::istringstream(line) >> r.map >> r.name >> width >> height >> r.focalLength >> r.k1;
    references.push_back(r);
  }
  return references;
}

class RealPhotos : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder + "/database.db")) GTEST_SKIP() << "no folder " << kFolder;
    // SQLite writes beside a database in WAL mode even where it only reads.
    std::filesystem::copy_file(kFolder + "/database.db", database_);
  }
  test::TemporaryFolder folder_;
  const std::string database_ = folder_.file("database.db");
};

TEST_F(RealPhotos, MapsJoinTheDatabase) {
  for (const std::string name : {"map0", "map2"}) {
    const SparseModel map = readModel(kFolder + "/" + name);
    DatabaseQueries queries(ColmapDatabase(database_), map);
    std::vector<std::string> expected;
    for (const Reference& r : readReferences())
      if (r.map == name) expected.push_back(r.name);
    std::vector<std::string> found = queries.namesNotInMap();
    for (const std::string& query : expected) EXPECT_EQ(std::count(found.begin(), found.end(), query), 1) << query;
    EXPECT_EQ(found.size() + map.images.size(), 10u);
    for (const std::string& query : expected) {
      const QueryImage image = queries.read(query);
      EXPECT_TRUE(image.notes.empty());
      EXPECT_EQ(image.leftOut.imagesThatDiffer + image.leftOut.pairsDamaged, 0u);
      EXPECT_GE(image.matches.size(), 2u);
      EXPECT_EQ(makeLocalizationProblem(map, image).leftOut.indicesOutOfRange, 0u);
    }
  }
}

TEST_F(RealPhotos, AllQueriesAreLocalized) {
  for (const MatchTable table : {MatchTable::Verified, MatchTable::Raw}) {
    std::vector<double> errors;
    for (const Reference& r : readReferences()) {
      const SparseModel map = readModel(kFolder + "/" + r.map);
      DatabaseQueryOptions options;
      options.table = table;
      const LocalizationProblem problem =
          makeLocalizationProblem(map, DatabaseQueries(ColmapDatabase(database_), map, options).read(r.name));
      const sac::HybridRansacResult result = sac::hybridRansac(problem.adapter);
      ASSERT_TRUE(result.success) << r.name << ": " << toString(result.failureReason);
      errors.push_back(100 * std::abs(result.pose.focalLength / r.focalLength - 1));
    }
    EXPECT_LT(test::median(errors), 1.5);
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

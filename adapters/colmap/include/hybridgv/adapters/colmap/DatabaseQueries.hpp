/// \file
/// \brief Query images from a COLMAP database, matched with a map.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "hybridgv/adapters/colmap/ColmapDatabase.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// Which matches count.
struct DatabaseQueryOptions {
  MatchTable table = MatchTable::Verified;  ///< where they are read
  std::size_t minMatches = 15;              ///< pairs of images with fewer are left out (COLMAP's Mapper.min_num_matches)
  bool ignoreWatermarks = true;             ///< leave out pairs of images that share a watermark only
  /// A query whose camera belongs to images of the map has that camera's parameters, as they are in the map.
  bool useCamerasOfMap = true;
};

/// Joins a database with a map that was made from it, or from another one with the same images.
///
/// Images are joined by **name**: ids change when a database is made anew. The keypoints of a map image must be those of the database,
/// in the same order (0.01 px); images where they are not, such as after another feature extraction, are left out and noted. A map
/// without 2D-2D indices of a database (Bundler, NVM) has no matches here.
class HYBRIDGV_EXPORT DatabaseQueries {
 public:
  /// \param map  kept by reference
  DatabaseQueries(ColmapDatabase database, const SparseModel& map, const DatabaseQueryOptions& options = {});
  ~DatabaseQueries();
  /// What it is taken from can only be destroyed.
  DatabaseQueries(DatabaseQueries&&) noexcept;
  DatabaseQueries& operator=(DatabaseQueries&&) = delete;

  /// The database.
  const ColmapDatabase& database() const;
  /// The images of the database that the map has not registered, ascending by id.
  std::vector<std::string> namesNotInMap() const;

  /// An image of the database with its matches: with each map image two index look-ups, whatever the size of the database. What is
  /// damaged in a pair of images is left out and noted.
  ///
  /// \throws std::invalid_argument if there is no such image; FileError if its own row, camera or keypoints are damaged
  QueryImage read(const std::string& name);

 private:
  struct Join;
  std::unique_ptr<Join> join_;
};

}  // namespace sfm
}  // namespace hybridgv

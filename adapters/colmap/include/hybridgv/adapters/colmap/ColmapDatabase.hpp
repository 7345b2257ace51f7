/// \file
/// \brief Reads COLMAP's database.db: cameras, images, keypoints, matches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// A row of the table images.
struct DatabaseImage {
  std::uint32_t id = 0;      ///< image_id
  std::string name;          ///< unique
  std::uint32_t camera = 0;  ///< camera_id
};

/// A row of the table cameras.
struct DatabaseCamera {
  Camera camera;                     ///< model Unknown if it is not one of COLMAP 4.1
  bool hasPriorFocalLength = false;  ///< from EXIF or the user; false: 1.2 times the longer side, which says nothing
};

/// Which matches are read.
enum class MatchTable {
  Verified,  ///< two_view_geometries: those that fit an epipolar geometry or a homography
  Raw,       ///< matches: as the features were matched
};

/// What a pair of images shows; COLMAP's numbers (two_view_geometries.config).
constexpr int kConfigDegenerate = 1;  ///< no geometry was found (0 likewise)
constexpr int kConfigWatermark = 7;   ///< the same imprint in both

/// The matches of two images.
struct DatabaseMatches {
  std::vector<std::array<std::uint32_t, 2>> pairs;  ///< keypoint of the first image, keypoint of the second
  std::optional<int> config;                        ///< see above; empty for raw matches
};

/// A database of COLMAP (3.6 to 4.1, and files of before with inlier_matches), opened for reading only.
///
/// Nothing is written: neither rows nor, unlike in COLMAP, a newer schema. A database in use by another program is read in its last
/// complete state. Columns are found by their names; tables that are not needed may be missing. Rows are read by their keys when they
/// are asked for, so that memory does not grow with the size of the file (except for images and cameras, a hundred bytes each).
///
/// Every function throws FileError ("FILE: table keypoints, image 12: ...") for what is damaged: a file that is no database, a missing
/// table or column, blobs of another size than rows and columns say. One object must not be used by two threads at once; several
/// objects may read one file.
class HYBRIDGV_EXPORT ColmapDatabase {
 public:
  /// Opens the file, and reads its images and cameras.
  explicit ColmapDatabase(const std::string& path);
  ~ColmapDatabase();
  /// The database moves; what it is taken from can only be destroyed or assigned to.
  ColmapDatabase(ColmapDatabase&&) noexcept;
  /// Likewise.
  ColmapDatabase& operator=(ColmapDatabase&&) noexcept;

  /// As given to the constructor.
  const std::string& path() const;
  /// All images, ascending by id.
  const std::vector<DatabaseImage>& images() const;
  /// The image of this name, nullptr if there is none.
  const DatabaseImage* findImage(const std::string& name) const;
  /// The camera with this id, nullptr if there is none.
  const DatabaseCamera* findCamera(std::uint32_t id) const;

  /// How many keypoints an image has.
  std::size_t keypointCount(std::uint32_t imageId) const;
  /// Its keypoints; they may be not finite. Empty if there are none.
  std::vector<Keypoint> keypoints(std::uint32_t imageId) const;
  /// The matches of two images, empty if the table has none for them. Indices may be out of range.
  DatabaseMatches matches(MatchTable table, std::uint32_t firstId, std::uint32_t secondId) const;

  /// The rig to which a camera belongs and the frame to which an image belongs; empty in databases before COLMAP 3.12. The frame's
  /// pose has no meaning.
  std::optional<SensorRig> rigOf(std::uint32_t cameraId) const;
  std::optional<Frame> frameOf(std::uint32_t imageId) const;  ///< see rigOf()

 private:
  struct Contents;
  std::unique_ptr<Contents> contents_;
};

}  // namespace sfm
}  // namespace hybridgv

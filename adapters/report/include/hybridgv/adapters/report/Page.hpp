/// \file
/// \brief What was localized, to look at: one HTML page, or a PLY file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/adapters/sfm/localizeQuery.hpp"
#include "hybridgv/export.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace report {

/// A correspondence in the query image.
struct Mark {
  double x = 0;                         ///< [px] as detected, distorted
  double y = 0;                         ///< [px] as detected, distorted
  bool isInlier = false;                ///< it agrees with the pose
  std::vector<sfm::Keypoint> epipolar;  ///< 2D-2D inliers: the image of the map's ray, a few points of it [px]
};

/// What one image of the map has to do with a query image.
struct MapImageShare {
  std::string name;             ///< of the map image
  std::size_t matches = 0;      ///< correspondences with it
  std::size_t inliers2d2d = 0;  ///< of which are inliers as rays
  std::size_t inliers2d3d = 0;  ///< or voted for points that are inliers
};

/// A query image on the page.
struct ReportedImage {
  std::string name;                         ///< any bytes; shown as text
  bool success = false;                     ///< pose and camera can be relied on
  std::string reason;                       ///< why not
  double width = 0;                         ///< [px]
  double height = 0;                        ///< [px]
  FocalPose pose;                           ///< of a success, in the map's frame
  std::array<Eigen::Vector3d, 4> corners;   ///< of a success: viewing rays of the image's corners in the camera's frame
  double focalLength = 0;                   ///< [px]
  double focalLengthStandardDeviation = 0;  ///< [px]
  double k1 = 0;                            ///< distortion as of COLMAP's SIMPLE_RADIAL
  double k1StandardDeviation = 0;           ///< of k1; 0 if it is not estimated
  double seconds = 0;                       ///< of the search
  std::size_t matches2d3d = 0;              ///< correspondences
  std::size_t matches2d2d = 0;              ///< correspondences
  std::size_t inliers2d3d = 0;              ///< of which agree with the pose
  std::size_t inliers2d2d = 0;              ///< of which agree with the pose
  std::vector<Mark> marks2d3d;              ///< all of them, or none
  std::vector<Mark> marks2d2d;              ///< all of them, or none
  std::vector<MapImageShare> mapImages;     ///< one for each map image that has matches
};

/// An image that localizeQuery() has localized, or has not.
/// \throws std::invalid_argument if the two do not belong together, or the localization is of another map
HYBRIDGV_EXPORT ReportedImage reportedImage(const sfm::SparseModel& map, const sfm::QueryImage& query,
                                            const sfm::QueryLocalization& localization);

/// An image of the map that was left out of it, and what hybridRansac has found.
/// \throws std::invalid_argument if the problem is not one of this image and map
HYBRIDGV_EXPORT ReportedImage reportedImage(const sfm::SparseModel& map, std::size_t imageIndex,
                                            const sfm::LocalizationProblem& problem, const sac::HybridRansacResult& result);

/// How the page is made. Whatever of the limits comes into effect is said on the page.
struct PageOptions {
  std::string title = "HybridGV";  ///< text
  /// Folder with the query images by their names; empty: the page shows the correspondences alone. JPEG and PNG files go into the
  /// page unchanged; those that are too large are linked by their relative path. Names that lead out of the folder are not looked for.
  std::string imageFolder;
  std::size_t maxPoints = 200000;         ///< of more points of the map every second, third .. is drawn
  std::size_t maxMarks = 200000;          ///< correspondences of all images together; the images after that have only numbers
  std::size_t maxImageBytes = 4u << 20u;  ///< of one image in the page
  std::size_t maxBytesOfAllImages = 40u << 20u;  ///< of all images in the page
};

/// Appends an image without its correspondences if those of all images together are more than `maxMarks`: the page does not show them, and
/// those of thousands of images need memory.
HYBRIDGV_EXPORT void addImage(std::vector<ReportedImage>& images, ReportedImage image,
                              std::size_t maxMarks = PageOptions().maxMarks);

/// The page as a string, for a file beside `path` (of which only the folder matters, for links).
/// \throws std::invalid_argument for poses that are not finite
HYBRIDGV_EXPORT std::string makePage(const std::string& path, const sfm::SparseModel& map,
                                     const std::vector<ReportedImage>& images, const PageOptions& options = {});

/// One HTML file that needs nothing else, no library and no network: the points and cameras of the map with the localized images; for each
/// image its correspondences, the numbers; a table of all. It takes its place when it is complete.
/// \throws sfm::FileError if the file cannot be written; std::invalid_argument as makePage()
HYBRIDGV_EXPORT void writePage(const std::string& path, const sfm::SparseModel& map, const std::vector<ReportedImage>& images,
                               const PageOptions& options = {});

/// The points of the map, its cameras (blue) and the localized images (red) as a point cloud, for MeshLab and the like: binary PLY,
/// little endian. Viewers seldom draw edges, so each camera is drawn as points along the edges of its frustum.
/// \throws as writePage()
HYBRIDGV_EXPORT void writePly(const std::string& path, const sfm::SparseModel& map, const std::vector<ReportedImage>& images);

}  // namespace report
}  // namespace hybridgv

/// \file
/// \brief An image to be localized against the other images of a sparse model, and the text format of such problems.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hybridgv/adapters/NoncentralHybridAdapter.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/adapters/sfm/ReadReport.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/export.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace sfm {

/// How makeLocalizationProblem turns matches with a map into correspondences.
struct LocalizationProblemOptions {
  /// A point becomes a 2D-3D correspondence only if the viewing rays of two map images meet in it at this angle or a larger one;
  /// below, its depth is uncertain.
  double minParallaxDeg = 2;
  /// ... and only if it projects to within this distance of what every map image has observed [px of the undistorted map image].
  /// The default is several times the noise of features, so that it rejects mismatches only.
  double maxMapReprojectionErrorPx = 4;
  /// A keypoint that has a 2D-3D correspondence gets 2D-2D correspondences too. They add little beside the point, and double the
  /// weight of a mismatch.
  bool raysBesidePoints = false;
  /// Leave-one-out: the distortion of the query is removed by its calibration, which a real query does not have. false: nothing but its
  /// size and the shape of its pixels is used, and not even the principal point where the size is known. (Cameras whose distortion is
  /// beyond what one parameter describes, of the models fisheye, FOV and so on, are undistorted in any case.)
  bool undistortQuery = true;
  /// As if the map had no points, only images and matches: every correspondence is 2D-2D.
  bool raysOnly = false;
  /// What findCertainPoints() has found for the map and these options, to save the time where there are many queries that are not in
  /// the map; null: looked for in every query anew.
  std::shared_ptr<const std::vector<char>> certainPoints = {};
};

/// Which points of a map have the parallax and the small errors that `options` ask for: 1 or 0 for each of SparseModel::points.
/// \throws std::invalid_argument for a map whose indices are not valid, and options that are negative or not finite
HYBRIDGV_EXPORT std::shared_ptr<const std::vector<char>> findCertainPoints(const SparseModel& map,
                                                                           const LocalizationProblemOptions& options = {});

/// Hybrid correspondences of one query image.
struct LocalizationProblem {
  std::string imageName;            ///< of the query
  NoncentralHybridAdapter adapter;  ///< the correspondences
  /// Pose and focal length of the query according to the model; never used in making the correspondences.
  std::optional<FocalPose> reference;
  /// For every camera index of the adapter: the image of the model, SparseModel::images (empty if read from a file).
  std::vector<std::size_t> rigImages;
  /// For every 2D-2D correspondence: the point of the model, SparseModel::points, or Observation::kNoPoint (empty if read from a
  /// file).
  std::vector<std::size_t> points2d2d;
  std::vector<std::size_t> points2d3d;  ///< for every 2D-3D correspondence: its point of the model (empty if read from a file)
  /// For every 2D-2D correspondence: true if injectOutliers has given it a wrong image point.
  std::vector<bool> isOutlier2d2d;
  std::vector<bool> isOutlier2d3d;  ///< for every 2D-3D correspondence: true if injectOutliers has made it wrong
  /// For every 2D-2D correspondence: the keypoint of the query, QueryImage::keypoints or Image::observations (empty if read from a
  /// file). Those of one keypoint are not independent.
  std::vector<std::size_t> keypoints2d2d = {};
  std::vector<std::size_t> keypoints2d3d = {};  ///< for every 2D-3D correspondence: its keypoint (empty if read from a file)
  LeftOut leftOut = {};                         ///< what was not used, including what the query's reader has left out
  /// Whether the query's image points are known to be free of distortion; otherwise hybridRansac should estimate it (ransacOptions()).
  bool isUndistorted = false;
  std::uint64_t imageWidth = 0;   ///< [px] of the query's image, 0 = unknown
  std::uint64_t imageHeight = 0;  ///< [px] of the query's image, 0 = unknown
  /// k1 of the query's camera according to the model, of COLMAP's SIMPLE_RADIAL and the like: what belongs to `reference`. Empty if the
  /// image points are undistorted.
  std::optional<double> referenceK1 = {};
};

/// Makes `model.images[imageIndex]` a query of unknown pose and focal length, and the other images the rig (leave-one-out).
///
/// The query's observations are taken out of every track. A track that one map image still sees gives a 2D-2D correspondence: the
/// query's image point and that image's viewing ray. A track that two or more still see is triangulated again, without the query
/// (least squares over their reprojection errors), and gives a 2D-3D correspondence. If no two of its rays meet at a sufficient
/// angle, or if the point lies behind an image or does not fit its observations, the track gives a 2D-2D correspondence with the
/// first of its images instead: it still restrains the query in one direction, and a robust estimator drops it if it is a
/// mismatch. An image that a track names twice counts with the first of its two observations.
///
/// The choice depends on the map images alone: moving an observation of the query changes that image point of the problem and
/// nothing else.
///
/// Image points are in pixels of the query, undistorted and relative to its principal point (see undistort()); observations
/// outside the invertible range of the distortion are left out. The rig's frame is the model's. Rig focal lengths are set.
///
/// Map images may have any camera model, since only their viewing rays are needed. A query with a fisheye camera is undistorted to
/// a pinhole image; its observations more than 60 degrees off the axis are left out, where that image magnifies pixels more than
/// fourfold. A panorama (no image plane) cannot be a query.
///
/// \param imageIndex  index into model.images (not the id in the file)
/// \throws std::invalid_argument for an index out of range, an image that is not registered or has no image plane, options
///         that are negative or not finite, and invalid indices or numbers that are not finite in those parts of the model that are needed
HYBRIDGV_EXPORT LocalizationProblem makeLocalizationProblem(const SparseModel& model, std::size_t imageIndex,
                                                            const LocalizationProblemOptions& options = {});

/// Makes correspondences of an image that is not in the map and of its matches.
///
/// * A match whose observation has a point gives a 2D-3D correspondence of the keypoint and that point, once for all map images that
///   agree on it; how many they are is its weight, times the mean score. The point must have parallax and fit what its images see
///   (see `options`); its position is the map's. A keypoint may have several points.
/// * If the point is not that certain, or if the observation has no point, the match gives a 2D-2D correspondence: the keypoint and
///   the observation's viewing ray. (COLMAP's image_registrator leaves these out.)
/// * A keypoint with a 2D-3D correspondence has no 2D-2D ones, unless options.raysBesidePoints. Several rays of one keypoint stay
///   several correspondences.
///
/// Image points are relative to the principal point, of square pixels. A known camera's are undistorted; otherwise the distortion is
/// still in them (hybridRansac finds it with QueryCamera::Radial). Otherwise as for an image of the map: see above.
///
/// \throws std::invalid_argument for options.certainPoints of another number of points, a match with an image that does not exist, scores
///         that are not one for each pair, a camera whose model cannot be estimated (SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL,
///         OPENCV can) unless it is known, and what is wrong in those parts of the map that are needed
HYBRIDGV_EXPORT LocalizationProblem makeLocalizationProblem(const SparseModel& map, const QueryImage& query,
                                                            const LocalizationProblemOptions& options = {});

/// The problem with wrong matches: of the correspondences of each kind a share (rounded to the nearest count) is chosen at
/// random, and the query image points of all chosen ones are permuted so that none keeps its own. A single one cannot be permuted
/// and is left as it is. The same seed gives the same result on every platform.
///
/// \param share  0 .. 1
/// \throws std::invalid_argument for a share outside 0 .. 1
HYBRIDGV_EXPORT LocalizationProblem injectOutliers(const LocalizationProblem& problem, double share, std::uint64_t seed);

/// Reads the text format of problems. Lines, in any order, `#` starts a comment:
///
///     query f qw qx qy qz tx ty tz   at most one: reference, focal length [px] and x_query = R(q) X + t, the inverse of FocalPose
///     image width height             at most one: size of the query's image [px]
///     cam id cx cy cz [f qw qx qy qz]   a rig camera, its centre; its focal length (0 = unknown) and rotation, x_rig = R(q) x_cam
///     p3 u v X Y Z                   2D-3D: image point [px], relative to the principal point; point of the rig
///     p2 u v camid qx qy qz          2D-2D: image point; direction of the ray in the rig's frame, from that camera's centre
///
/// Image points may be raw or undistorted. A rig camera without rotation has a frame parallel to the rig's, one without focal length an
/// unknown one. imageName is the file's name without folder and extension.
///
/// \param report  what was mended (byte order marks, 128.0 for an integer); may be null
/// \throws FileError for a malformed file
HYBRIDGV_EXPORT LocalizationProblem readProblem(const std::string& path, const ReadOptions& options = {},
                                                ReadReport* report = nullptr);

/// True if the first line that is neither empty nor a comment starts with one of the words of that format. False for a file that
/// cannot be read.
HYBRIDGV_EXPORT bool isProblemFile(const std::string& path);

/// Writes that format, with as many digits as are needed to read the same numbers again.
/// \throws FileError if the file cannot be written
HYBRIDGV_EXPORT void writeProblem(const std::string& path, const LocalizationProblem& problem);

}  // namespace sfm
}  // namespace hybridgv

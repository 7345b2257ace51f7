/// \file
/// \brief Localizes images that are not in the map: pose, focal length, distortion.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/export.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace sfm {

/// How query images are localized.
struct QueryOptions {
  LocalizationProblemOptions matches;  ///< how matches become correspondences
  /// The search. What is known of a camera is set for every query: knownFocalLengthPx, focalLengthPriorPx with its deviation,
  /// queryCamera, and imageRadiusPx unless it is given.
  sac::HybridRansacOptions ransac;
  /// The standard deviation of a prior focal length, as a share of it. (EXIF is often wrong by several percent.)
  double priorDeviation = 0.15;
  bool estimateDistortion = true;  ///< of cameras that are not known; it is kept only if the data speak for it
  int minInliers = 12;             ///< a success has so many inliers of both kinds together
  double minInlierShare = 0;       ///< and they are so large a share of the correspondences
};

/// What one image of the map has to do with a query.
struct PairReport {
  std::size_t image = 0;        ///< index into SparseModel::images
  std::size_t matches = 0;      ///< with the query
  std::size_t inliers2d2d = 0;  ///< of which became inliers as rays
  std::size_t inliers2d3d = 0;  ///< or voted for points that are inliers
};

/// A query image, localized or not.
struct QueryLocalization {
  bool success = false;            ///< pose and camera can be relied on
  std::string reason;              ///< why not, in words; empty on success
  LocalizationProblem problem;     ///< the correspondences
  sac::HybridRansacResult result;  ///< pose with covariance, inliers
  /// The query's camera, of the model that it was given, with what was found: COLMAP's parameters.
  Camera camera;
  double k1 = 0;                   ///< distortion found; see distortionIsLost
  double k1StandardDeviation = 0;  ///< of k1; 0 if there is none
  bool distortionIsLost = false;   ///< the camera's model (SIMPLE_PINHOLE, PINHOLE) has no place for k1
  std::vector<PairReport> pairs;   ///< one for each of QueryImage::matches
};

/// Localizes one query image.
///
/// * Unknown camera: focal length and distortion are found with the pose.
/// * Prior focal length: the same; where the matches leave it open, a value near to the prior is taken.
/// * Known camera: only the pose is found, six parameters; `camera` is returned as given.
///
/// \throws std::invalid_argument as makeLocalizationProblem() and hybridRansac(), and for options that make no sense
HYBRIDGV_EXPORT QueryLocalization localizeQuery(const SparseModel& map, const QueryImage& query,
                                                const QueryOptions& options = {});

/// What one image, or several together, say about a camera.
struct CameraEstimate {
  double focalLength = 0;  ///< fx [px]
  double deviation = 0;    ///< its standard deviation [px]
  double k1 = 0;           ///< distortion
};

/// What a success says about its camera.
HYBRIDGV_EXPORT CameraEstimate estimateOf(const QueryLocalization& localization);

/// What images of one camera agree on: the mean, weighted by their deviations, without those that contradict the others' focal length.
/// (Deviations say nothing of errors that all matches of an image share: none is taken for smaller than 0.2 % of the focal length.)
/// \return empty if there are no estimates
HYBRIDGV_EXPORT std::optional<CameraEstimate> agree(const std::vector<CameraEstimate>& estimates);

/// Localizes one of several images of a camera, of which they have agreed on an estimate. If the image knows better (by five
/// deviations, of at least 1 %), or if that camera does not fit, it is localized as if it were alone.
HYBRIDGV_EXPORT QueryLocalization localizeQuery(const SparseModel& map, const QueryImage& query, const CameraEstimate& common,
                                                const QueryOptions& options = {});

/// Localizes several query images of **one camera**: each by itself first; then each once more with the camera on which they agree(). An
/// image that this does not fit keeps its own. (Where there are too many for the memory, do the same with the functions above.)
///
/// \return one for each query, in their order; all that were localized with the common camera have the same `camera`
/// \throws std::invalid_argument as localizeQuery(), and if the queries' cameras differ
HYBRIDGV_EXPORT std::vector<QueryLocalization> localizeQueries(const SparseModel& map, const std::vector<QueryImage>& queries,
                                                               const QueryOptions& options = {});

}  // namespace sfm
}  // namespace hybridgv

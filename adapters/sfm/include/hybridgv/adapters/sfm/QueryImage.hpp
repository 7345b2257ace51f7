/// \file
/// \brief An image that is not in the map, with its features and their matches: what every reader of matches gives.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hybridgv/adapters/sfm/Camera.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace sfm {

/// A feature of a query image [px], distorted, in COLMAP's convention: the centre of the top left pixel is (0.5, 0.5).
struct Keypoint {
  double x = 0;  ///< [px] to the right
  double y = 0;  ///< [px] downwards
};

/// The matches of a query image with one image of the map.
struct ImageMatches {
  std::size_t image = 0;  ///< index into SparseModel::images
  /// Index of the keypoint (QueryImage::keypoints), index of the observation (Image::observations).
  std::vector<std::array<std::uint32_t, 2>> pairs;
  std::vector<double> scores;  ///< one per pair, larger is better; empty: all alike
};

/// How far QueryImage::camera can be believed.
enum class CameraKnowledge {
  Unknown,  ///< only its model, size and principal point: focal length and distortion are to be found
  Prior,    ///< the focal length also, within some percent (from EXIF)
  Known,    ///< everything: a calibrated camera, or one that the map has
};

/// What a reader or makeLocalizationProblem() could not use.
struct LeftOut {
  std::size_t imagesNotInMap = 0;       ///< images with matches that the map does not have, or has without a pose
  std::size_t imagesThatDiffer = 0;     ///< map images whose keypoints are not those of the matches; see QueryImage::notes
  std::size_t pairsWithFewMatches = 0;  ///< pairs of images with fewer matches than wanted
  std::size_t watermarkPairs = 0;       ///< pairs of images that share a watermark only
  std::size_t unverifiedPairs = 0;      ///< pairs of images without verified geometry
  std::size_t pairsDamaged = 0;         ///< pairs of images whose matches cannot be read
  std::size_t indicesOutOfRange = 0;    ///< matches that name a keypoint or an observation that does not exist
  std::size_t keypointsNotUsable = 0;   ///< matched keypoints that are not finite, or outside of what the camera can see
};

/// An image whose pose with respect to a map is wanted.
struct QueryImage {
  std::uint32_t id = 0;  ///< the number in the database, 0 = none
  std::string name;      ///< as in the database
  /// Size, model, principal point, and parameters as far as `knowledge` says. Without parameters the principal point is the
  /// middle of the image.
  Camera camera;
  CameraKnowledge knowledge = CameraKnowledge::Unknown;  ///< how far `camera` can be believed
  std::vector<Keypoint> keypoints;                       ///< its features
  std::vector<ImageMatches> matches;                     ///< at most one entry for every image of the map
  LeftOut leftOut;                                       ///< what the reader has left out
  std::vector<std::string> notes;                        ///< what a user should know about that, in words
  /// The rig to which the camera belongs, and the frame with all images that were taken at the same time, by the numbers of the
  /// database (COLMAP 3.12 and later).
  std::optional<SensorRig> rig;
  std::optional<Frame> frame;  ///< its pose has no meaning
};

}  // namespace sfm
}  // namespace hybridgv

/// \file
/// \brief Puts localized images into the map.
#pragma once

#include <cstddef>

#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/adapters/sfm/localizeQuery.hpp"
#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// Makes a localized query image an image of the model, as COLMAP's image_registrator does: with its camera and all its keypoints; each
/// inlier among the 2D-3D correspondences continues the track of its point. (Of two keypoints of one point, and of two points of one
/// keypoint, the one with the smaller error counts.) Nothing else changes.
///
/// Its number and those of its camera, its rig and its frame are those of the database as long as the model has nothing else under
/// them; otherwise the next free ones. A camera that the model has already, with the same parameters, is shared. Where the model has
/// rigs and frames, the image is put into its frame; the pose of a frame that is there already is not touched.
///
/// An image of the same name that is not registered is replaced.
///
/// \param model         the map of the localization, to which other queries may have been added meanwhile
/// \param localization  a success of `query`
/// \return the image's index
/// \throws std::invalid_argument for a localization without success, of another query or another map, and if the model has registered an
///         image of that name
HYBRIDGV_EXPORT std::size_t addToModel(SparseModel& model, const QueryImage& query, const QueryLocalization& localization);

}  // namespace sfm
}  // namespace hybridgv

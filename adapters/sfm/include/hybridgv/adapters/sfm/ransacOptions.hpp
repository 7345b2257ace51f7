/// \file
/// \brief What a localization problem tells hybridRansac about the query's camera.
#pragma once

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/export.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"

namespace hybridgv {
namespace sfm {

/// The options with what is known of the query's image: queryCamera is Radial unless the image points are undistorted, imageRadiusPx half
/// the image's diagonal where its size is known and `options` have none.
HYBRIDGV_EXPORT sac::HybridRansacOptions ransacOptions(const LocalizationProblem& problem, sac::HybridRansacOptions options = {});

}  // namespace sfm
}  // namespace hybridgv

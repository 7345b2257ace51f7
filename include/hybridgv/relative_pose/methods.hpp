/// \file
/// \brief Minimal solver for 2D-2D correspondences with one calibrated camera, unknown focal length of the query.
#pragma once

#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace relative_pose {

/// Six-point relative pose with one unknown focal length.
HYBRIDGV_EXPORT FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
HYBRIDGV_EXPORT FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter);

}  // namespace relative_pose
}  // namespace hybridgv

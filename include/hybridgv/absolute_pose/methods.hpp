/// \file
/// \brief Minimal solvers for 2D-3D correspondences alone, unknown focal length.
#pragma once

#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace absolute_pose {

/// P4Pf: see the implementation notes below once written.
HYBRIDGV_EXPORT FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
HYBRIDGV_EXPORT FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter);

/// P3.5Pf
HYBRIDGV_EXPORT FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
HYBRIDGV_EXPORT FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter);

}  // namespace absolute_pose
}  // namespace hybridgv

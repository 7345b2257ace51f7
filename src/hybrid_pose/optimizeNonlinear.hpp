// The body of optimize_nonlinear, on plain data.
#pragma once

#include "correspondences/Correspondence.hpp"
#include "correspondences/Intrinsics.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "robust/QueryPose.hpp"

namespace hybridgv {
namespace hybrid_pose {

// `initial` must be a pose (checkPose). What is not estimated keeps the value that it has there.
NonlinearResult optimizeNonlinear(const correspondences::Correspondences& correspondences, const robust::QueryPose& initial,
                                  correspondences::Intrinsics estimated = {});

}  // namespace hybrid_pose
}  // namespace hybridgv

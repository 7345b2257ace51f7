// The body of optimize_nonlinear, on plain data.
#pragma once

#include "correspondences/Correspondence.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"

namespace hybridgv {
namespace hybrid_pose {

// `initial` must be a pose (checkPose).
NonlinearResult optimizeNonlinear(const correspondences::Correspondences& correspondences, const FocalPose& initial);

}  // namespace hybrid_pose
}  // namespace hybridgv

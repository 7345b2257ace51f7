// The length of the baseline that a ray of another centre fixes.
#pragma once

#include "solvers/MinimalSolver.hpp"
#include "solvers/one_centre/OneFocalFundamental.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

// The pose with the given motion between the query and a camera at `centre`, for which the ray and its image point meet in front of
// both cameras; false if there is none. `imageScale` is the one by which the image points of the motion were divided.
bool poseThroughRay(const OneFocalMotion& motion, const Eigen::Vector3d& centre, double imageScale, const RayMatch& ray,
                    FocalPose* pose);

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv

// Samples that cannot fix a pose, whatever the solver.
#pragma once

#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

// True if, up to 1e-6 relative to the sample's size, two image points coincide, two rays lie on one line, two points coincide,
// three points are collinear, or a ray passes through a point.
bool isDegenerate(const correspondences::RayMatch* rays, int rayCount, const correspondences::PointMatch* points, int pointCount);

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv

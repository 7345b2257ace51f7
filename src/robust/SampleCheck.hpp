// Cheap tests for samples that no solver can use.
#pragma once

#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace robust {

// True if the first three points are collinear (or coincide), two of the points are seen at the same place, one ray is drawn
// twice, or a ray passes through a point of the sample: then fewer equations are left than unknowns.
bool isDegenerate(const correspondences::RayMatch* rays, int numberRays, const correspondences::PointMatch* points,
                  int numberPoints);

}  // namespace robust
}  // namespace hybridgv

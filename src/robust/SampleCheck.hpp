// Cheap tests for samples that no solver can use.
#pragma once

#include "correspondences/Correspondence.hpp"

namespace hybridgv {
namespace robust {

// True if the first three points are collinear (or coincide), two of the points are seen at the same place, one ray is drawn
// twice, or a ray passes through a point of the sample: then fewer equations are left than unknowns.
//
// Nothing else is degenerate for every solver. Rays of different cameras may be seen at one image point, as they are when one
// feature of the query is matched in several map images, or lie on one line: their equations are independent. A fourth point may
// lie in line with two others: seven independent equations are left.
bool isDegenerate(const correspondences::RayMatch* rays, int numberRays, const correspondences::PointMatch* points,
                  int numberPoints);

}  // namespace robust
}  // namespace hybridgv

// What one rig camera is: the rays with one centre.
//
// Whether rays share a centre decides how a sample is drawn, which solver it gets and whether the position is determined, so it
// is asked of the centres themselves. An adapter's getCamIndex only says in which order the cameras are numbered.
#pragma once

#include <vector>

#include "correspondences/Correspondence.hpp"

namespace hybridgv {
namespace correspondences {

// Numbers the cameras 0, 1, .. by increasing index (RayMatch::camera as read; of several the least); cameras with one index by
// their coordinates. The result does not depend on the order of the rays.
void numberCamerasByCentre(std::vector<RigRay>& rays);
void numberCamerasByCentre(RayMatch* rays, std::size_t count);

// The same for a few rays, of which it only matters who shares a centre: the number is the place of the first ray with it.
void numberCamerasOfSample(RayMatch* rays, int count);

}  // namespace correspondences
}  // namespace hybridgv

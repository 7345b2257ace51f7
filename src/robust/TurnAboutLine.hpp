// How well a scene fixes the query's turn about the line that it is nearest to.
#pragma once

#include "robust/PoseScorer.hpp"
#include "robust/RaySlope.hpp"

namespace hybridgv {
namespace robust {

// Whatever lies on one line looks the same to a query that is turned about it, on a whole circle of poses. What lies beside it by p tells the
// turn to 1 / (p f/z) for an error of 1 px, z its depth. Rays that are not exact seem to meet the query's viewing rays beside the line, and so
// pretend to tell it; the part of |p|^2 that their noise explains does not count.
//
// The standard deviation [rad], infinite if nothing tells it. `pointDeviation` [px]: of the errors of points.
double deviationOfTurn(const PoseScorer& scorer, const QueryPose& pose, double pointDeviation, const RayNoise& rayNoise);

}  // namespace robust
}  // namespace hybridgv

// The minimal solvers, all with the contract of MinimalProblems.hpp.
#pragma once

#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace solvers {

namespace three_points {
int p4pf(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
int p35pf(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
int h13f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace three_points

namespace one_centre {
// H51f [5]: all five rays from one centre. At most 9 solutions.
int h51f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Six rays from one centre, no point; the position is returned at distance 1 from that centre. At most 9 solutions.
int sixptOnefocal(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace one_centre

namespace h32f {
// Any pattern of shared centres.
int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace h32f

namespace h51f {
// Any pattern of shared centres; recognizes it from RayMatch::camera.
int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
}  // namespace h51f

}  // namespace solvers
}  // namespace hybridgv

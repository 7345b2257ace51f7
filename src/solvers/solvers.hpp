// The minimal solvers, all with the contract of MinimalSolver.hpp.
#pragma once

#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace solvers {

int p4pf(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
int p35pf(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
int h13f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Any pattern of shared centres.
int h32f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Any pattern of shared centres; recognises it from RayMatch::camera.
int h51f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// H51f [5]: all five rays from one centre. At most 9 solutions.
int h51fOneCentre(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);
// Six rays from one centre, no point; the position is returned at distance 1 from that centre. At most 9 solutions.
int sixptOnefocal(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);

}  // namespace solvers
}  // namespace hybridgv

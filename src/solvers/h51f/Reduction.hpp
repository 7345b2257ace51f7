// From a sample to the parameters of the equations of System.hpp, and from their solutions back to poses.
#pragma once

#include "solvers/complex_rays/Frame.hpp"
#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

// Copies the rays in the order in which start systems have them: those of the shared centre first, and by the angle between their
// image point and the 3D point's, which brings samples closer to the start system. Not for five rays of one centre.
Sharing arrange(const RayMatch* rays, const PointMatch& point, RayMatch* arranged);

// Whether rays i and j have the same centre: they belong to one camera, or the centres differ by less than kSameCentre times
// their distance from the 3D point.
constexpr double kSameCentre = 1e-9;
bool sameCentre(const RayMatch& a, const RayMatch& b, const Eigen::Vector3d& point);

using complex_rays::Frame;

// The 3D point as origin; a shared centre at (0, 0, kSharedCentre), otherwise mean distance 1 of the rays from the origin; mean
// distance 1/4 of the image points from the principal point. Directions, moments and image points then have the spread that the
// start systems have. False if a scale is 0.
bool normalize(Sharing sharing, const RayMatch* rays, const PointMatch& point, Frame* frame);

// Turns the rig's and the image's axes so that the sample comes close to the real parts of a start system: least squares over
// directions and moments of the rays, and over the image points. A shared centre stays where it is.
void alignWith(const StartSystem& start, const RayMatch* rays, const PointMatch& point, Frame* frame);

Parameters parametersIn(const Frame& frame, Sharing sharing, const RayMatch* rays, const PointMatch& point);

// A solution (x, y, alpha, beta, d) of the equations.
struct Solution {
  std::complex<double> x, y, alpha, beta, d;
};

// The solution that belongs to a pose.
Solution solutionOf(const FocalPose& pose, const Frame& frame, const PointMatch& point);

// The pose of a real solution (y = conj x, alpha = conj beta, d real; deviations are averaged out).
FocalPose poseOf(const Solution& solution, const Frame& frame, const PointMatch& point);

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

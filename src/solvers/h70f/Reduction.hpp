// From a sample to the parameters of the equations of System.hpp, and from their solutions back to poses.
#pragma once

#include "solvers/complex_rays/Frame.hpp"
#include "solvers/h70f/Problem.hpp"
#include "solvers/h70f/StartSystems.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

using complex_rays::Frame;

// Which rays have one centre: they belong to one camera, or the centres differ by less than kSameCentre times the largest distance
// between two of them.
constexpr double kSameCentre = 1e-9;
class Groups {
 public:
  explicit Groups(const RayMatch* rays);

  int count() const { return count_; }
  // The group of a ray; the groups are numbered by decreasing size.
  int of(int ray) const { return group_[ray]; }
  int size(int group) const { return group < count_ ? size_[group] : 0; }

 private:
  int group_[kRays], size_[kRays] = {}, count_ = 0;
};

Sharing sharingOf(const Groups& groups);

// Copies the rays in the order in which the start system has them: what is shared comes last, and within each part the order by
// the angle of the image point that comes closest to the start's. The start system is of the groups' class.
void arrange(const RayMatch* rays, const Groups& groups, const StartSystem& start, RayMatch* arranged);

// The centre of the first group, or the point closest to all rays, as origin; the second group's centre at (0, 0, kSecondCentre),
// otherwise mean distance 1 of the unshared rays from the origin; mean distance 1/4 of the image points from the principal point.
// False if that is impossible: a scale is 0, or all rays are parallel.
bool normalize(Sharing sharing, const RayMatch* arranged, Frame* frame);

Parameters parametersIn(const Frame& frame, Sharing sharing, const RayMatch* arranged);

// The data of the target after alignment with a start system of its class.
Parameters alignWith(const StartSystem& start, const RayMatch* arranged, Frame* frame);

// A solution of the equations.
struct Solution {
  std::complex<double> x, y, tauBar, tau, t3, alpha, beta;
};

// The solution that belongs to a pose.
Solution solutionOf(const FocalPose& pose, const Frame& frame);

// The pose of a real solution (y = conj x, alpha = conj beta, taub = conj tau, t3 real; deviations are averaged out).
FocalPose poseOf(const Solution& solution, const Frame& frame);

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv

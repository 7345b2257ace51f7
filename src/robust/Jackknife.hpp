// What the data say about the accuracy of a pose when whole groups of them are left out.
#pragma once

#include <vector>

#include "robust/LeastSquares.hpp"
#include "robust/PerKind.hpp"

namespace hybridgv {
namespace robust {

// The numbers 0, 1, .. of the groups of all rays and of all points.
using JackknifeGroups = PerKind<std::vector<int>>;

// The covariance of a pose near the minimum of the problem, from the derivatives g and H there.
//
// The inverse C of the information H is right if all errors are independent. Errors of the rig are not: all rays of one camera share
// that camera's error. So the minimum is also estimated without each group k of correspondences in turn, by one Gauss-Newton step:
//
//     delta_k = (H - H_k)^-1 (g_k - H_k C g),   H_k = sum of w J J^T,   g_k = sum of w e J  over the group,
//
// is how far it then is from the one with all, to which the pose itself has the step -C g. (The pose is the minimum of another loss, so
// that g is not 0. A group that has most of the information would make much of the difference.) This gives the jackknife covariance
// V = (G-1)/G sum delta_k delta_k^T over the G groups. The result is C, enlarged in the directions in which V is larger than its own
// scatter explains. False if the information has no inverse.
bool jackknifeCovariance(const LeastSquaresProblem& problem, const QueryPose& pose, const JackknifeGroups& groups,
                         const Derivatives& all, ParameterMatrix& covariance);

}  // namespace robust
}  // namespace hybridgv

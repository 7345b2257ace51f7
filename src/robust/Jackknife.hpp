// What the data say about the accuracy of a pose when whole groups of them are left out.
#pragma once

#include <optional>
#include <vector>

#include "robust/FeatureNoise.hpp"
#include "robust/LeastSquares.hpp"
#include "robust/PerKind.hpp"
#include "robust/QueryFeatures.hpp"

namespace hybridgv {
namespace robust {

// Groups of correspondences that may share errors: the rays of a rig camera (with more than 1024, of several). The points of one feature of
// the query are a group, or, as they are in random order, those of as many features together as leave 64 groups: more groups cost more and
// say little more.
JackknifeGroups jackknifeGroups(const CorrespondenceArrays& arrays, const QueryFeatures& features);

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
//
// What correspondences of one feature of the query share is known (FeatureNoise.hpp): the gradient at the true pose has the covariance
// H + X, not H. Then C + C X C takes the place of C, and V lacks the part of C X C that is between groups.
bool jackknifeCovariance(const LeastSquaresProblem& problem, const QueryPose& pose, const JackknifeGroups& groups,
                         const Derivatives& all, const std::optional<SharedInformation>& shared, ParameterMatrix& covariance);

}  // namespace robust
}  // namespace hybridgv

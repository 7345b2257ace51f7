// What the errors of correspondences of one feature of the query have in common.
#pragma once

#include <optional>
#include <vector>

#include "robust/LeastSquares.hpp"
#include "robust/PerKind.hpp"
#include "robust/QueryFeatures.hpp"

namespace hybridgv {
namespace robust {

// The numbers 0, 1, .. of the groups of all rays and of all points.
using JackknifeGroups = PerKind<std::vector<int>>;

// What dependence adds to the covariance of the gradient, sum of w e J, of a problem whose weights w are the inverse variances of its
// errors: that is H for independent errors, the information.
struct SharedInformation {
  ParameterMatrix all;
  ParameterMatrix betweenGroups;  // of it, the part of pairs of correspondences that are in different groups
};

// A feature's image point has one error x, with a variance s^2 for each of its coordinates, that all of its correspondences share. Rays
// and points have errors of their own beside it, from the map image and from the point; what is listed several times has only one of
// these. With the derivatives a of the error e by the image point, so that |a|^2 is the query's share of a Sampson error,
//
//     cov(e_i, e_j) = s^2 a_i . a_j + (1/w - s^2 |a|^2 if i and j have the same ray or point)
//
// for i and j of one feature. s^2 follows from the products e_i e_j themselves: how much of the noise is the query's, and how much of it comes
// from map images, from points or from errors of the rig, differs from map to map. The problem's losses are those of inliers, truncated
// squares. None if no two correspondences come from the same feature.
std::optional<SharedInformation> sharedInformation(const LeastSquaresProblem& problem, const QueryPose& pose,
                                                   const QueryFeatures& features, const JackknifeGroups& groups);

}  // namespace robust
}  // namespace hybridgv

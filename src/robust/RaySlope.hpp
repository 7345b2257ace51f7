// What rays really say about a pose where their depths are hardly known.
#pragma once

#include <optional>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/LeastSquares.hpp"

namespace hybridgv {
namespace robust {

// The derivatives J of a ray's error depend on where the ray seems to meet its viewing ray, and the noise moves that: with an error of
// its place along the epipolar line, with variance s^2, they are J + J' x instead of J, J' their derivative along the line. Baselines
// that are short for the depth and the noise thus make a flat scene look deep, and then the information, the sum of w J J^T, is large where
// there is none. What really counts is
//
//     slope    A = sum of w J J^T               how the gradient, the sum of w e J, changes with the pose,
//     scatter  B = A + sum of w s^2 J' J'^T     its covariance at the true pose,
//
// for the true J. The minimum of the squares then has the covariance A^-1 B A^-1. Of the true J, what can be known is that for the depth
// d + k (z - d) instead of the apparent depth z (inverse depths), d being the scene's mean and k the trust in z (DepthDistribution). The sum
// over the true J is, on average, that over these and over k s^2 J' J'^T.
struct RaySlope {
  ParameterMatrix slope, scatter;
};

// What is known of the rays of a problem.
struct RayNoise {
  double deviation;  // [px] of the errors of inliers
  double byChance;   // so many wrong ones are inliers by chance
};

// Of the inliers: `inliers` is a problem with truncated losses. None if it makes no difference: if there are no rays, or if their depths are
// known much better than they differ. `arrays`: those of the problem.
std::optional<RaySlope> raySlope(const LeastSquaresProblem& inliers, const CorrespondenceArrays& arrays, const QueryPose& pose,
                                 const RayNoise& noise);

// With correspondences of which the information is `others`, A^-1 B A^-1; false if A has no inverse. The squared errors of the rays count
// `weight` times as much as in the problem.
bool covarianceBySlope(const ParameterMatrix& others, const RaySlope& rays, double weight, ParameterMatrix& covariance);

// The weight, at most 1, for which the deviation of the focal length is least, or of the position if the focal length is known; 1 if another
// one is no clear gain.
double bestWeight(const ParameterMatrix& others, const RaySlope& rays, Intrinsics estimated);

}  // namespace robust
}  // namespace hybridgv

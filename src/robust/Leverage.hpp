// How far a single ray decides about its own error.
#pragma once

#include <vector>

#include "robust/LeastSquares.hpp"

namespace hybridgv {
namespace robust {

// The leverage h = W J C J^T of every ray, C the inverse of the information: from 0 to 1. At the minimum without the ray, its error
// is 1 / (1 - h) times as large (to first order). All 0 if the information has no inverse or rays do not take part.
std::vector<double> rayLeverages(const LeastSquaresProblem& problem, const QueryPose& pose);
// The same where the information is known.
std::vector<double> rayLeverages(const LeastSquaresProblem& problem, const QueryPose& pose, const ParameterMatrix& information);

// J C J^T of every ray times the precision of its loss, for the covariance C of a pose that was found without it: the variance of its
// error by the pose, in units of the noise's if the precision is the inverse of that.
std::vector<double> predictedVariances(const LeastSquaresProblem& problem, const QueryPose& pose,
                                       const ParameterMatrix& covariance);

// RayArrays::narrowing for rays of these leverages, with which the loss of a ray is a function of its studentized error
// e / sqrt(1 - h): an inlier's error has the variance 1 - h times that of the noise.
//
// A ray whose viewing rays meet close to the cameras moves fast with the pose: it has a long lever. A wrong one of that kind soon
// agrees by chance with a pose near the right one, and then holds it there, with an error that looks small.
std::vector<double> narrowingByLeverage(std::vector<double> leverages);

}  // namespace robust
}  // namespace hybridgv

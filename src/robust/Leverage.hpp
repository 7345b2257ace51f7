// How far a single ray decides about its own error.
#pragma once

#include <vector>

#include "correspondences/PaddedValues.hpp"
#include "robust/LeastSquares.hpp"

namespace hybridgv {
namespace robust {

// The leverage h = W J C J^T of every ray, C the inverse of the information: from 0 to 1. At the minimum without the ray, its error
// is 1 / (1 - h) times as large (to first order). All 0 if the information has no inverse or rays do not take part.
std::vector<double> rayLeverages(const LeastSquaresProblem& problem, const QueryPose& pose);

// RayArrays::narrowing with which the loss of a ray is a function of its studentized error e / sqrt(1 - h): an inlier's error has
// the variance 1 - h times that of the noise.
//
// A ray whose viewing rays meet close to the cameras moves fast with the pose: it has a long lever. A wrong one of that kind soon
// agrees by chance with a pose near the right one, and then holds it there, with an error that looks small.
correspondences::PaddedValues narrowingByLeverage(const LeastSquaresProblem& problem, const QueryPose& pose);

}  // namespace robust
}  // namespace hybridgv

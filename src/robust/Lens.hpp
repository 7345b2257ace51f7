// What is assumed of the query's radial distortion before the search (QueryPose::distortion).
#pragma once

#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "hybridgv/sac/HybridRansacOptions.hpp"
#include "robust/LeastSquares.hpp"

namespace hybridgv {
namespace robust {

struct Lens {
  bool isUnknown = false;               // else a pinhole camera: what follows is not used
  DistortionPrior prior = {};           // its scale is also what the evidence for distortion is measured against
  double least = 0, largest = 0;        // bounds of the distortion in every step [1/px^2]
  std::vector<double> hypotheses = {};  // a sample is undistorted by one of these [1/px^2]
};

// The options have distortions in units of 1 / radius^2, where the radius is that of the image or of its points, whichever is larger.
// Without such a radius the query is a pinhole camera.
Lens makeLens(const CorrespondenceArrays& arrays, const sac::HybridRansacOptions& options);

// Bounds of the distortion in units of 1 / radius^2: no image point within the radius loses its viewing direction.
constexpr double kLeastDistortion = -0.7, kLargestDistortion = 0.3;

// Natural log of the odds that there is distortion, for an estimate with this standard deviation: the ratio of the prior's and the
// posterior's density at 0, the latter taken as normal (Savage and Dickey). The estimate includes the prior. A deviation above the prior's
// scale means that the data say nothing, and counts as that scale.
double logEvidence(double distortion, double deviation, const DistortionPrior& prior);

}  // namespace robust
}  // namespace hybridgv

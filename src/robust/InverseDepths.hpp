// How the depths of a scene are distributed.
#pragma once

#include <vector>

namespace hybridgv {
namespace robust {

// Inverse depths in the query with what is known of their errors.
struct InverseDepths {
  std::vector<double> values, variances;
};

// The inverse depths of a scene are normal but for a few.
struct DepthDistribution {
  double mean = 0, variance = 0;

  // How much of the difference between a measured value and the mean is the scene's, on average: from 0 to 1.
  double trust(double varianceOfError) const { return variance / (variance + varianceOfError); }
};

// The most likely one. Values beyond three standard deviations do not count. Not for no values.
DepthDistribution depthDistribution(const InverseDepths& depths);

}  // namespace robust
}  // namespace hybridgv

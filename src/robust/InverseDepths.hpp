// How the depths of a scene are distributed.
#pragma once

#include <vector>

namespace hybridgv {
namespace robust {

// Inverse depths in the query with what is known of their errors.
struct InverseDepths {
  std::vector<double> values, variances;
};

// The inverse depths of a scene are normal but for a few, those beyond three standard deviations.
struct DepthDistribution {
  bool isOneOfFew(double value, double varianceOfError) const;
  // How much of the difference between a measured value and the mean is the scene's, on average: from 0 to 1. Where the value is one of
  // the few, its difference is what there is to tell how large theirs are.
  double trust(double value, double varianceOfError) const;

  double mean = 0, variance = 0;
};

// By medians; the errors are in it. Not for no values.
DepthDistribution roughDepthDistribution(const InverseDepths& depths);
// The most likely one. Not for no values.
DepthDistribution depthDistribution(const InverseDepths& depths);

}  // namespace robust
}  // namespace hybridgv

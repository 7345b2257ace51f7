// hybridRansac as a row of an ErrorTable.
#pragma once

#include <hybridgv/sac/HybridRansac.hpp>

// The pose, if it is a success, and the number of samples.
inline hybridgv::FocalPoses estimate(const hybridgv::NoncentralHybridAdapter& adapter,
                                     const hybridgv::sac::HybridRansacOptions& options, int* iterations) {
  const hybridgv::sac::HybridRansacResult result = hybridRansac(adapter, options);
  *iterations = result.iterations;
  return result.success ? hybridgv::FocalPoses{result.pose} : hybridgv::FocalPoses{};
}

#include "hybridgv/hybrid_pose/methods.hpp"

#include <algorithm>

#include "solvers/solveSample.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace hybrid_pose {

using solvers::firstIndices;
using solvers::solveSample;

FocalPoses h13f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solveSample(&solvers::h13f, 1, 3, 12, adapter, indices);
}
FocalPoses h13f(const HybridAdapterBase& adapter) { return h13f(adapter, firstIndices(1, 3)); }

FocalPoses h32f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solveSample(&solvers::h32f, 3, 2, 26, adapter, indices);
}
FocalPoses h32f(const HybridAdapterBase& adapter) { return h32f(adapter, firstIndices(3, 2)); }

FocalPoses h51f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  const solvers::Sample sample = solvers::readSample(5, 1, adapter, indices);
  const bool oneCamera = std::all_of(sample.rays.begin() + 1, sample.rays.begin() + 5,
                                     [&](const solvers::RayMatch& ray) { return ray.camera == sample.rays[0].camera; });
  return sample.solve(&solvers::h51f, oneCamera ? 9 : 56);  // less room for the fastest case
}
FocalPoses h51f(const HybridAdapterBase& adapter) { return h51f(adapter, firstIndices(5, 1)); }

}  // namespace hybrid_pose
}  // namespace hybridgv

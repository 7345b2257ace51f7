#include "hybridgv/hybrid_pose/methods.hpp"

#include <algorithm>

#include "hybrid_pose/solveSample.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace hybrid_pose {

FocalPoses h13f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solveSample(&solvers::three_points::h13f, 1, 3, 12, adapter, indices);
}
FocalPoses h13f(const HybridAdapterBase& adapter) { return h13f(adapter, firstIndices(1, 3)); }

FocalPoses h32f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solveSample(&solvers::h32f::solve, 3, 2, 26, adapter, indices);
}
FocalPoses h32f(const HybridAdapterBase& adapter) { return h32f(adapter, firstIndices(3, 2)); }

FocalPoses h51f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  const Sample sample = readSample(5, 1, adapter, indices);
  const bool oneCamera = std::all_of(sample.rays.begin() + 1, sample.rays.begin() + 5,
                                     [&](const solvers::RayMatch& ray) { return ray.camera == sample.rays[0].camera; });
  return sample.solve(&solvers::h51f::solve, oneCamera ? 9 : 56);  // less room for the fastest case
}
FocalPoses h51f(const HybridAdapterBase& adapter) { return h51f(adapter, firstIndices(5, 1)); }

}  // namespace hybrid_pose
}  // namespace hybridgv

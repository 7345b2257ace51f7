#include "hybridgv/hybrid_pose/methods.hpp"

#include "CheckArguments.hpp"
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

// Rays of different rig cameras: a wrong call as long as only configuration [5] is solved.
static void checkOneCentre(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  checkMultiIndices("indices", indices, 5, 1, adapter);
  const auto first = static_cast<std::size_t>(indices[0][0]);
  for (std::size_t i = 1; i < 5; ++i) {
    const auto other = static_cast<std::size_t>(indices[0][i]);
    if (adapter.getCamIndex(other) != adapter.getCamIndex(first) && adapter.getCamOffset(other) != adapter.getCamOffset(first))
      throwInvalid("indices[0] (2D-2D)", "correspondences " + std::to_string(first) + " and " + std::to_string(other) +
                                             " belong to different rig cameras: not available in this version");
  }
}

FocalPoses h51f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  checkOneCentre(adapter, indices);
  return solveSample(&solvers::h51f, 5, 1, 56, adapter, indices);
}
FocalPoses h51f(const HybridAdapterBase& adapter) { return h51f(adapter, firstIndices(5, 1)); }

}  // namespace hybrid_pose
}  // namespace hybridgv

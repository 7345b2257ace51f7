#include "hybridgv/hybrid_pose/methods.hpp"

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
  return solveSample(&solvers::h51f, 5, 1, 56, adapter, indices);
}
FocalPoses h51f(const HybridAdapterBase& adapter) { return h51f(adapter, firstIndices(5, 1)); }

}  // namespace hybrid_pose
}  // namespace hybridgv

#include "hybridgv/absolute_pose/methods.hpp"

#include "solvers/solveSample.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace absolute_pose {

using solvers::solveSample;

static const std::vector<int> kFirstFour{0, 1, 2, 3};

FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return solveSample(&solvers::p4pf, 0, 4, 6, adapter, {{}, indices});
}
FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter) { return p4pf(adapter, kFirstFour); }

FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return solveSample(&solvers::p35pf, 0, 4, 10, adapter, {{}, indices});
}
FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter) { return p35pf(adapter, kFirstFour); }

}  // namespace absolute_pose
}  // namespace hybridgv

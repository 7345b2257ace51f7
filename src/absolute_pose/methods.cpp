#include "hybridgv/absolute_pose/methods.hpp"

#include "solvers/solveSample.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace absolute_pose {

using solvers::readPoints;

static const std::vector<int> kFirstFour{0, 1, 2, 3};

FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return readPoints(4, adapter, indices).solve(&solvers::p4pf, 6);
}
FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter) { return p4pf(adapter, kFirstFour); }

FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return readPoints(4, adapter, indices).solve(&solvers::p35pf, 10);
}
FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter) { return p35pf(adapter, kFirstFour); }

}  // namespace absolute_pose
}  // namespace hybridgv

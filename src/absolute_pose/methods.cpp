#include "hybridgv/absolute_pose/methods.hpp"

#include "hybrid_pose/solveSample.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace absolute_pose {

using hybrid_pose::readPoints;

static const std::vector<int> kFirstFour{0, 1, 2, 3};

FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return readPoints(4, adapter, indices).solve(&solvers::three_points::p4pf, 6);
}
FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter) { return p4pf(adapter, kFirstFour); }

FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return readPoints(4, adapter, indices).solve(&solvers::three_points::p35pf, 10);
}
FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter) { return p35pf(adapter, kFirstFour); }

}  // namespace absolute_pose
}  // namespace hybridgv

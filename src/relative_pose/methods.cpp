#include "hybridgv/relative_pose/methods.hpp"

#include "hybrid_pose/solveSample.hpp"

namespace hybridgv {
namespace relative_pose {

using hybrid_pose::HybridAdapterBase;
using hybrid_pose::solve;

constexpr solvers::SolverRows kSixptOnefocal = solvers::rowsOf("sixpt_onefocal");

FocalPoses sixpt_onefocal(const HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return solve(kSixptOnefocal, adapter, indices);
}
FocalPoses sixpt_onefocal(const HybridAdapterBase& adapter) { return solve(kSixptOnefocal, adapter); }

}  // namespace relative_pose
}  // namespace hybridgv

#include "hybridgv/relative_pose/methods.hpp"

#include "hybrid_pose/solveSample.hpp"

namespace hybridgv {
namespace relative_pose {

using hybrid_pose::HybridAdapterBase;
using hybrid_pose::solve;

constexpr solvers::SolverRows kSixptOnefocal = solvers::rowsOf("sixpt_onefocal"), kFivept = solvers::rowsOf("fivept");

FocalPoses sixpt_onefocal(const HybridAdapterBase& adapter, const std::vector<int>& indices) {
  return solve(kSixptOnefocal, adapter, indices);
}
FocalPoses sixpt_onefocal(const HybridAdapterBase& adapter) { return solve(kSixptOnefocal, adapter); }

FocalPoses fivept(const HybridAdapterBase& adapter, double focalLength, const std::vector<int>& indices) {
  return solve(kFivept, adapter, indices, focalLength);
}
FocalPoses fivept(const HybridAdapterBase& adapter, double focalLength) { return solve(kFivept, adapter, focalLength); }

}  // namespace relative_pose
}  // namespace hybridgv

#include "hybridgv/absolute_pose/methods.hpp"

#include "hybrid_pose/solveSample.hpp"

namespace hybridgv {
namespace absolute_pose {

using hybrid_pose::HybridAdapterBase;
using hybrid_pose::solve;
using solvers::rowsOf;

// The rows are constants, and nothing here has an initializer: the functions may be called before main.
constexpr solvers::SolverRows kP4pf = rowsOf("p4pf"), kP35pf = rowsOf("p35pf"), kP3p = rowsOf("p3p");

FocalPoses p4pf(const HybridAdapterBase& adapter, const std::vector<int>& indices) { return solve(kP4pf, adapter, indices); }
FocalPoses p4pf(const HybridAdapterBase& adapter) { return solve(kP4pf, adapter); }

FocalPoses p35pf(const HybridAdapterBase& adapter, const std::vector<int>& indices) { return solve(kP35pf, adapter, indices); }
FocalPoses p35pf(const HybridAdapterBase& adapter) { return solve(kP35pf, adapter); }

FocalPoses p3p(const HybridAdapterBase& adapter, double focalLength, const std::vector<int>& indices) {
  return solve(kP3p, adapter, indices, focalLength);
}
FocalPoses p3p(const HybridAdapterBase& adapter, double focalLength) { return solve(kP3p, adapter, focalLength); }

}  // namespace absolute_pose
}  // namespace hybridgv

#include "hybridgv/hybrid_pose/methods.hpp"

#include "hybrid_pose/solveSample.hpp"

namespace hybridgv {
namespace hybrid_pose {

using solvers::rowsOf;

constexpr solvers::SolverRows kH13f = rowsOf("h13f"), kH32f = rowsOf("h32f"), kH51f = rowsOf("h51f"), kH70f = rowsOf("h70f");
constexpr solvers::SolverRows kH22 = rowsOf("h22"), kH41 = rowsOf("h41"), kH60 = rowsOf("h60");

FocalPoses h13f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solve(kH13f, adapter, indices);
}
FocalPoses h13f(const HybridAdapterBase& adapter) { return solve(kH13f, adapter); }

FocalPoses h32f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solve(kH32f, adapter, indices);
}
FocalPoses h32f(const HybridAdapterBase& adapter) { return solve(kH32f, adapter); }

FocalPoses h51f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solve(kH51f, adapter, indices);
}
FocalPoses h51f(const HybridAdapterBase& adapter) { return solve(kH51f, adapter); }

FocalPoses h70f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return solve(kH70f, adapter, indices);
}
FocalPoses h70f(const HybridAdapterBase& adapter) { return solve(kH70f, adapter); }

FocalPoses h22(const HybridAdapterBase& adapter, double focalLength, const std::vector<std::vector<int>>& indices) {
  return solve(kH22, adapter, indices, focalLength);
}
FocalPoses h22(const HybridAdapterBase& adapter, double focalLength) { return solve(kH22, adapter, focalLength); }

FocalPoses h41(const HybridAdapterBase& adapter, double focalLength, const std::vector<std::vector<int>>& indices) {
  return solve(kH41, adapter, indices, focalLength);
}
FocalPoses h41(const HybridAdapterBase& adapter, double focalLength) { return solve(kH41, adapter, focalLength); }

FocalPoses h60(const HybridAdapterBase& adapter, double focalLength, const std::vector<std::vector<int>>& indices) {
  return solve(kH60, adapter, indices, focalLength);
}
FocalPoses h60(const HybridAdapterBase& adapter, double focalLength) { return solve(kH60, adapter, focalLength); }

}  // namespace hybrid_pose
}  // namespace hybridgv

#include "solvers/solveSample.hpp"

#include <array>
#include <numeric>

#include "CheckArguments.hpp"

namespace hybridgv {
namespace solvers {

constexpr int kMaxSampleSize = 6;

FocalPoses solveSample(SolveFunction solve, int rays, int points, int maxSolutions, const hybrid_pose::HybridAdapterBase& adapter,
                       const std::vector<std::vector<int>>& indices) {
  checkMultiIndices("indices", indices, rays, points, adapter);
  std::array<RayMatch, kMaxSampleSize> rayMatches;
  std::array<PointMatch, kMaxSampleSize> pointMatches;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rays); ++i) rayMatches[i] = readRay(adapter, indices[0][i]);
  for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i) pointMatches[i] = readPoint(adapter, indices[1][i]);
  FocalPoses solutions(static_cast<std::size_t>(maxSolutions));
  solutions.resize(static_cast<std::size_t>(solve(rayMatches.data(), pointMatches.data(), solutions.data())));
  return solutions;
}

std::vector<std::vector<int>> firstIndices(int rays, int points) {
  std::vector<std::vector<int>> indices{std::vector<int>(static_cast<std::size_t>(rays)),
                                        std::vector<int>(static_cast<std::size_t>(points))};
  for (std::vector<int>& list : indices) std::iota(list.begin(), list.end(), 0);
  return indices;
}

}  // namespace solvers
}  // namespace hybridgv

// Runs a minimal solver on correspondences of an adapter; the body of every public solver function.
#pragma once

#include <array>
#include <vector>

#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace hybrid_pose {

// Correspondences as the minimal solvers take them.
struct Sample {
  static constexpr int kMaxSize = 6;
  std::array<solvers::RayMatch, kMaxSize> rays;
  std::array<solvers::PointMatch, kMaxSize> points;

  FocalPoses solve(solvers::SolveFunction solver, int maxSolutions) const;
};

// The first `rays` correspondences of indices[0] and the first `points` of indices[1], checked.
Sample readSample(int rays, int points, const hybrid_pose::HybridAdapterBase& adapter,
                  const std::vector<std::vector<int>>& indices);
// The same for rays or points alone.
Sample readRays(int rays, const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
Sample readPoints(int points, const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);

inline FocalPoses solveSample(solvers::SolveFunction solver, int rays, int points, int maxSolutions,
                              const hybrid_pose::HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices) {
  return readSample(rays, points, adapter, indices).solve(solver, maxSolutions);
}

// Is a focal length or a position beyond the largest double?
bool overflows(const FocalPose& pose);

// {0, 1, .., rays-1}, {0, 1, .., points-1}
std::vector<std::vector<int>> firstIndices(int rays, int points);

}  // namespace hybrid_pose
}  // namespace hybridgv

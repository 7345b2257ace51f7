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
  std::array<solvers::RayMatch, solvers::kMaxSampleSize> rays;
  std::array<solvers::PointMatch, solvers::kMaxSampleSize> points;
};

// The solutions of the sample by this row of the table, without those that overflow. The focal length is used by the solvers that
// do not estimate it.
FocalPoses solve(const solvers::MinimalSolver& solver, const Sample& sample, double focalLength = 1);

// Solves the sample of the first correspondences of indices[0] (2D-2D) and indices[1] (2D-3D), checked, as is the
// focal length.
FocalPoses solve(const solvers::SolverRows& problem, const HybridAdapterBase& adapter,
                 const std::vector<std::vector<int>>& indices, double focalLength = 1);
// The same for a problem of one kind of correspondence.
FocalPoses solve(const solvers::SolverRows& problem, const HybridAdapterBase& adapter, const std::vector<int>& indices,
                 double focalLength = 1);
// The sample of the adapter's first correspondences.
FocalPoses solve(const solvers::SolverRows& problem, const HybridAdapterBase& adapter, double focalLength = 1);

// Is a focal length or a position beyond the largest double?
bool overflows(const FocalPose& pose);

}  // namespace hybrid_pose
}  // namespace hybridgv

#include "hybrid_pose/solveSample.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "CheckArguments.hpp"
#include "correspondences/readCorrespondence.hpp"

namespace hybridgv {
namespace hybrid_pose {

using solvers::MinimalSolver;
using solvers::SolverRows;

bool overflows(const FocalPose& pose) {
  return !std::isfinite(pose.focalLength) || !pose.position.allFinite() || !pose.rotation.allFinite();
}

FocalPoses solve(const MinimalSolver& solver, const Sample& sample, double focalLength) {
  FocalPoses solutions(static_cast<std::size_t>(solver.maxSolutions));
  const int count = solvers::solve(solver, sample.rays.data(), sample.points.data(), focalLength, solutions.data());
  solutions.resize(static_cast<std::size_t>(count));
  solutions.erase(std::remove_if(solutions.begin(), solutions.end(), overflows), solutions.end());
  return solutions;
}

[[noreturn]] static void refuseSeveralCameras(const SolverRows& problem, const Sample& sample, const int* rayIndices) {
  if (problem.begin()->draw == solvers::RayDraw::AllButOne)
    throwInvalid("indices", std::string(problem.name()) + " needs " + std::to_string(problem.rays() - 1) +
                                " rays of one rig camera and one of another; these are shared in another way");
  const auto differs = [&](const solvers::RayMatch& ray) { return ray.camera != sample.rays[0].camera; };
  const auto other = std::find_if(sample.rays.begin(), sample.rays.begin() + problem.rays(), differs) - sample.rays.begin();
  throwInvalid("indices", "correspondences " + std::to_string(rayIndices[0]) + " and " + std::to_string(rayIndices[other]) +
                              " belong to different rig cameras; " + problem.name() + " needs " + std::to_string(problem.rays()) +
                              " rays of one camera");
}

static FocalPoses solve(const SolverRows& problem, const Sample& sample, const int* rayIndices, double focalLength) {
  const MinimalSolver* const solver = problem.forSample(sample.rays.data());
  if (!solver) refuseSeveralCameras(problem, sample, rayIndices);
  return solve(*solver, sample, focalLength);
}

FocalPoses solve(const SolverRows& problem, const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                 double focalLength) {
  checkPositive("focalLength", focalLength);
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  checkMultiIndices("indices", indices, {problem.rays(), problem.points()}, {counts.rays, counts.points});
  Sample sample;
  correspondences::readSampleRays(adapter, indices[0].data(), problem.rays(), sample.rays.data());
  correspondences::readSamplePoints(adapter, indices[1].data(), problem.points(), sample.points.data());
  return solve(problem, sample, indices[0].data(), focalLength);
}

FocalPoses solve(const SolverRows& problem, const HybridAdapterBase& adapter, const std::vector<int>& indices,
                 double focalLength) {
  checkPositive("focalLength", focalLength);
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  Sample sample;
  if (problem.rays() > 0) {
    checkIndices("indices", "", indices, problem.rays(), counts.rays);
    correspondences::readSampleRays(adapter, indices.data(), problem.rays(), sample.rays.data());
  } else {
    checkIndices("indices", "", indices, problem.points(), counts.points);
    correspondences::readSamplePoints(adapter, indices.data(), problem.points(), sample.points.data());
  }
  return solve(problem, sample, indices.data(), focalLength);
}

// The indices of the first correspondences.
struct FirstIndices {
  std::array<int, solvers::kMaxSampleSize> values{};
  constexpr FirstIndices() {
    for (int i = 0; i < solvers::kMaxSampleSize; ++i) values[static_cast<std::size_t>(i)] = i;
  }
  std::vector<int> list(int count) const { return {values.begin(), values.begin() + count}; }
};
static constexpr FirstIndices kFirst;

FocalPoses solve(const SolverRows& problem, const HybridAdapterBase& adapter, double focalLength) {
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  const bool areEnough =
      counts.rays >= static_cast<std::size_t>(problem.rays()) && counts.points >= static_cast<std::size_t>(problem.points());
  if (areEnough) {
    checkPositive("focalLength", focalLength);
    Sample sample;
    correspondences::readSampleRays(adapter, kFirst.values.data(), problem.rays(), sample.rays.data());
    correspondences::readSamplePoints(adapter, kFirst.values.data(), problem.points(), sample.points.data());
    return solve(problem, sample, kFirst.values.data(), focalLength);
  }
  // Told as of indices that are given.
  if (problem.rays() == 0) return solve(problem, adapter, kFirst.list(problem.points()), focalLength);
  if (problem.points() == 0) return solve(problem, adapter, kFirst.list(problem.rays()), focalLength);
  return solve(problem, adapter, std::vector<std::vector<int>>{kFirst.list(problem.rays()), kFirst.list(problem.points())},
               focalLength);
}

}  // namespace hybrid_pose
}  // namespace hybridgv

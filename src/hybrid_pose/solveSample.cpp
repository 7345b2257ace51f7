#include "hybrid_pose/solveSample.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "CheckArguments.hpp"
#include "correspondences/readCorrespondence.hpp"

namespace hybridgv {
namespace hybrid_pose {

bool overflows(const FocalPose& pose) {
  return !std::isfinite(pose.focalLength) || !pose.position.allFinite() || !pose.rotation.allFinite();
}

FocalPoses Sample::solve(solvers::SolveFunction solver, int maxSolutions) const {
  FocalPoses solutions(static_cast<std::size_t>(maxSolutions));
  solutions.resize(static_cast<std::size_t>(solver(rays.data(), points.data(), solutions.data())));
  solutions.erase(std::remove_if(solutions.begin(), solutions.end(), overflows), solutions.end());
  return solutions;
}

static void fillRays(int count, const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices, Sample& sample) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    sample.rays[i] = correspondences::readRay(adapter, indices[i]);
}

static void fillPoints(int count, const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices,
                       Sample& sample) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    sample.points[i] = correspondences::readPoint(adapter, indices[i]);
}

Sample readSample(int rays, int points, const hybrid_pose::HybridAdapterBase& adapter,
                  const std::vector<std::vector<int>>& indices) {
  checkMultiIndices("indices", indices, {rays, points},
                    {adapter.getNumberCorrespondences2d2d(), adapter.getNumberCorrespondences2d3d()});
  Sample sample;
  fillRays(rays, adapter, indices[0], sample);
  fillPoints(points, adapter, indices[1], sample);
  return sample;
}

Sample readRays(int rays, const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  checkIndices("indices", "", indices, rays, adapter.getNumberCorrespondences2d2d());
  Sample sample;
  fillRays(rays, adapter, indices, sample);
  return sample;
}

Sample readPoints(int points, const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  checkIndices("indices", "", indices, points, adapter.getNumberCorrespondences2d3d());
  Sample sample;
  fillPoints(points, adapter, indices, sample);
  return sample;
}

std::vector<std::vector<int>> firstIndices(int rays, int points) {
  std::vector<std::vector<int>> indices{std::vector<int>(static_cast<std::size_t>(rays)),
                                        std::vector<int>(static_cast<std::size_t>(points))};
  for (std::vector<int>& list : indices) std::iota(list.begin(), list.end(), 0);
  return indices;
}

}  // namespace hybrid_pose
}  // namespace hybridgv

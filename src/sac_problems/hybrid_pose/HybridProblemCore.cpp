#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "CheckArguments.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"
#include "sac_problems/hybrid_pose/CopiedCorrespondences.hpp"
#include "sac_problems/hybrid_pose/drawSample.hpp"
#include "sac_problems/hybrid_pose/isDegenerate.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

namespace {

constexpr std::size_t kMaxSampleSize = 6;

struct Sample {
  std::array<solvers::RayMatch, kMaxSampleSize> rays;
  std::array<solvers::PointMatch, kMaxSampleSize> points;
};

void checkThreshold(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value)) throwInvalid(name, "must be positive and finite, is " + std::to_string(value));
}

void checkCount(const char* what, int available, int needed, const char* solver) {
  if (available < needed)
    throwInvalid("adapter", "has " + std::to_string(available) + " " + what + " correspondences, " + solver + " needs " +
                                std::to_string(needed));
}

void checkRange(const char* name, int index, int count) {
  if (index < 0 || index >= count)
    throwInvalid(name, "index " + std::to_string(index) + " is outside the " + std::to_string(count) + " correspondences");
}

}  // namespace

struct HybridProblemCore::Data {
  Data(const hybridgv::hybrid_pose::HybridAdapterBase& adapter, Solver id, double reprojectionPx, double epipolarPx)
      : solver(solvers::minimalSolver(id)),
        correspondences(adapter),
        maxReprojectionErrorPx(reprojectionPx),
        maxEpipolarErrorPx(epipolarPx) {
    checkThreshold("maxReprojectionErrorPx", reprojectionPx);
    checkThreshold("maxEpipolarErrorPx", epipolarPx);
    checkCount("2D-2D", count2d2d(), solver.rays, solver.name);
    checkCount("2D-3D", count2d3d(), solver.points, solver.name);
  }

  int count2d2d() const { return static_cast<int>(correspondences.getNumberCorrespondences2d2d()); }
  int count2d3d() const { return static_cast<int>(correspondences.getNumberCorrespondences2d3d()); }

  double distance2d2d(const FocalPose& pose, int index) const {
    const auto i = static_cast<std::size_t>(index);
    return bounded(hybridgv::hybrid_pose::sampsonError(pose, correspondences.getImagePoint2d2d(i),
                                                       correspondences.getBearingVector(i), correspondences.getCamOffset(i),
                                                       correspondences.getCamRotation(i), correspondences.getRigFocalLength(i)) /
                   maxEpipolarErrorPx);
  }
  double distance2d3d(const FocalPose& pose, int index) const {
    const auto i = static_cast<std::size_t>(index);
    return bounded(
        hybridgv::hybrid_pose::reprojectionError(pose, correspondences.getImagePoint2d3d(i), correspondences.getPoint(i)) /
        maxReprojectionErrorPx);
  }
  static double bounded(double distance) { return distance < kMaxDistance ? distance : kMaxDistance; }  // also for NaN

  // sum of min(distance^2, 1) over the pool; something above `limit` if it exceeds that.
  double cost(const FocalPose& pose, const MultiIndices& pool, double limit) const {
    double sum = 0;
    const auto add = [&](double distance) { return (sum += std::min(distance * distance, 1.0)) <= limit; };
    for (int i : pool[0])
      if (!add(distance2d2d(pose, i))) return sum;
    for (int i : pool[1])
      if (!add(distance2d3d(pose, i))) return sum;
    return sum;
  }

  void checkPool(const char* name, const MultiIndices& indices) const {
    if (indices.size() != 2) throwInvalid(name, "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(indices.size()));
    for (int i : indices[0]) checkRange(name, i, count2d2d());
    for (int i : indices[1]) checkRange(name, i, count2d3d());
  }

  Sample read(const MultiIndices& sample) const {
    checkPool("sample", sample);
    const auto rays = static_cast<std::size_t>(solver.rays), points = static_cast<std::size_t>(solver.points);
    if (sample[0].size() != rays || sample[1].size() != points)
      throwInvalid("sample", std::string(solver.name) + " needs " + std::to_string(rays) + " 2D-2D and " +
                                 std::to_string(points) + " 2D-3D correspondences, got " + std::to_string(sample[0].size()) +
                                 " and " + std::to_string(sample[1].size()));
    Sample result;
    for (std::size_t i = 0; i < rays; ++i) result.rays[i] = correspondences.ray(static_cast<std::size_t>(sample[0][i]));
    for (std::size_t i = 0; i < points; ++i)
      result.points[i] = correspondences.pointMatch(static_cast<std::size_t>(sample[1][i]));
    return result;
  }

  bool isGood(const Sample& sample) const {
    return !isDegenerate(sample.rays.data(), solver.rays, sample.points.data(), solver.points);
  }

  const solvers::MinimalSolver& solver;
  const CopiedCorrespondences correspondences;
  const double maxReprojectionErrorPx, maxEpipolarErrorPx;
};

HybridProblemCore::HybridProblemCore(const hybridgv::hybrid_pose::HybridAdapterBase& adapter, Solver solver,
                                     double maxReprojectionErrorPx, double maxEpipolarErrorPx)
    : data_(std::make_shared<const Data>(adapter, solver, maxReprojectionErrorPx, maxEpipolarErrorPx)) {}

std::array<int, 2> HybridProblemCore::size() const { return {data_->count2d2d(), data_->count2d3d()}; }
std::array<int, 2> HybridProblemCore::sampleSize() const { return {data_->solver.rays, data_->solver.points}; }

MultiIndices HybridProblemCore::split(const std::vector<int>& flat) const {
  MultiIndices result(2);
  const int rays = data_->count2d2d(), all = rays + data_->count2d3d();
  for (int i : flat) {
    checkRange("indices", i, all);
    if (i < rays)
      result[0].push_back(i);
    else
      result[1].push_back(i - rays);
  }
  return result;
}

std::vector<int> HybridProblemCore::join(const MultiIndices& indices) const {
  std::vector<int> result;
  if (indices.empty()) return result;
  data_->checkPool("indices", indices);
  result = indices[0];
  for (int i : indices[1]) result.push_back(i + data_->count2d2d());
  return result;
}

MultiIndices HybridProblemCore::drawSample(const MultiIndices& pool, bool raysFromOneCamera,
                                           const std::function<int()>& random) const {
  data_->checkPool("indices", pool);
  const int rays = data_->solver.rays, points = data_->solver.points;
  if (pool[0].size() < static_cast<std::size_t>(rays) || pool[1].size() < static_cast<std::size_t>(points)) return {};
  MultiIndices sample(2);
  if (raysFromOneCamera && rays > 1) {
    std::vector<int> cameras;
    for (int i : pool[0]) cameras.push_back(data_->correspondences.getCamIndex(static_cast<std::size_t>(i)));
    sample[0] = drawSubset(drawCamera(pool[0], cameras, rays, random), rays, random);
  } else {
    sample[0] = drawSubset(pool[0], rays, random);
  }
  sample[1] = drawSubset(pool[1], points, random);
  return sample;
}

bool HybridProblemCore::isSampleGood(const MultiIndices& sample) const { return data_->isGood(data_->read(sample)); }

bool HybridProblemCore::computeModel(const MultiIndices& sample, const MultiIndices& pool, FocalPose& model) const {
  const Sample correspondences = data_->read(sample);
  data_->checkPool("indices", pool);
  if (!data_->isGood(correspondences)) return false;
  std::array<FocalPose, solvers::kMaxSolutions> solutions;
  const int count = data_->solver.solve(correspondences.rays.data(), correspondences.points.data(), solutions.data());
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    const FocalPose& solution = solutions[static_cast<std::size_t>(i)];
    const double cost = data_->cost(solution, pool, best);
    if (cost >= best) continue;
    best = cost;
    model = solution;
  }
  return count > 0;
}

void HybridProblemCore::distances(const FocalPose& model, const std::vector<int>& flat, std::vector<double>& result) const {
  const int rays = data_->count2d2d(), all = rays + data_->count2d3d();
  result.clear();
  for (int i : flat) {
    checkRange("indices", i, all);
    result.push_back(i < rays ? data_->distance2d2d(model, i) : data_->distance2d3d(model, i - rays));
  }
}

void HybridProblemCore::distances(const FocalPose& model, const MultiIndices& indices,
                                  std::vector<std::vector<double>>& result) const {
  data_->checkPool("indices", indices);
  result.assign(2, {});
  for (int i : indices[0]) result[0].push_back(data_->distance2d2d(model, i));
  for (int i : indices[1]) result[1].push_back(data_->distance2d3d(model, i));
}

FocalPose HybridProblemCore::optimize(const MultiIndices& inliers, const FocalPose& model) const {
  data_->checkPool("inliers", inliers);
  return hybridgv::hybrid_pose::optimize_nonlinear(data_->correspondences, inliers, model).pose;
}

// splitmix64
std::function<int()> randomSequence(std::uint64_t seed) {
  return [state = seed]() mutable {
    std::uint64_t z = state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<int>((z ^ (z >> 31)) >> 33);
  };
}

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv

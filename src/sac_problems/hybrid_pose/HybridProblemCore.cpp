#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "CheckArguments.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "hybrid_pose/solveSample.hpp"
#include "hybridgv/detail/format.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "robust/kernels/Kernels.hpp"
#include "robust/toPlain.hpp"
#include "sac_problems/hybrid_pose/CopiedCorrespondences.hpp"
#include "sac_problems/hybrid_pose/drawSample.hpp"
#include "sac_problems/hybrid_pose/isDegenerate.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

namespace {

using hybridgv::hybrid_pose::Sample;

void checkCount(const char* what, int available, int needed, const char* solver) {
  if (available < needed)
    throwInvalid("adapter", "has " + std::to_string(available) + " " + what + " correspondences, " + solver + " needs " +
                                std::to_string(needed));
}

void checkRanges(const char* name, const std::vector<int>& indices, int count) {
  for (int i : indices)
    if (i < 0 || i >= count)
      throwInvalid(name, "index " + std::to_string(i) + " is outside the " + std::to_string(count) + " correspondences");
}

}  // namespace

struct HybridProblemCore::Data {
  Data(const hybridgv::hybrid_pose::HybridAdapterBase& adapter, Solver id, double reprojectionPx, double epipolarPx)
      : problem(solvers::rowsOf(id)),
        correspondences(adapter),
        arrays(correspondences, correspondences::allIndices(adapter.getNumberCorrespondences2d2d()),
               correspondences::allIndices(adapter.getNumberCorrespondences2d3d())),
        maxReprojectionErrorPx(reprojectionPx),
        maxEpipolarErrorPx(epipolarPx) {
    arrays.boundUnknownFocalLengths();
    for (std::size_t i = 0; i < arrays.rays().size(); ++i) cameras.push_back(correspondences.getCamIndex(i));
    checkPositive("maxReprojectionErrorPx", reprojectionPx);
    checkPositive("maxEpipolarErrorPx", epipolarPx);
    checkCount("2D-2D", count2d2d(), problem.rays(), problem.name());
    checkCount("2D-3D", count2d3d(), problem.points(), problem.name());
  }

  int count2d2d() const { return static_cast<int>(arrays.rays().size()); }
  int count2d3d() const { return static_cast<int>(arrays.points().size()); }
  int count() const { return count2d2d() + count2d3d(); }

  // (error / threshold)^2 of all correspondences at their flat indices; infinite where the error is.
  void computeSquaredDistances(const FocalPose& pose, std::vector<double>& result) const {
    const correspondences::RayArrays rays = arrays.rayArrays();
    const correspondences::PointArrays points = arrays.pointArrays();
    result.resize(rays.size + points.size + correspondences::kPadding);
    double* const ofPoints = result.data() + rays.size;
    const robust::PlainPose plain = robust::toPlain(arrays.normalization().apply(pose));
    robust::kernels().squaredRayErrors(rays, plain, result.data());  // their padding is overwritten by the points
    robust::kernels().squaredPointErrors(points, plain, ofPoints);
    for (std::size_t i = 0; i < rays.size; ++i) result[i] /= maxEpipolarErrorPx * maxEpipolarErrorPx;
    for (std::size_t i = 0; i < points.size; ++i) ofPoints[i] /= maxReprojectionErrorPx * maxReprojectionErrorPx;
  }

  void checkPool(const char* name, const MultiIndices& indices) const {
    if (indices.size() != 2) throwInvalid(name, "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(indices.size()));
    checkRanges(name, indices[0], count2d2d());
    checkRanges(name, indices[1], count2d3d());
  }

  Sample read(const MultiIndices& sample) const {
    checkPool("sample", sample);
    const auto rays = static_cast<std::size_t>(problem.rays()), points = static_cast<std::size_t>(problem.points());
    if (sample[0].size() != rays || sample[1].size() != points)
      throwInvalid("sample", std::string(problem.name()) + " needs " + std::to_string(rays) + " 2D-2D and " +
                                 std::to_string(points) + " 2D-3D correspondences, got " + std::to_string(sample[0].size()) +
                                 " and " + std::to_string(sample[1].size()));
    Sample result;
    for (std::size_t i = 0; i < rays; ++i) result.rays[i] = correspondences.ray(static_cast<std::size_t>(sample[0][i]));
    for (std::size_t i = 0; i < points; ++i)
      result.points[i] = correspondences.pointMatch(static_cast<std::size_t>(sample[1][i]));
    return result;
  }

  bool isGood(const Sample& sample) const {
    return !isDegenerate(sample.rays.data(), problem.rays(), sample.points.data(), problem.points());
  }

  const solvers::SolverRows problem;
  const CopiedCorrespondences correspondences;
  correspondences::CorrespondenceArrays arrays;
  std::vector<int> cameras;  // of the 2D-2D correspondences
  const double maxReprojectionErrorPx, maxEpipolarErrorPx;
};

HybridProblemCore::HybridProblemCore(const hybridgv::hybrid_pose::HybridAdapterBase& adapter, Solver solver,
                                     double maxReprojectionErrorPx, double maxEpipolarErrorPx)
    : data_(std::make_shared<const Data>(adapter, solver, maxReprojectionErrorPx, maxEpipolarErrorPx)) {}

std::array<int, 2> HybridProblemCore::size() const { return {data_->count2d2d(), data_->count2d3d()}; }
std::array<int, 2> HybridProblemCore::sampleSize() const { return {data_->problem.rays(), data_->problem.points()}; }

bool HybridProblemCore::drawsRaysFromOneCamera() const {
  const auto isOfOneCamera = [](const solvers::MinimalSolver& solver) { return solver.draw == solvers::RayDraw::OneCamera; };
  return std::any_of(data_->problem.begin(), data_->problem.end(), isOfOneCamera);
}

MultiIndices HybridProblemCore::split(const std::vector<int>& flat) const {
  checkRanges("indices", flat, data_->count());
  const int rays = data_->count2d2d();
  MultiIndices result(2);
  for (std::vector<int>& list : result) list.reserve(flat.size());
  for (int i : flat)
    if (i < rays)
      result[0].push_back(i);
    else
      result[1].push_back(i - rays);
  return result;
}

std::vector<int> HybridProblemCore::join(const MultiIndices& indices) const {
  data_->checkPool("indices", indices);
  std::vector<int> result;
  result.reserve(indices[0].size() + indices[1].size());
  result = indices[0];
  for (int i : indices[1]) result.push_back(i + data_->count2d2d());
  return result;
}

MultiIndices HybridProblemCore::drawSample(const MultiIndices& pool, bool raysFromOneCamera,
                                           const std::function<int()>& random) const {
  data_->checkPool("indices", pool);
  const int rays = data_->problem.rays(), points = data_->problem.points();
  if (pool[0].size() < static_cast<std::size_t>(rays) || pool[1].size() < static_cast<std::size_t>(points)) return {};
  MultiIndices sample(2);
  sample[0] = raysFromOneCamera && rays > 1 ? drawSubset(drawCamera(pool[0], data_->cameras, rays, random), rays, random)
                                            : drawSubset(pool[0], rays, random);
  sample[1] = drawSubset(pool[1], points, random);
  return sample;
}

bool HybridProblemCore::isSampleGood(const MultiIndices& sample) const { return data_->isGood(data_->read(sample)); }

bool HybridProblemCore::computeModel(const MultiIndices& sample, const std::vector<int>& pool, FocalPose& model) const {
  const Sample correspondences = data_->read(sample);
  checkRanges("indices", pool, data_->count());
  if (!data_->isGood(correspondences)) return false;
  const solvers::MinimalSolver* const solver = data_->problem.forSample(correspondences.rays.data());
  if (!solver) return false;

  std::vector<double> squaredDistances;
  double best = std::numeric_limits<double>::infinity();
  for (const FocalPose& solution : hybridgv::hybrid_pose::solve(*solver, correspondences)) {
    data_->computeSquaredDistances(solution, squaredDistances);
    double cost = 0;
    for (int i : pool) {
      const double x = squaredDistances[static_cast<std::size_t>(i)];
      cost += x < 1 ? x : 1;
    }
    if (cost >= best) continue;
    best = cost;
    model = solution;
  }
  return std::isfinite(best);
}

void HybridProblemCore::distances(const FocalPose& model, const std::vector<int>& flat, std::vector<double>& result) const {
  checkRanges("indices", flat, data_->count());
  std::vector<double> squaredDistances;
  data_->computeSquaredDistances(model, squaredDistances);
  result.resize(flat.size());
  for (std::size_t k = 0; k < flat.size(); ++k) {
    const double distance = std::sqrt(squaredDistances[static_cast<std::size_t>(flat[k])]);
    result[k] = distance < kMaxDistance ? distance : kMaxDistance;  // the comparison is false for NaN
  }
}

int HybridProblemCore::countWithin(const FocalPose& model, const std::vector<int>& flat, double threshold) const {
  checkRanges("indices", flat, data_->count());
  if (!(threshold >= 0)) throwInvalid("threshold", "must not be negative, is " + detail::format(threshold));
  std::vector<double> squaredDistances;
  data_->computeSquaredDistances(model, squaredDistances);
  const double squaredThreshold = threshold * threshold;
  int count = 0;
  for (int i : flat) count += squaredDistances[static_cast<std::size_t>(i)] < squaredThreshold;
  return count;
}

FocalPose HybridProblemCore::optimize(const MultiIndices& inliers, const FocalPose& model) const {
  data_->checkPool("inliers", inliers);
  checkPose("model", model);
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

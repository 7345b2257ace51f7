#include "hybridgv/sac/HybridRansac.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "robust/HybridSearch.hpp"

namespace hybridgv {
namespace sac {
namespace {

// The mask in the adapter's order, and the number of inliers.
int setMask(const std::vector<char>& inliers, const std::vector<int>& indices, std::vector<char>& mask) {
  for (std::size_t i = 0; i < inliers.size(); ++i) mask[static_cast<std::size_t>(indices[i])] = inliers[i];
  return static_cast<int>(std::count(inliers.begin(), inliers.end(), 1));
}

void setMasks(const robust::HybridSearch& search, HybridRansacResult& result) {
  const robust::PerKind<std::vector<char>> inliers = search.scorer().inliers(search.best().pose);
  result.numberInliers2d2d = setMask(inliers.rays, search.data().rayIndices, result.inliers2d2d);
  result.numberInliers2d3d = setMask(inliers.points, search.data().pointIndices, result.inliers2d3d);
}

// Rays that are no inliers although their errors are small.
void takeOut(const std::vector<std::size_t>& rays, const std::vector<int>& indices, HybridRansacResult& result) {
  for (const std::size_t ray : rays) {
    char& inlier = result.inliers2d2d[static_cast<std::size_t>(indices[ray])];
    result.numberInliers2d2d -= inlier;
    inlier = 0;
  }
}

// From the normalized frame to the rig's, where positions are `unit` times larger.
void setCovariance(const robust::ParameterMatrix& normalized, double unit, robust::Intrinsics estimated,
                   HybridRansacResult& result) {
  const robust::ParameterMatrix covariance = robust::withPositionsTimes(unit, normalized);
  result.covariance = robust::toFocalPoseMatrix(covariance, estimated);
  result.focalLengthStandardDeviation =
      result.pose.focalLength * std::sqrt(robust::varianceOfLogFocalLength(covariance, estimated));
}

void setStatistics(const robust::HybridSearch& search, HybridRansacResult& result) {
  result.iterations = search.iterations();
  result.localOptimizations = search.localOptimizations();
  result.stopReason = search.stopReason();
  for (std::size_t s = 0; s < search.choice().strategies().size(); ++s)
    result.iterationsPerSolver[*search.choice().strategies()[s].solver.id] += search.choice().drawn()[s];
}

void setPose(robust::HybridSearch& search, const HybridRansacOptions& options, HybridRansacResult& result) {
  const robust::FinalPose final = search.finish(options.finalOptimization);
  const correspondences::Normalization& normalization = search.data().arrays.normalization();
  result.pose = normalization.undo(final.pose);
  result.noise2d2d = final.noise.rays.deviation;
  result.noise2d3d = final.noise.points.deviation;
  result.score = search.best().evaluation.score;
  result.solver = search.best().solver;
  setMasks(search, result);
  takeOut(final.refusedRays, search.data().rayIndices, result);
  if (final.isRegular) setCovariance(final.covariance, normalization.unit, search.estimated(), result);
  result.failureReason = search.verdict(final);
  result.success = result.failureReason == FailureReason::None;
}

}  // namespace

HybridRansacResult hybridRansac(const hybrid_pose::HybridAdapterBase& adapter, const HybridRansacOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  options.check();
  HybridRansacResult result;
  result.covariance.fill(std::numeric_limits<double>::infinity());

  robust::HybridSearch search(adapter, options, start);
  result.inliers2d2d.resize(search.data().rayIndices.size());
  result.inliers2d3d.resize(search.data().pointIndices.size());
  if (!search.canStart()) {
    result.failureReason = FailureReason::TooFewCorrespondences;
  } else {
    search.run();
    setStatistics(search, result);
    if (search.hasModel()) setPose(search, options, result);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace sac
}  // namespace hybridgv

#include "hybridgv/sac/HybridRansac.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "hybridgv/distortion.hpp"
#include "robust/HybridSearch.hpp"
#include "robust/SecondPose.hpp"

namespace hybridgv {
namespace sac {
namespace {

// The mask in the adapter's order, and the number of inliers.
int setMask(const std::vector<char>& inliers, const std::vector<int>& indices, std::vector<char>& mask) {
  for (std::size_t i = 0; i < inliers.size(); ++i) mask[static_cast<std::size_t>(indices[i])] = inliers[i];
  return static_cast<int>(std::count(inliers.begin(), inliers.end(), 1));
}

void setMasks(const robust::HybridSearch& search, HybridRansacResult& result) {
  const robust::PerKind<std::vector<char>>& inliers = search.inliers();
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

// Distances of the inliers' image points from the principal point.
std::vector<double> inlierRadii(const robust::SearchData& data, const HybridRansacResult& result) {
  std::vector<double> radii;
  const auto add = [&](const auto& matches, const std::vector<int>& indices, const std::vector<char>& inliers) {
    for (std::size_t i = 0; i < matches.size(); ++i)
      if (inliers[static_cast<std::size_t>(indices[i])] != 0) radii.push_back(std::hypot(matches[i].u, matches[i].v));
  };
  add(data.arrays.rays(), data.rayIndices, result.inliers2d2d);
  add(data.arrays.points(), data.pointIndices, result.inliers2d3d);
  return radii;
}

// k1 depends on the distortion c by a slope, which is taken from a difference, and on the focal length by its square.
double deviationOfK1(const HybridRansacResult& result, const std::vector<double>& radii,
                     const robust::ParameterMatrix& covariance, robust::Intrinsics estimated) {
  const Eigen::Index c = covariance.rows() - 1, logF = c - 1;
  const double step = 0.01 * std::sqrt(covariance(c, c)), f = result.pose.focalLength;
  const double byDistortion =
      (toSimpleRadial(f, result.distortion + step, radii).k1 - toSimpleRadial(f, result.distortion - step, radii).k1) /
      (2 * step);
  double variance = byDistortion * byDistortion * covariance(c, c);
  if (estimated.focalLength) {
    const double byLogF = 2 * result.simpleRadialK1;
    variance += 2 * byDistortion * byLogF * covariance(c, logF) + byLogF * byLogF * covariance(logF, logF);
  }
  return std::sqrt(std::max(variance, 0.));
}

// After the masks.
void setLens(const robust::HybridSearch& search, const robust::FinalPose& final, HybridRansacResult& result) {
  result.distortion = final.pose.distortion;
  const bool isPinhole = result.distortion == 0 && !search.estimated().radial;
  const std::vector<double> radii = isPinhole ? std::vector<double>() : inlierRadii(search.data(), result);
  const SimpleRadial model = toSimpleRadial(result.pose.focalLength, result.distortion, radii);
  result.simpleRadialFocalLength = model.focalLength;
  result.simpleRadialK1 = model.k1;
  if (!search.estimated().radial) return;
  const double infinity = std::numeric_limits<double>::infinity();
  result.distortionStandardDeviation = final.isRegular ? std::sqrt(robust::varianceOfDistortion(final.covariance)) : infinity;
  result.simpleRadialK1StandardDeviation =
      final.isRegular ? deviationOfK1(result, radii, final.covariance, search.estimated()) : infinity;
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
  result.score = search.score();
  result.solver = search.best().solver;
  setMasks(search, result);
  takeOut(final.treatment.refused(), search.data().rayIndices, result);
  setLens(search, final, result);
  if (final.isRegular) setCovariance(final.covariance, normalization.unit, search.estimated(), result);
  result.failureReason = search.verdict(final);
  result.success = result.failureReason == FailureReason::None;
}

void setSecondPose(const std::optional<robust::SecondPose>& second, const robust::HybridSearch& search,
                   HybridRansacResult& result) {
  if (!second) return;
  result.secondPose = search.data().arrays.normalization().undo(second->pose);
  result.secondPoseSupport = second->support;
  if (second->support <= robust::kAsGood) return;
  result.success = false;
  result.failureReason = FailureReason::AmbiguousPose;
}

// All of them, or nearly so, agree with both.
void setMirroredPose(const robust::HybridSearch& search, HybridRansacResult& result) {
  if (!search.mirrored()) return;
  result.secondPose = search.data().arrays.normalization().undo(*search.mirrored());
  result.secondPoseSupport = 1;
  result.success = false;
  result.failureReason = FailureReason::AmbiguousPose;
}

}  // namespace

HybridRansacResult hybridRansac(const hybrid_pose::HybridAdapterBase& adapter, const HybridRansacOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  options.check();
  HybridRansacResult result;
  result.covariance.fill(std::numeric_limits<double>::infinity());

  robust::WorkerPool workers(robust::workersFor(options));
  robust::SearchData data = robust::readSearchData(adapter, options, workers);
  std::optional<robust::SearchData> part = robust::partOf(data, adapter, options);
  robust::HybridSearch search(std::move(data), std::move(part), options, workers, start);
  result.inliers2d2d.resize(search.data().rayIndices.size());
  result.inliers2d3d.resize(search.data().pointIndices.size());
  if (!search.canStart()) {
    result.failureReason = search.lacksScale() ? FailureReason::UndeterminedPose : FailureReason::TooFewCorrespondences;
  } else {
    search.run();
    setStatistics(search, result);
    if (search.hasModel()) setPose(search, options, result);
    if (result.success) setMirroredPose(search, result);
    if (result.success) setSecondPose(robust::findSecondPose(search, adapter, options, start), search, result);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace sac
}  // namespace hybridgv

#include "hybrid_pose/optimizeNonlinear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "CheckArguments.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "correspondences/readCorrespondence.hpp"
#include "hybridgv/detail/format.hpp"
#include "robust/LeastSquares.hpp"
#include "robust/Lens.hpp"

namespace hybridgv {
namespace hybrid_pose {

using correspondences::CorrespondenceArrays;
using correspondences::Intrinsics;
using robust::QueryPose;

static bool isDetermined(const robust::LeastSquaresProblem& problem, const QueryPose& pose) {
  robust::ParameterMatrix covariance;
  return 2 * problem.points.size + problem.rays.size >= static_cast<std::size_t>(problem.estimated.parameters()) &&
         robust::invertInformation(robust::information(problem, pose), covariance);
}

static void setDeviations(const robust::ParameterMatrix& information, Intrinsics estimated, NonlinearResult& result) {
  robust::ParameterMatrix covariance;
  const bool isRegular = robust::invertInformation(information, covariance);
  const auto deviation = [&](double variance) {
    return isRegular ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
  };
  if (!isRegular) covariance = information;
  result.focalLengthStandardDeviation =
      result.pose.focalLength * deviation(robust::varianceOfLogFocalLength(covariance, estimated));
  if (estimated.radial) result.distortionStandardDeviation = deviation(robust::varianceOfDistortion(covariance));
}

// From the normalized frame to the rig's, where positions are `unit` times larger.
static void setInformation(const robust::ParameterMatrix& normalized, double unit, Intrinsics estimated,
                           NonlinearResult& result) {
  const robust::ParameterMatrix information = robust::withPositionsTimes(1 / unit, normalized);
  result.information =
      robust::toFocalPoseMatrix(estimated.radial ? robust::informationWithoutDistortion(information) : information, estimated);
  setDeviations(information, estimated, result);
}

static robust::LeastSquaresOptions optionsFor(const CorrespondenceArrays& arrays, const QueryPose& start, Intrinsics estimated) {
  robust::LeastSquaresOptions options;
  if (!estimated.radial) return options;
  const double radius = arrays.imageRadius(), unit = radius > 0 ? 1 / (radius * radius) : 0;
  options.minDistortion = std::min(robust::kLeastDistortion * unit, start.distortion);
  options.maxDistortion = std::max(robust::kLargestDistortion * unit, start.distortion);
  return options;
}

NonlinearResult optimizeNonlinear(const correspondences::Correspondences& correspondences, const QueryPose& initial,
                                  Intrinsics estimated) {
  const CorrespondenceArrays arrays(correspondences);
  const robust::LeastSquaresProblem problem = robust::makeProblem(arrays, {}, {}, estimated);
  const correspondences::Normalization& normalization = arrays.normalization();
  const QueryPose start = normalization.applyTo(initial);

  robust::LeastSquaresOptions options = optionsFor(arrays, start, estimated);
  if (!isDetermined(problem, start)) options.maxIterations = 0;
  const robust::LeastSquaresResult minimum = robust::minimize(problem, start, options);

  NonlinearResult result;
  result.pose = minimum.iterations > 0 ? normalization.undo(minimum.pose) : static_cast<const FocalPose&>(initial);
  result.distortion = minimum.pose.distortion;
  result.converged = minimum.converged;
  result.iterations = minimum.iterations;
  result.cost = minimum.cost;
  setInformation(minimum.information, normalization.unit, problem.estimated, result);
  return result;
}

static NonlinearResult optimizeChecked(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                       const QueryPose& initial, Intrinsics estimated) {
  checkPose("initial", initial);
  if (!std::isfinite(initial.distortion))
    throwInvalid("initialDistortion", "must be finite, is " + detail::format(initial.distortion));
  return optimizeNonlinear(correspondences::readCorrespondences(adapter, indices[0], indices[1]), initial, estimated);
}

static NonlinearResult optimizeListed(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                      const QueryPose& initial, Intrinsics estimated) {
  if (indices.size() != 2) throwInvalid("indices", "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(indices.size()));
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  checkMultiIndices("indices", indices, {static_cast<int>(indices[0].size()), static_cast<int>(indices[1].size())},
                    {counts.rays, counts.points});
  return optimizeChecked(adapter, indices, initial, estimated);
}

static NonlinearResult optimizeAll(const HybridAdapterBase& adapter, const QueryPose& initial, Intrinsics estimated) {
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  return optimizeChecked(adapter, {correspondences::allIndices(counts.rays), correspondences::allIndices(counts.points)}, initial,
                         estimated);
}

static QueryPose withDistortion(const FocalPose& pose, double distortion) {
  QueryPose result = pose;
  result.distortion = distortion;
  return result;
}

NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                   const FocalPose& initial) {
  return optimizeListed(adapter, indices, initial, {});
}

NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const FocalPose& initial) {
  return optimizeAll(adapter, initial, {});
}

NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                   const FocalPose& initial, double initialDistortion) {
  return optimizeListed(adapter, indices, withDistortion(initial, initialDistortion), {true, true});
}

NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const FocalPose& initial, double initialDistortion) {
  return optimizeAll(adapter, withDistortion(initial, initialDistortion), {true, true});
}

}  // namespace hybrid_pose
}  // namespace hybridgv

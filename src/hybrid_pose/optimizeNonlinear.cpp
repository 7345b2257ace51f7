#include "hybrid_pose/optimizeNonlinear.hpp"

#include <cmath>
#include <limits>

#include "CheckArguments.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "correspondences/readCorrespondence.hpp"
#include "robust/LeastSquares.hpp"

namespace hybridgv {
namespace hybrid_pose {

static bool isDetermined(const robust::LeastSquaresProblem& problem, const FocalPose& pose) {
  robust::ParameterMatrix covariance;
  return 2 * problem.points.size + problem.rays.size >= static_cast<std::size_t>(problem.estimated.parameters()) &&
         robust::invertInformation(robust::information(problem, pose), covariance);
}

// From the normalized frame to the rig's, where positions are `unit` times larger.
static void setInformation(const robust::ParameterMatrix& normalized, double unit, robust::Intrinsics estimated,
                           NonlinearResult& result) {
  const robust::ParameterMatrix information = robust::withPositionsTimes(1 / unit, normalized);
  result.information = robust::toFocalPoseMatrix(information, estimated);
  robust::ParameterMatrix covariance;
  result.focalLengthStandardDeviation =
      robust::invertInformation(information, covariance)
          ? result.pose.focalLength * std::sqrt(robust::varianceOfLogFocalLength(covariance, estimated))
          : std::numeric_limits<double>::infinity();
}

NonlinearResult optimizeNonlinear(const correspondences::Correspondences& correspondences, const FocalPose& initial) {
  const correspondences::CorrespondenceArrays arrays(correspondences);
  const robust::LeastSquaresProblem problem = robust::makeProblem(arrays, {}, {});
  const correspondences::Normalization& normalization = arrays.normalization();
  const FocalPose start = normalization.apply(initial);

  robust::LeastSquaresOptions options;
  if (!isDetermined(problem, start)) options.maxIterations = 0;
  const robust::LeastSquaresResult minimum = robust::minimize(problem, start, options);

  NonlinearResult result;
  result.pose = minimum.iterations > 0 ? normalization.undo(minimum.pose) : initial;
  result.converged = minimum.converged;
  result.iterations = minimum.iterations;
  result.cost = minimum.cost;
  setInformation(minimum.information, normalization.unit, problem.estimated, result);
  return result;
}

NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                   const FocalPose& initial) {
  if (indices.size() != 2) throwInvalid("indices", "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(indices.size()));
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  checkMultiIndices("indices", indices, {static_cast<int>(indices[0].size()), static_cast<int>(indices[1].size())},
                    {counts.rays, counts.points});
  checkPose("initial", initial);
  return optimizeNonlinear(correspondences::readCorrespondences(adapter, indices[0], indices[1]), initial);
}

NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const FocalPose& initial) {
  checkPose("initial", initial);
  const correspondences::Counts counts = correspondences::readCounts(adapter);
  return optimizeNonlinear(correspondences::readCorrespondences(adapter, correspondences::allIndices(counts.rays),
                                                                correspondences::allIndices(counts.points)),
                           initial);
}

}  // namespace hybrid_pose
}  // namespace hybridgv

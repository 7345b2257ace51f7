// Levenberg-Marquardt on the query's pose and what is estimated of its camera.
#pragma once

#include <limits>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/FocalLengthPrior.hpp"
#include "robust/ParameterMatrix.hpp"
#include "robust/PerKind.hpp"
#include "robust/QueryPose.hpp"
#include "robust/WorkerPool.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

using correspondences::CorrespondenceArrays;

// What is known of the distortion c before: it is Cauchy distributed about 0. Costs twice the negative log of the density, times
// `factor`. A scale of 0 stands for no knowledge.
struct DistortionPrior {
  double cost(double distortion) const;
  // Half of the derivative of the cost is weight times c; information that is never negative.
  double weight(double distortion) const;

  double scale = 0;   // [1/px^2]
  double factor = 1;  // for costs that are smaller than -2 log of the likelihood
};

// The problem: minimize over the correspondences of the kinds that take part the sum of precision * scale^2 rho((error / scale)^2),
// and if the distortion or the focal length are estimated, the costs of their priors.
struct LeastSquaresProblem {
  const Kernels* kernels;
  PointArrays points;
  RayArrays rays;
  KindLoss pointLoss, rayLoss;
  Kinds kinds = kBothKinds;  // that take part
  Intrinsics estimated;      // the others keep the value that they have in the pose
  DistortionPrior distortionPrior = {};
  FocalLengthPrior focalLengthPrior = {};
  // Share the work where there are many correspondences, if given. The results are the same, to the bit.
  WorkerPool* workers = nullptr;
};

struct LeastSquaresOptions {
  int maxIterations = 100;
  double minRelativeDecrease = 1e-12;  // of the cost, in a step: then it has converged
  double minFocalLength = 0;
  double maxFocalLength = std::numeric_limits<double>::infinity();
  double minDistortion = -std::numeric_limits<double>::infinity();
  double maxDistortion = std::numeric_limits<double>::infinity();
};

struct LeastSquaresResult {
  QueryPose pose;
  // Where the cost was looked at last: at the result, or before a last short step that changes next to nothing.
  double cost = 0;
  ParameterMatrix information;  // J^T W J
  bool converged = false;
  int iterations = 0;
};

// With both kinds. The distortion of poses is taken into account if it is estimated.
LeastSquaresProblem makeProblem(const CorrespondenceArrays& arrays, const KindLoss& pointLoss, const KindLoss& rayLoss,
                                Intrinsics estimated = {});

// Its points alone.
LeastSquaresProblem withoutRays(LeastSquaresProblem problem);

// Never worse than the start: the cost of the result is at most that of the start. A start without finite cost or derivatives is
// returned as it is, with converged = false, infinite cost and information 0.
LeastSquaresResult minimize(const LeastSquaresProblem& problem, const QueryPose& start, const LeastSquaresOptions& options = {});

// Half of the first and the second derivative of the cost at a pose: J^T W e and J^T W J.
struct Derivatives {
  ParameterVector gradient;
  ParameterMatrix information;
};
Derivatives derivatives(const LeastSquaresProblem& problem, const QueryPose& pose);
// The second one alone.
ParameterMatrix information(const LeastSquaresProblem& problem, const QueryPose& pose);

// How the gradient changes with a shift of all image points along u and along v [1/px], the weights being kept.
ParameterPair gradientByImageShift(const LeastSquaresProblem& problem, const QueryPose& pose);

// Adds the kernels' sums over a part of the correspondences.
void add(const NormalEquations& part, NormalEquations& sums);

// Of the kernels' sums, what belongs to the parameters that are estimated.
ParameterMatrix estimatedPart(const NormalEquations& sums, Intrinsics estimated);
ParameterMatrix estimatedPart(const FullParameterMatrix& sums, Intrinsics estimated);
ParameterVector estimatedGradient(const NormalEquations& sums, Intrinsics estimated);

// The step of the estimated parameters that leads from one pose to another.
ParameterVector changeOf(const QueryPose& from, const QueryPose& to, Intrinsics estimated);

// A matrix over all parameters by which the kernels derive, with zeros for those that are not estimated.
ParameterMatrix byKernelParameters(const ParameterMatrix& matrix, Intrinsics estimated);

}  // namespace robust
}  // namespace hybridgv

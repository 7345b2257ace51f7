// Levenberg-Marquardt on the pose and focal length of the query.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/PerKind.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

using correspondences::CorrespondenceArrays;

using Matrix7 = Eigen::Matrix<double, kParameters, kParameters>;

// The problem: minimize over the correspondences of the kinds that take part the sum of precision * scale^2 rho((error / scale)^2).
struct LeastSquaresProblem {
  const Kernels* kernels;
  PointArrays points;
  RayArrays rays;
  KindLoss pointLoss, rayLoss;
  Kinds kinds = kBothKinds;  // that take part
};

struct LeastSquaresOptions {
  int maxIterations = 100;
  double minRelativeDecrease = 1e-12;  // of the cost, in a step: then it has converged
  double minFocalLength = 0;
  double maxFocalLength = std::numeric_limits<double>::infinity();
};

struct LeastSquaresResult {
  FocalPose pose;
  double cost = 0;
  Matrix7 information = Matrix7::Zero();  // J^T W J at the result
  bool converged = false;
  int iterations = 0;
};

LeastSquaresProblem makeProblem(const CorrespondenceArrays& arrays, const KindLoss& pointLoss, const KindLoss& rayLoss);

// Never worse than the start: the cost of the result is at most that of the start. A start without finite cost or derivatives is
// returned as it is, with converged = false and infinite cost.
LeastSquaresResult minimize(const LeastSquaresProblem& problem, const FocalPose& start, const LeastSquaresOptions& options = {});

// J^T W J at a pose.
Matrix7 information(const LeastSquaresProblem& problem, const FocalPose& pose);

// The inverse of a 7x7 information matrix; false if the data do not fix all seven parameters (to working precision).
bool invertInformation(const Matrix7& information, Matrix7& covariance);

}  // namespace robust
}  // namespace hybridgv

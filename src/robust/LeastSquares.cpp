#include "robust/LeastSquares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {
namespace {

using Vector7 = Eigen::Matrix<double, kParameters, 1>;

// The cost at a pose, with its derivatives.
struct Linearization {
  double cost = 0;
  Vector7 gradient;
  Matrix7 hessian;
  bool isFinite() const { return std::isfinite(cost) && gradient.allFinite() && hessian.allFinite(); }
};

Linearization linearize(const LeastSquaresProblem& problem, const FocalPose& pose) {
  const PlainPose plain = toPlain(pose);
  NormalEquations sums;
  if (problem.kinds.points) problem.kernels->addPoints(problem.points, plain, problem.pointLoss, sums);
  if (problem.kinds.rays) problem.kernels->addRays(problem.rays, plain, problem.rayLoss, sums);
  Linearization result;
  result.cost = sums.cost;
  for (int row = 0, k = 0; row < kParameters; ++row) {
    result.gradient[row] = sums.gradient[row];
    for (int column = row; column < kParameters; ++column, ++k)
      result.hessian(row, column) = result.hessian(column, row) = sums.hessian[k];
  }
  return result;
}

// exp([v]x)
Eigen::Matrix3d rotationOf(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, v / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
}

void orthonormalize(Eigen::Matrix3d& rotation) {
  rotation.col(0).normalize();
  rotation.col(1) = (rotation.col(1) - rotation.col(0).dot(rotation.col(1)) * rotation.col(0)).normalized();
  rotation.col(2) = rotation.col(0).cross(rotation.col(1));
}

FocalPose moved(const FocalPose& pose, const Vector7& step, const LeastSquaresOptions& options) {
  FocalPose result = pose;
  result.rotation = pose.rotation * rotationOf(step.head<3>());
  orthonormalize(result.rotation);
  result.position += step.segment<3>(3);
  const double least = std::max(options.minFocalLength, std::numeric_limits<double>::min());  // positive also after rounding
  result.focalLength = std::clamp(pose.focalLength * std::exp(step[6]), least, options.maxFocalLength);
  return result;
}

// Solves (hessian + damping diag(hessian)) step = -gradient, in units in which the diagonal is 1. A parameter without influence
// stays.
Vector7 dampedStep(const Linearization& at, double damping) {
  const Vector7 scale = at.hessian.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.; });
  Matrix7 matrix = scale.asDiagonal() * at.hessian * scale.asDiagonal();
  matrix.diagonal().setConstant(1 + damping);
  return -scale.cwiseProduct(matrix.llt().solve(scale.cwiseProduct(at.gradient)));
}

}  // namespace

LeastSquaresProblem makeProblem(const CorrespondenceArrays& arrays, const KindLoss& pointLoss, const KindLoss& rayLoss) {
  return {&kernels(), arrays.pointArrays(), arrays.rayArrays(), pointLoss, rayLoss, kBothKinds};
}

LeastSquaresResult minimize(const LeastSquaresProblem& problem, const FocalPose& start, const LeastSquaresOptions& options) {
  constexpr double kMaxDamping = 1e10, kMinDamping = 1e-12;
  LeastSquaresResult result;
  result.pose = start;
  Linearization current = linearize(problem, start);
  if (!current.isFinite()) {
    result.cost = std::numeric_limits<double>::infinity();
    return result;
  }
  double damping = 1e-4;
  while (!result.converged && result.iterations < options.maxIterations) {
    ++result.iterations;
    const Vector7 step = dampedStep(current, damping);
    const FocalPose candidate = moved(result.pose, step, options);
    const Linearization next = linearize(problem, candidate);
    if (next.cost < current.cost && next.isFinite()) {
      result.converged = current.cost - next.cost <= options.minRelativeDecrease * current.cost;
      result.pose = candidate;
      current = next;
      damping = std::max(damping / 10, kMinDamping);
    } else {
      // No decrease although the step is a short one down the gradient: the minimum is reached to working precision.
      result.converged = damping >= kMaxDamping || -current.gradient.dot(step) <= options.minRelativeDecrease * current.cost;
      damping *= 10;
    }
  }
  result.cost = current.cost;
  result.information = current.hessian;
  return result;
}

Matrix7 information(const LeastSquaresProblem& problem, const FocalPose& pose) { return linearize(problem, pose).hessian; }

bool invertInformation(const Matrix7& information, Matrix7& covariance) {
  // Smallest eigenvalue of the information in units in which every parameter alone has information 1.
  constexpr double kSmallest = 1e-13;
  const Vector7 diagonal = information.diagonal();
  if (!information.allFinite() || !(diagonal.minCoeff() > 0)) return false;
  const Vector7 scale = diagonal.cwiseSqrt().cwiseInverse();
  const Matrix7 correlation = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix7> eigen(correlation);
  if (!(eigen.eigenvalues()[0] > kSmallest)) return false;
  const Matrix7 inverse =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  return covariance.allFinite();
}

}  // namespace robust
}  // namespace hybridgv

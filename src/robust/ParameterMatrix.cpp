#include "robust/ParameterMatrix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace hybridgv {
namespace robust {

using correspondences::kFocalPoseParameters;
using correspondences::kPoseParameters;

FullParameterMatrix extendedByIdentity(const ParameterMatrix& matrix) {
  FullParameterMatrix result = FullParameterMatrix::Identity();
  result.topLeftCorner(matrix.rows(), matrix.cols()) = matrix;
  return result;
}

Eigendecomposition eigendecomposition(const FullParameterMatrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<FullParameterMatrix> eigen(matrix);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

FullParameterMatrix Eigendecomposition::withValues(const FullParameterVector& others) const {
  return vectors * others.asDiagonal() * vectors.transpose();
}

FullParameterMatrix enlarged(const FullParameterMatrix& L, const FullParameterMatrix& other, double allowance) {
  const auto lower = L.triangularView<Eigen::Lower>();
  const FullParameterMatrix half = lower.solve(other);
  const FullParameterMatrix halfTransposed = half.transpose();
  const Eigendecomposition white = eigendecomposition(lower.solve(halfTransposed));
  const FullParameterVector factors = (white.values.array() - allowance).cwiseMax(1);
  return L * white.withValues(factors) * L.transpose();
}

// The inverse of a matrix with ones in its diagonal; false if its smallest eigenvalue is too small.
static bool invertScaled(const FullParameterMatrix& scaled, FullParameterMatrix& inverse) {
  constexpr double kSmallest = 1e-13, kSurelyLarger = 1e-10;
  const Eigen::LLT<FullParameterMatrix> cholesky(scaled);
  if (cholesky.info() == Eigen::Success) {
    inverse = cholesky.solve(FullParameterMatrix::Identity());
    if (inverse.trace() < 1 / kSurelyLarger) return true;  // the trace exceeds every eigenvalue
  }
  const Eigendecomposition eigen = eigendecomposition(scaled);
  if (!(eigen.values[0] > kSmallest)) return false;
  inverse = eigen.withValues(eigen.values.cwiseInverse());
  return true;
}

bool invertInformation(const ParameterMatrix& information, ParameterMatrix& covariance) {
  const FullParameterMatrix extended = extendedByIdentity(information);
  const FullParameterVector diagonal = extended.diagonal();
  if (!extended.allFinite() || !(diagonal.minCoeff() > 0)) return false;
  // Units in which every parameter alone has information 1.
  const FullParameterVector scale = diagonal.cwiseSqrt().cwiseInverse();
  FullParameterMatrix inverse;
  if (!invertScaled(scale.asDiagonal() * extended * scale.asDiagonal(), inverse)) return false;
  inverse = scale.asDiagonal() * inverse * scale.asDiagonal();
  covariance = inverse.topLeftCorner(information.rows(), information.cols());
  return covariance.allFinite();
}

ParameterMatrix withPositionsTimes(double factor, ParameterMatrix matrix) {
  matrix.middleRows<3>(3) *= factor;
  matrix.middleCols<3>(3) *= factor;
  return matrix;
}

FocalPoseMatrix toFocalPoseMatrix(const ParameterMatrix& matrix, Intrinsics estimated) {
  const int size = estimated.focalLength ? kFocalPoseParameters : kPoseParameters;
  Eigen::Matrix<double, kFocalPoseParameters, kFocalPoseParameters> full;
  full.setZero();
  full.topLeftCorner(size, size) = matrix.topLeftCorner(size, size);
  FocalPoseMatrix result;
  Eigen::Map<Eigen::Matrix<double, kFocalPoseParameters, kFocalPoseParameters>>(result.data()) = full;
  return result;
}

ParameterMatrix informationWithoutDistortion(const ParameterMatrix& information) {
  const Eigen::Index last = information.rows() - 1;
  const double ofDistortion = information(last, last);
  if (!(ofDistortion > 0)) return information.topLeftCorner(last, last);
  return information.topLeftCorner(last, last) -
         information.col(last).head(last) * information.row(last).head(last) / ofDistortion;
}

double varianceOfDistortion(const ParameterMatrix& covariance) {
  const Eigen::Index last = covariance.rows() - 1;
  return covariance(last, last);
}

double varianceOfLogFocalLength(const ParameterMatrix& covariance, Intrinsics estimated) {
  return estimated.focalLength ? covariance(kPoseParameters, kPoseParameters) : 0;
}

}  // namespace robust
}  // namespace hybridgv

#include "robust/ParameterMatrix.hpp"

#include <Eigen/Eigenvalues>

#include "robust/FixedSize.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::kFocalPoseParameters;
using correspondences::kPoseParameters;

template <int N>
bool invertFixed(const Eigen::Matrix<double, N, N>& information, ParameterMatrix& covariance) {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  // Smallest eigenvalue of the information in units in which every parameter alone has information 1.
  constexpr double kSmallest = 1e-13;
  const Vector diagonal = information.diagonal();
  if (!information.allFinite() || !(diagonal.minCoeff() > 0)) return false;
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  const Matrix correlation = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(correlation);
  if (!(eigen.eigenvalues()[0] > kSmallest)) return false;
  const Matrix inverse =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  return covariance.allFinite();
}

}  // namespace

bool invertInformation(const ParameterMatrix& information, ParameterMatrix& covariance) {
  return withFixedSize(static_cast<int>(information.rows()), [&](auto size) {
    constexpr int N = decltype(size)::value;
    return invertFixed<N>(Eigen::Matrix<double, N, N>(information), covariance);
  });
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

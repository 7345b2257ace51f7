// Covariance and information of what is estimated.
#pragma once

#include <Eigen/Core>
#include <array>

#include "correspondences/Intrinsics.hpp"

namespace hybridgv {
namespace robust {

using correspondences::Intrinsics;

// A square symmetric matrix over the parameters that are estimated: a small rotation in the query's frame (R -> R exp([.]x)), the
// position, then log f and the distortion as far as the Intrinsics have them.
using ParameterMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, correspondences::kMostParameters,
                                      correspondences::kMostParameters>;

using ParameterVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, correspondences::kMostParameters, 1>;

// How the parameters change with two other quantities.
using ParameterPair = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, correspondences::kMostParameters, 2>;

// As the public results have it: over the parameters of a FocalPose.
using FocalPoseMatrix = std::array<double, correspondences::kFocalPoseParameters * correspondences::kFocalPoseParameters>;

// Of the size that fits all parameters, which the compiler knows.
using FullParameterMatrix = Eigen::Matrix<double, correspondences::kMostParameters, correspondences::kMostParameters>;
using FullParameterVector = Eigen::Matrix<double, correspondences::kMostParameters, 1>;

// With the identity in the rows and columns that the matrix lacks: they take no part in decompositions.
FullParameterMatrix extendedByIdentity(const ParameterMatrix& matrix);

// Eigenvalues, the smallest first, and eigenvectors: matrix = vectors diag(values) vectors^T.
struct Eigendecomposition {
  // The matrix with the same eigenvectors and other eigenvalues.
  FullParameterMatrix withValues(const FullParameterVector& others) const;

  FullParameterVector values;
  FullParameterMatrix vectors;
};

Eigendecomposition eigendecomposition(const FullParameterMatrix& matrix);

// The least matrix that is at least L L^T and, but for the part `allowance` of L L^T, at least `other`, in the directions in which they differ:
// where other = L M L^T, the eigenvalues of M less the allowance take the place of 1 if they are larger.
FullParameterMatrix enlarged(const FullParameterMatrix& L, const FullParameterMatrix& other, double allowance = 0);

// The inverse of an information matrix; false if the data do not fix all parameters (to working precision).
bool invertInformation(const ParameterMatrix& information, ParameterMatrix& covariance);

// The same matrix for positions that are measured in another unit: rows and columns of the position times `factor`.
ParameterMatrix withPositionsTimes(double factor, ParameterMatrix matrix);

// A focal length that is not estimated has zeros in its row and column. The distortion is left out: of a covariance, that is the
// marginal one.
FocalPoseMatrix toFocalPoseMatrix(const ParameterMatrix& matrix, Intrinsics estimated);

// The information about the other parameters where the distortion, the last one, is unknown: the inverse of their covariance.
ParameterMatrix informationWithoutDistortion(const ParameterMatrix& information);

double varianceOfDistortion(const ParameterMatrix& covariance);

// Where the focal length is not estimated, its logarithm has the variance 0.
double varianceOfLogFocalLength(const ParameterMatrix& covariance, Intrinsics estimated);

}  // namespace robust
}  // namespace hybridgv

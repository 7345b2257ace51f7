#include "math/roots/BinaryFormRoots.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

namespace hybridgv {
namespace math {

// With w = pi / (D+1), psi_k = k w: the direction of sample k is alpha_k v0 + beta_k v1, alpha_k = sin((1-k) w) / sin w and
// beta_k = sin(k w) / sin w, so that p_k = sum_i C(D,i) alpha_k^(D-i) beta_k^i b_i. The inverse is well conditioned, and it is
// computed once per degree, in extended precision.
void bernsteinMatrix(int degree, int first, double* matrix) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const long double w = 3.141592653589793238462643383279502884L / (degree + 1);
  Matrix samplesFromBernstein(degree + 1, degree + 1);
  for (int row = 0; row <= degree; ++row) {
    const int k = first + row;
    const long double alpha = std::sin((1 - k) * w) / std::sin(w), beta = std::sin(k * w) / std::sin(w);
    long double binomial = 1;
    for (int i = 0; i <= degree; ++i) {
      samplesFromBernstein(row, i) = binomial * std::pow(alpha, degree - i) * std::pow(beta, i);
      binomial = binomial * (degree - i) / (i + 1);
    }
  }
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(matrix, degree + 1, degree + 1) =
      samplesFromBernstein.inverse().cast<double>();
}

}  // namespace math
}  // namespace hybridgv

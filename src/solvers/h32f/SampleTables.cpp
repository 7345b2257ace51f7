#include "solvers/h32f/SampleTables.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace hybridgv {
namespace solvers {
namespace h32f {

constexpr long double kPi = 3.141592653589793238462643383279502884L;
constexpr double kRho = 0.8;
constexpr int kPoleOrder = 13;
constexpr double kLargest = 0.97;  // where the last piece begins; the samples lie below

const SampleTables& SampleTables::get() {
  static const SampleTables tables;
  return tables;
}

double SampleTables::factor(double e) {
  const double e2 = e * e, w = 1 - e2, p = e2 + kRho * kRho;
  const double w2 = w * w, w4 = w2 * w2, p2 = p * p, p4 = p2 * p2;
  return 1 / (w4 * w4 * w4 * w2 * e2 * e2 * e2 * p4 * p4 * p4 * p);
}

using Matrix = Eigen::Matrix<long double, kDegree + 1, kDegree + 1>;

// Values at the points x of [0, 1] from Bernstein coefficients.
static Matrix bernsteinBasis(const long double* x) {
  Matrix basis;
  for (int k = 0; k <= kDegree; ++k) {
    long double binomial = 1;
    for (int i = 0; i <= kDegree; ++i) {
      basis(k, i) = binomial * std::pow(x[k], i) * std::pow(1 - x[k], kDegree - i);
      binomial = binomial * (kDegree - i) / (i + 1);
    }
  }
  return basis;
}

SampleTables::SampleTables() {
  const math::RationalChebyshev rational(kSamples, kPoleOrder, kRho, kLargest);
  long double norm = 0;
  for (long double weight : rational.weights) norm += weight * weight;
  for (int i = 0; i < kHalf; ++i) {
    const std::size_t k = kHalf + static_cast<std::size_t>(i);
    nodes[i] = static_cast<double>(rational.nodes[k]);
    nodes[i + kHalf] = -nodes[i];
    factors[i] = factors[i + kHalf] = factor(nodes[i]);
    noiseWeights[i] = static_cast<double>(rational.weights[k] / std::sqrt(norm));  // that of -e_k is the opposite
  }
  for (int i = kSamples; i < kSamples + 4; ++i) nodes[i] = nodes[kSamples - 1];

  long double x[kDegree + 1];
  for (int k = 0; k <= kDegree; ++k) x[k] = (1 - std::cos((k + 0.5L) * kPi / (kDegree + 1))) / 2;
  const Matrix bernsteinFromValues = bernsteinBasis(x).inverse();
  binomial[0] = 1;
  for (int i = 0; i <= kDegree; ++i) {
    chebyshev[i] = static_cast<double>(x[i]);
    if (i > 0) binomial[i] = binomial[i - 1] * (kDegree + 1 - i) / i;
    for (int k = 0; k <= kDegree; ++k) fromChebyshev[i][k] = static_cast<double>(bernsteinFromValues(i, k));
    for (int order : {0, 1})
      tail[order][i] = static_cast<double>(2 * std::cos((kDegree - order) * (i + 0.5L) * kPi / (kDegree + 1)) / (kDegree + 1));
  }

  // Breakpoints at equal phase up to the largest node's end, then 1.
  for (int j = 0; j < kPieces; ++j)
    breakpoints[j] = static_cast<double>(rational.pointAtPhase(kHalf * kPi * (kPieces - 1 - j) / (kPieces - 1)));
  breakpoints[0] = 0;
  breakpoints[kPieces] = 1;
  for (int j = 0; j < kPieces; ++j) {
    // Row k: half the sum, row k + kHalf: half the difference of the cardinal functions of a node and its mirror image.
    Eigen::Matrix<long double, kSamples, kDegree + 1> values;
    for (int i = 0; i <= kDegree; ++i) {
      const long double width = static_cast<long double>(breakpoints[j + 1]) - breakpoints[j];
      const std::vector<long double> cardinals = rational.cardinals(breakpoints[j] + width * x[i]);
      for (int k = 0; k < kHalf; ++k) {
        const auto n = static_cast<std::size_t>(k);
        const long double own = cardinals[kHalf + n], mirrored = cardinals[kHalf - 1 - n];
        values(k, i) = (own + mirrored) / 2;
        values(k + kHalf, i) = (own - mirrored) / 2;
      }
    }
    const Eigen::Matrix<long double, kSamples, kDegree + 1> coefficients = values * bernsteinFromValues.transpose();
    for (int i = 0; i <= kDegree; ++i)
      for (int k = 0; k < kHalf; ++k) {
        even[i][k][j] = static_cast<double>(coefficients(k, i));
        odd[i][k][j] = static_cast<double>(coefficients(k + kHalf, i));
      }
  }
}

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv

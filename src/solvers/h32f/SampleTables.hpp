// The constants by which the resultant of H32f is sampled and turned into piecewise polynomials.
#pragma once

#include "math/roots/RationalChebyshev.hpp"

namespace hybridgv {
namespace solvers {
namespace h32f {

// The Dixon determinant is R(e) = const (1-e^2)^14 e^6 R26(e), deg R26 = 26. What is sampled and searched for roots is
//
//     y(e) = R(e) / ((1-e^2)^14 e^6 (e^2 + rho^2)^13),
//
// a rational function of known denominator that varies much less over [-1, 1] than R26 does. The nodes avoid e = 0 and e = +-1,
// where R vanishes.
constexpr int kSamples = 28;
constexpr int kHalf = kSamples / 2;

// [0, 1] is cut into pieces, on each of which y(e) and y(-e) are polynomials up to rounding.
constexpr int kPieces = 16;
constexpr int kDegree = 12;

struct PieceCoefficients {
  double b[2][kDegree + 1][kPieces];  // y on piece j has the Bernstein coefficients b[0][.][j], on its mirror image b[1][.][j]
  double low[2][kPieces], high[2][kPieces];  // the smallest and the largest of them
};

struct SampleTables {
  static const SampleTables& get();

  double nodes[kSamples + 4];  // node i and its mirror image i + kHalf; padded by repetition
  double factors[kSamples];    // y = factor * determinant
  double noiseWeights[kHalf];  // sum_i noiseWeights[i] (y_i - y_(i+kHalf)) = 0 because R26 has degree 26, not 27; unit length
  double breakpoints[kPieces + 1];
  // Bernstein coefficient i of piece j of the even part y(e) + y(-e) over 2: sum_k even[i][k][j] (y_k + y_(k+kHalf)); odd alike.
  double even[kDegree + 1][kHalf][kPieces], odd[kDegree + 1][kHalf][kPieces];
  // Interpolation at kDegree + 1 Chebyshev points of [0, 1]: Bernstein coefficient i = sum_k fromChebyshev[i][k] y(chebyshev[k]).
  double chebyshev[kDegree + 1];
  double fromChebyshev[kDegree + 1][kDegree + 1];
  // The last two Chebyshev coefficients: sum_k tail[i][k] y(chebyshev[k]).
  double tail[2][kDegree + 1];
  double binomial[kDegree + 1];

  SampleTables();
  // y(e) / determinant(e)
  static double factor(double e);
};

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv

// Interpolation by real functions p(x) / (x^2 + rho^2)^m, deg p < n, at Chebyshev-like nodes in [-scale, scale].
#pragma once

#include <vector>

namespace hybridgv {
namespace math {

// The nodes are the zeros of the function p / (x^2 + rho^2)^m of this kind that oscillates evenly between -1 and 1 on
// [-scale, scale] (for m = 0: the Chebyshev polynomial), so that interpolation there is well conditioned although the sampled
// function need not be smooth near the poles +-i rho. n must be even and > 2 m. With x = scale cos(theta) the zeros are where
//
//     phase(theta) = n theta - 2 m arg(1 + b^2 exp(2 i theta)) = (k - 1/2) pi,    b = sqrt(1 + r^2) - r,  r = rho / scale.
struct RationalChebyshev {
  RationalChebyshev(int nodeCount, int poleOrder, long double poleDistance, long double largestNode);

  // The point with phase(theta) = phase, 0 <= phase <= n pi; it decreases from scale to -scale.
  long double pointAtPhase(long double phase) const;
  // The values at x of the cardinal functions: the k-th is 1 at nodes[k], 0 at the others.
  std::vector<long double> cardinals(long double x) const;

  int m;
  long double rho, scale;
  std::vector<long double> nodes;  // increasing
  // Barycentric weights (x_k^2 + rho^2)^m / prod_{j != k} (x_k - x_j). Their product with the samples sums up to the coefficient
  // of x^(n-1) in p.
  std::vector<long double> weights;
};

}  // namespace math
}  // namespace hybridgv

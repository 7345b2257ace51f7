#include "math/roots/RationalChebyshev.hpp"

#include <cmath>

namespace hybridgv {
namespace math {

constexpr long double kPi = 3.141592653589793238462643383279502884L;

RationalChebyshev::RationalChebyshev(int nodeCount, int poleOrder, long double poleDistance, long double largestNode)
    : m(poleOrder), rho(poleDistance), scale(largestNode), nodes(static_cast<std::size_t>(nodeCount)), weights(nodes.size()) {
  // Symmetric pairs, so that even and odd parts can be told apart exactly.
  const std::size_t n = nodes.size();
  for (std::size_t k = 0; k < n / 2; ++k) {
    nodes[n - 1 - k] = pointAtPhase((static_cast<long double>(k) + 0.5L) * kPi);
    nodes[k] = -nodes[n - 1 - k];
  }
  for (std::size_t k = 0; k < n; ++k) {
    weights[k] = 1;
    for (int i = 0; i < m; ++i) weights[k] *= nodes[k] * nodes[k] + rho * rho;
    for (std::size_t j = 0; j < n; ++j)
      if (j != k) weights[k] /= nodes[k] - nodes[j];
  }
}

long double RationalChebyshev::pointAtPhase(long double phase) const {
  const long double r = rho / scale, b = std::sqrt(1 + r * r) - r, b2 = b * b, n = static_cast<long double>(nodes.size());
  // Newton's method for the increasing function phase(theta), kept inside a shrinking bracket.
  long double low = 0, high = kPi, theta = phase / n;
  for (int i = 0; i < 100; ++i) {
    const long double c = std::cos(2 * theta), s = std::sin(2 * theta);
    const long double error = n * theta - 2 * m * std::atan2(b2 * s, 1 + b2 * c) - phase;
    const long double slope = n - 4 * m * b2 * (c + b2) / (1 + 2 * b2 * c + b2 * b2);
    (error < 0 ? low : high) = theta;
    long double next = theta - error / slope;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const long double step = std::abs(next - theta);
    theta = next;
    if (step < 1e-18L) break;
  }
  return scale * std::cos(theta);
}

std::vector<long double> RationalChebyshev::cardinals(long double x) const {
  long double product = 1, denominator = 1;  // of (x - x_j), and (x^2 + rho^2)^m
  for (long double node : nodes) product *= x - node;
  for (int i = 0; i < m; ++i) denominator *= x * x + rho * rho;
  std::vector<long double> values(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (x == nodes[k]) {
      values.assign(nodes.size(), 0);
      values[k] = 1;
      return values;
    }
    values[k] = weights[k] * product / (denominator * (x - nodes[k]));
  }
  return values;
}

}  // namespace math
}  // namespace hybridgv

#include "math/roots/BinaryFormRoots.hpp"

#include <vector>

namespace hybridgv {
namespace math {
namespace {

long double binomial(int n, int k) {
  long double result = 1;
  for (int i = 0; i < k; ++i) result = result * static_cast<long double>(n - i) / static_cast<long double>(i + 1);
  return result;
}

// cos(m w), w = pi / (degree + 1), for every integer m: cosines of small angles only, so that all are exact to rounding.
class Cosines {
 public:
  explicit Cosines(int degree) : period_(2 * (degree + 1)) {
    const long double w = 3.141592653589793238462643383279502884L / static_cast<long double>(degree + 1);
    for (int m = 0; m < period_; ++m) values_.push_back(std::cos(w * static_cast<long double>(std::min(m, period_ - m))));
  }
  long double operator[](int m) const { return values_[static_cast<std::size_t>((m % period_ + period_) % period_)]; }

 private:
  int period_;
  std::vector<long double> values_;
};

}  // namespace

// A form of degree D is a sum of the D+1 exponentials e^(i (2a-D) psi), a = 0 .. D, whose coefficients are a discrete Fourier
// transform of the samples. Each exponential is the product of a factors (c + i s) and D-a factors (c - i s); its Bernstein
// coefficient b_i is the mean over all ways to give i of these factors the direction v1 and the others v0 (the polar form), where
// c + i s is e^(i w) or 1, w = pi / (D+1). The sum is symmetric in a and D-a, so that it is real:
//
//     b_i = 1/(D+1) sum_k p_k sum_a 1/C(D,a) sum_j C(i,j) C(D-i,a-j) cos((2a-D) k w - (2j-i) w).
//
// Nothing cancels: the result is exact to rounding for every degree, where the inverse of the matrix from coefficients to samples
// is useless from degree 16 on.
void bernsteinMatrix(int degree, int first, double* matrix) {
  const Cosines cosines(degree);
  for (int i = 0; i <= degree; ++i)
    for (int column = 0; column <= degree; ++column) {
      const int k = first + column;
      long double sum = 0;
      for (int a = 0; a <= degree; ++a)
        for (int j = std::max(0, a - degree + i); j <= std::min(i, a); ++j)
          sum += binomial(i, j) * binomial(degree - i, a - j) / binomial(degree, a) * cosines[(2 * a - degree) * k - (2 * j - i)];
      matrix[i * (degree + 1) + column] = static_cast<double>(sum / static_cast<long double>(degree + 1));
    }
}

}  // namespace math
}  // namespace hybridgv

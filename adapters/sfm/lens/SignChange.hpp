// Where a polynomial changes its sign for the first time.
#pragma once

#include <vector>

namespace hybridgv {
namespace sfm {

// The smallest s > 0 at which the polynomial coefficients[0] + coefficients[1] s + .. (coefficients[0] > 0) changes its sign;
// infinite if there is none below 1e50. A multiple zero without a change of sign does not count.
double firstSignChange(const std::vector<double>& coefficients);

}  // namespace sfm
}  // namespace hybridgv

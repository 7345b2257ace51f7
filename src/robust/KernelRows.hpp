// What the kernels tell of every correspondence by itself.
#pragma once

#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/ParameterMatrix.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

// The columns of Kernels::rayRows and Kernels::pointRows, each of which has the padded size.
class KernelRows {
 public:
  KernelRows(std::size_t size, std::size_t columns) : length_(correspondences::padded(size)), values_(columns * length_) {}
  double* data() { return values_.data(); }
  double operator()(std::size_t row, std::size_t column) const { return values_[column * length_ + row]; }
  double weight(std::size_t row) const { return (*this)(row, 0); }
  // By the parameters.
  FullParameterVector derivatives(std::size_t row, std::size_t firstColumn) const {
    FullParameterVector result;
    for (Eigen::Index k = 0; k < result.size(); ++k) result[k] = (*this)(row, firstColumn + static_cast<std::size_t>(k));
    return result;
  }

 private:
  std::size_t length_;
  std::vector<double> values_;
};

// The first columns of the derivatives of an error, and of a point's second one.
constexpr std::size_t kFirstDerivative = 1, kSecondDerivative = 1 + correspondences::kMostParameters;

}  // namespace robust
}  // namespace hybridgv

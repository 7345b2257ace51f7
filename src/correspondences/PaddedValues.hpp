// A number per correspondence, for the kernels to read beside the arrays' columns.
#pragma once

#include <utility>
#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"

namespace hybridgv {
namespace correspondences {

class PaddedValues {
 public:
  // None: the pointer is null.
  PaddedValues() = default;
  // Entries beyond the end get the value `padding`.
  PaddedValues(std::vector<double> values, double padding) : size_(values.size()), values_(std::move(values)) {
    values_.resize(padded(size_), padding);
  }

  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const { return values_[i]; }
  // Valid as long as this object.
  PaddedPointer pointer() const { return PaddedPointer(values_.empty() ? nullptr : values_.data()); }

 private:
  std::size_t size_ = 0;
  std::vector<double> values_;
};

}  // namespace correspondences
}  // namespace hybridgv

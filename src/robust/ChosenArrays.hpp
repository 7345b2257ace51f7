// Some of the correspondences as arrays of their own.
#pragma once

#include <deque>
#include <vector>

#include "correspondences/PaddedValues.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

using Members = std::vector<std::size_t>;

// The arrays are valid until the next ones of the same kind are asked for.
class ChosenArrays {
 public:
  PointArrays points(const PointArrays& all, const Members& members);
  RayArrays rays(const RayArrays& all, const Members& members);

 private:
  // Copies of some entries of columns. The copies are used one after the other.
  class Columns {
   public:
    void clear() { used_ = 0; }
    const double* pick(const double* column, const Members& members);

   private:
    std::deque<std::vector<double>> buffers_;
    std::size_t used_ = 0;
  };

  Columns points_, rays_;
  correspondences::PaddedValues narrowing_;
};

}  // namespace robust
}  // namespace hybridgv

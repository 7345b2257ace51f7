// Correspondences by groups, as arrays of their own.
#pragma once

#include <vector>

#include "correspondences/PaddedValues.hpp"
#include "correspondences/arrayParts.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

// `Arrays`: PointArrays or RayArrays.
template <class Arrays>
class GroupedArrays {
 public:
  // groups[i]: the group of entry i, 0 .. count-1. All columns are copied, in one go through each.
  void set(const Arrays& all, const int* groups, std::size_t count);
  // The entries of a group, in their order. Valid until others are set.
  Arrays of(std::size_t group) const;

 private:
  void place(const int* groups, std::size_t size, std::size_t count);

  Arrays arrays_{};  // all groups, one after the other, each padded
  std::vector<std::size_t> begins_, sizes_, places_;
  std::vector<double> values_;
  correspondences::PaddedValues narrowing_;
};

}  // namespace robust
}  // namespace hybridgv

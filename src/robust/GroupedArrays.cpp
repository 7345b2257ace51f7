#include "robust/GroupedArrays.hpp"

#include <utility>

namespace hybridgv {
namespace robust {
namespace {

using correspondences::PaddedValues;

void copyNarrowing(const PointArrays&, const std::vector<std::size_t>&, PointArrays&, PaddedValues&) {}

void copyNarrowing(const RayArrays& from, const std::vector<std::size_t>& places, RayArrays& to, PaddedValues& values) {
  values = PaddedValues();
  if (from.narrowing) {
    std::vector<double> copies(to.size, 1);
    for (std::size_t i = 0; i < from.size; ++i) copies[places[i]] = *(from.narrowing + i);
    values = PaddedValues(std::move(copies), 1);
  }
  to.narrowing = values.pointer();
}

}  // namespace

template <class Arrays>
void GroupedArrays<Arrays>::set(const Arrays& all, const int* groups, std::size_t count) {
  place(groups, all.size, count);
  arrays_ = all;
  const auto columns = correspondences::columnsOf(arrays_);
  arrays_.size = count > 0 ? begins_.back() + correspondences::padded(sizes_.back()) : 0;
  values_.assign(columns.size() * arrays_.size, 0);
  double* to = values_.data();
  for (const double** column : columns) {
    const double* source = *column;
    for (std::size_t i = 0; i < all.size; ++i) to[places_[i]] = source[i];
    *column = to;
    to += arrays_.size;
  }
  copyNarrowing(all, places_, arrays_, narrowing_);
}

template <class Arrays>
void GroupedArrays<Arrays>::place(const int* groups, std::size_t size, std::size_t count) {
  sizes_.assign(count, 0);
  for (std::size_t i = 0; i < size; ++i) ++sizes_[static_cast<std::size_t>(groups[i])];
  begins_.assign(count, 0);
  for (std::size_t g = 1; g < count; ++g) begins_[g] = begins_[g - 1] + correspondences::padded(sizes_[g - 1]);
  std::vector<std::size_t> next = begins_;
  places_.resize(size);
  for (std::size_t i = 0; i < size; ++i) places_[i] = next[static_cast<std::size_t>(groups[i])]++;
}

template <class Arrays>
Arrays GroupedArrays<Arrays>::of(std::size_t group) const {
  return correspondences::part(arrays_, begins_[group], begins_[group] + sizes_[group]);
}

template class GroupedArrays<RayArrays>;
template class GroupedArrays<PointArrays>;

}  // namespace robust
}  // namespace hybridgv

#include "robust/ChosenArrays.hpp"

#include <algorithm>
#include <utility>

#include "correspondences/arrayParts.hpp"

namespace hybridgv {
namespace robust {

using correspondences::PaddedValues;

const double* ChosenArrays::Columns::pick(const double* column, const Members& members) {
  if (used_ == buffers_.size()) buffers_.emplace_back();
  std::vector<double>& buffer = buffers_[used_++];
  buffer.assign(correspondences::padded(members.size()), 0);
  std::transform(members.begin(), members.end(), buffer.begin(), [=](std::size_t i) { return column[i]; });
  return buffer.data();
}

PointArrays ChosenArrays::points(const PointArrays& all, const Members& members) {
  points_.clear();
  PointArrays chosen = all;
  chosen.size = members.size();
  for (const double** column : correspondences::columnsOf(chosen)) *column = points_.pick(*column, members);
  return chosen;
}

RayArrays ChosenArrays::rays(const RayArrays& all, const Members& members) {
  rays_.clear();
  RayArrays chosen = all;
  chosen.size = members.size();
  for (const double** column : correspondences::columnsOf(chosen)) *column = rays_.pick(*column, members);
  narrowing_ = PaddedValues();
  if (all.narrowing) {
    std::vector<double> values;
    for (const std::size_t i : members) values.push_back(*(all.narrowing + i));
    narrowing_ = PaddedValues(std::move(values), 1);
  }
  chosen.narrowing = narrowing_.pointer();
  return chosen;
}

}  // namespace robust
}  // namespace hybridgv

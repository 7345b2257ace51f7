#include "robust/ChosenArrays.hpp"

#include <algorithm>
#include <utility>

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
  for (const double* PointArrays::*column : {&PointArrays::u, &PointArrays::v, &PointArrays::x, &PointArrays::y, &PointArrays::z})
    chosen.*column = points_.pick(all.*column, members);
  return chosen;
}

RayArrays ChosenArrays::rays(const RayArrays& all, const Members& members) {
  rays_.clear();
  RayArrays chosen = all;
  chosen.size = members.size();
  for (const double* RayArrays::*column :
       {&RayArrays::u, &RayArrays::v, &RayArrays::cx, &RayArrays::cy, &RayArrays::cz, &RayArrays::dx, &RayArrays::dy,
        &RayArrays::dz, &RayArrays::ax, &RayArrays::ay, &RayArrays::az, &RayArrays::squaredPixel, &RayArrays::isUnknown})
    chosen.*column = rays_.pick(all.*column, members);
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

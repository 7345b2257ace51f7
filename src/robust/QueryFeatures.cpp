#include "robust/QueryFeatures.hpp"

#include <utility>

#include "robust/numberEqual.hpp"

namespace hybridgv {
namespace robust {
namespace {

using correspondences::CorrespondenceArrays;

// Correspondences with the same number are where the first of them is.
void moveToFirst(const CorrespondenceArrays& arrays, std::vector<ImagePoint>& points) {
  std::vector<Key> keys;
  std::vector<std::size_t> places;  // of the correspondences with a number
  const auto add = [&](const std::vector<int>& features, std::size_t begin) {
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (features[i] < 0) continue;
      keys.push_back(keyOf(std::array<int, 1>{features[i]}));
      places.push_back(begin + i);
    }
  };
  add(arrays.rayFeatures(), 0);
  add(arrays.pointFeatures(), arrays.rays().size());
  const Numbering numbering = numberEqual(keys);
  std::vector<ImagePoint> firsts;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto number = static_cast<std::size_t>(numbering.numbers[k]);
    if (number == firsts.size()) firsts.push_back(points[places[k]]);
    points[places[k]] = firsts[number];
  }
}

}  // namespace

std::vector<ImagePoint> imagePoints(const CorrespondenceArrays& arrays) {
  const correspondences::RayArrays rays = arrays.rayArrays();
  const correspondences::PointArrays points = arrays.pointArrays();
  std::vector<ImagePoint> result(rays.size + points.size);
  for (std::size_t i = 0; i < rays.size; ++i) result[i] = {rays.u[i], rays.v[i]};
  for (std::size_t i = 0; i < points.size; ++i) result[rays.size + i] = {points.u[i], points.v[i]};
  return result;
}

QueryFeatures::QueryFeatures(const CorrespondenceArrays& arrays) : rays_(arrays.rays().size()) {
  std::vector<ImagePoint> points = imagePoints(arrays);
  if (!arrays.rayFeatures().empty() || !arrays.pointFeatures().empty()) moveToFirst(arrays, points);
  std::vector<Key> keys;
  keys.reserve(points.size());
  for (const ImagePoint& point : points) keys.push_back(keyOf(std::array<double, 2>{point.u, point.v}));
  Numbering numbering = numberEqual(keys);
  numbers_ = std::move(numbering.numbers);
  if (static_cast<std::size_t>(numbering.count) == points.size()) {
    places_ = std::move(points);
    return;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (static_cast<std::size_t>(numbers_[i]) == places_.size()) places_.push_back(points[i]);
}

}  // namespace robust
}  // namespace hybridgv

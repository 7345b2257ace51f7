#include "robust/Evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hybridgv {
namespace robust {
namespace {

// Size of a cell [px].
constexpr double kCell = 2;

Key cellOf(const ImagePoint& place) {
  return keyOf(std::array<double, 2>{std::floor(place.u / kCell), std::floor(place.v / kCell)});
}

// As floats, so that a rounding error of the rig's frame does not make two items of one.
Key itemOf(int camera, const Eigen::Vector3d& x) {
  return keyOf(std::array<float, 4>{static_cast<float>(camera), static_cast<float>(x[0]), static_cast<float>(x[1]),
                                    static_cast<float>(x[2])});
}

// Counts different numbers; a number that was seen before, or is to be ignored, does not count.
class DifferentNumbers {
 public:
  explicit DifferentNumbers(int numbers) : seen_(static_cast<std::size_t>(numbers), 0) {}
  void ignore(int number) { seen_[static_cast<std::size_t>(number)] = 1; }
  void add(int number) {
    char& seen = seen_[static_cast<std::size_t>(number)];
    count_ += seen == 0;
    seen = 1;
  }
  int count() const { return count_; }

 private:
  std::vector<char> seen_;
  int count_ = 0;
};

}  // namespace

Evidence::Evidence(const correspondences::CorrespondenceArrays& arrays) : Evidence(arrays, QueryFeatures(arrays)) {}

Evidence::Evidence(const correspondences::CorrespondenceArrays& arrays, const QueryFeatures& features) {
  std::vector<Key> rays, points;
  rays.reserve(arrays.rays().size());
  points.reserve(arrays.points().size());
  for (const correspondences::RayMatch& ray : arrays.rays()) {
    rays.push_back(itemOf(ray.camera, ray.direction));
    cameras_.push_back(ray.camera);
  }
  for (const correspondences::PointMatch& match : arrays.points()) points.push_back(itemOf(0, match.point));
  setItems(rays, rays_.item, rayItems_);
  setItems(points, points_.item, pointItems_);
  setFeatures(features);
}

void Evidence::setItems(const std::vector<Key>& keys, std::vector<int>& items, int& count) {
  Numbering numbering = numberEqual(keys);
  items = std::move(numbering.numbers);
  count = numbering.count;
}

// Features in one cell are taken as one.
void Evidence::setFeatures(const QueryFeatures& features) {
  std::vector<Key> keys;
  keys.reserve(features.places().size());
  for (const ImagePoint& place : features.places()) keys.push_back(cellOf(place));
  const Numbering cells = numberEqual(keys);
  features_ = cells.count;
  const auto cellOfFeature = [&](int feature) { return cells.numbers[static_cast<std::size_t>(feature)]; };
  rays_.feature.resize(rays_.item.size());
  points_.feature.resize(points_.item.size());
  for (std::size_t i = 0; i < rays_.feature.size(); ++i) rays_.feature[i] = cellOfFeature(features.ofRay(i));
  for (std::size_t i = 0; i < points_.feature.size(); ++i) points_.feature[i] = cellOfFeature(features.ofPoint(i));
}

Support Evidence::support(const InlierMasks& inliers) const {
  return support(inliers, [](std::size_t) { return true; });
}

Support Evidence::supportWithoutCamera(const InlierMasks& inliers, int camera) const {
  return support(inliers, [&](std::size_t ray) { return cameras_[ray] != camera; });
}

// `counts`: of a ray, whether it is there at all.
template <class Counts>
Support Evidence::support(const InlierMasks& inliers, const Counts& counts) const {
  DifferentNumbers pointFeatures(features_), pointItems(pointItems_), allPointFeatures(features_);
  DifferentNumbers rayFeatures(features_), rayItems(rayItems_), allRayFeatures(features_), allRayItems(rayItems_);
  for (std::size_t i = 0; i < points_.item.size(); ++i) {
    allPointFeatures.add(points_.feature[i]);
    if (inliers.points[i] == 0) continue;
    pointFeatures.add(points_.feature[i]);
    pointItems.add(points_.item[i]);
    rayFeatures.ignore(points_.feature[i]);
    allRayFeatures.ignore(points_.feature[i]);
  }
  for (std::size_t i = 0; i < rays_.item.size(); ++i) {
    if (!counts(i)) continue;
    allRayFeatures.add(rays_.feature[i]);
    allRayItems.add(rays_.item[i]);
    if (inliers.rays[i] == 0) continue;
    rayFeatures.add(rays_.feature[i]);
    rayItems.add(rays_.item[i]);
  }
  return {std::min(pointFeatures.count(), pointItems.count()), std::min(allPointFeatures.count(), pointItems_),
          std::min(rayFeatures.count(), rayItems.count()), std::min(allRayFeatures.count(), allRayItems.count())};
}

bool Evidence::isSamePoint(std::size_t i, std::size_t j) const {
  return points_.item[i] == points_.item[j] || points_.feature[i] == points_.feature[j];
}

bool Evidence::isSameRay(std::size_t i, std::size_t j) const {
  return rays_.item[i] == rays_.item[j] || rays_.feature[i] == rays_.feature[j];
}

}  // namespace robust
}  // namespace hybridgv

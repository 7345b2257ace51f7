#include "robust/Evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "math/RandomStream.hpp"

namespace hybridgv {
namespace robust {
namespace {

// Image points in one cell of this size [px] are taken as one feature.
constexpr double kCell = 2;

using Key = std::uint64_t;

// A key that is equal for equal numbers, and as good as never for others.
template <class Number, std::size_t N>
Key keyOf(const std::array<Number, N>& numbers) {
  Key key = 0;
  for (const Number number : numbers) {
    const double value = static_cast<double>(number) + 0.0;  // -0 is 0
    Key bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    key = math::RandomStream(key, bits).next();
  }
  return key;
}

// Equal keys get equal numbers 0, 1, ..; returns how many there are.
int number(const std::vector<Key>& keys, std::vector<int>& numbers) {
  // A hash table with linear probing, at most half full, of the places where a key was first seen. The keys are hashes already.
  constexpr std::size_t kFree = ~std::size_t{0};
  std::size_t size = 16;
  while (size < 2 * keys.size()) size *= 2;
  std::vector<std::size_t> slots(size, kFree);
  numbers.resize(keys.size());
  int count = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::size_t slot = static_cast<std::size_t>(keys[i]) & (size - 1);
    while (slots[slot] != kFree && keys[slots[slot]] != keys[i]) slot = (slot + 1) & (size - 1);
    const bool isNew = slots[slot] == kFree;
    if (isNew) slots[slot] = i;
    numbers[i] = isNew ? count : numbers[slots[slot]];
    count += isNew;
  }
  return count;
}

Key cellOf(double u, double v) { return keyOf(std::array<double, 2>{std::floor(u / kCell), std::floor(v / kCell)}); }

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

Evidence::Evidence(const correspondences::CorrespondenceArrays& arrays) {
  std::vector<Key> cells, rays, points;
  cells.reserve(arrays.rays().size() + arrays.points().size());
  rays.reserve(arrays.rays().size());
  points.reserve(arrays.points().size());
  for (const correspondences::RayMatch& ray : arrays.rays()) {
    cells.push_back(cellOf(ray.u, ray.v));
    rays.push_back(itemOf(ray.camera, ray.direction));
    cameras_.push_back(ray.camera);
  }
  for (const correspondences::PointMatch& match : arrays.points()) {
    cells.push_back(cellOf(match.u, match.v));
    points.push_back(itemOf(0, match.point));
  }
  std::vector<int> features;
  features_ = number(cells, features);
  rays_.feature.assign(features.begin(), features.begin() + static_cast<std::ptrdiff_t>(rays.size()));
  points_.feature.assign(features.begin() + static_cast<std::ptrdiff_t>(rays.size()), features.end());
  rayItems_ = number(rays, rays_.item);
  pointItems_ = number(points, points_.item);
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

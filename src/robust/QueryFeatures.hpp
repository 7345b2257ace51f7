// Which correspondences come from the same feature of the query.
#pragma once

#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"

namespace hybridgv {
namespace robust {

struct ImagePoint {
  double u, v;
};

// Of all correspondences, first those of the rays.
std::vector<ImagePoint> imagePoints(const correspondences::CorrespondenceArrays& arrays);

// One feature (keypoint) may be matched in several map images, or listed twice: its correspondences share its error. Those to which the
// adapter gives the same number come from one feature, wherever their image points are, and so do those with equal image points.
class QueryFeatures {
 public:
  explicit QueryFeatures(const correspondences::CorrespondenceArrays& arrays);

  // 0, 1, .., common to both kinds.
  int ofRay(std::size_t i) const { return numbers_[i]; }
  int ofPoint(std::size_t i) const { return numbers_[rays_ + i]; }
  // Of all correspondences, first those of the rays.
  const std::vector<int>& numbers() const { return numbers_; }
  // Where each feature is, by the first of its correspondences.
  const std::vector<ImagePoint>& places() const { return places_; }
  // Whether any two correspondences come from the same.
  bool areShared() const { return places_.size() < numbers_.size(); }

 private:
  std::size_t rays_;
  std::vector<int> numbers_;
  std::vector<ImagePoint> places_;
};

}  // namespace robust
}  // namespace hybridgv

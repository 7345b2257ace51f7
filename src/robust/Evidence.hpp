// Which correspondences are different evidence for a pose.
#pragma once

#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/PerKind.hpp"
#include "robust/QueryFeatures.hpp"
#include "robust/numberEqual.hpp"

namespace hybridgv {
namespace robust {

// Numbers of inliers and of correspondences of both kinds.
struct Support {
  int points = 0, allPoints = 0, rays = 0, allRays = 0;
};

// Not 0 for an inlier.
using InlierMasks = PerKind<std::vector<char>>;

// A match that is listed twice, the images of one wrong feature in several map images, or a point together with the rays of its own
// track agree with a wrong pose all at once or not at all: they are one accident, not several. So the support of a pose is counted
// in *different* correspondences: of a kind it is the number of different features of the query or of different items of the rig
// (points, or rays) among its inliers, whichever is smaller. A feature that an inlier point has used does not count for rays. Features
// that are very near to each other count as one.
class Evidence {
 public:
  explicit Evidence(const correspondences::CorrespondenceArrays& arrays);
  Evidence(const correspondences::CorrespondenceArrays& arrays, const QueryFeatures& features);

  Support support(const InlierMasks& inliers) const;
  // The same without the rays of one camera.
  Support supportWithoutCamera(const InlierMasks& inliers, int camera) const;
  // Are two points (two rays) the same evidence?
  bool isSamePoint(std::size_t i, std::size_t j) const;
  bool isSameRay(std::size_t i, std::size_t j) const;

 private:
  // Numbers 0, 1, .. of the features (common to both kinds) and of the items of each correspondence.
  struct Groups {
    std::vector<int> feature, item;
  };
  void setItems(const std::vector<Key>& keys, std::vector<int>& items, int& count);
  void setFeatures(const QueryFeatures& features);
  template <class Counts>
  Support support(const InlierMasks& inliers, const Counts& counts) const;

  Groups rays_, points_;
  std::vector<int> cameras_;  // of the rays
  int features_ = 0, rayItems_ = 0, pointItems_ = 0;
};

}  // namespace robust
}  // namespace hybridgv

// How plausible the depths of rays are, by those of the scene.
#pragma once

#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/ErrorMixture.hpp"
#include "robust/PerKind.hpp"
#include "robust/QueryPose.hpp"

namespace hybridgv {
namespace robust {

// The log of a depth z in the query, of the inliers, has Student's distribution with 3 degrees of freedom about that of the points, z0:
//
//     g = min(1, z / z0) / (1 + t^2/3)^2,   t = (log z - log z0) / w.
//
// A wrong ray that agrees with a pose by chance does so anywhere along its epipolar line, where the depth changes by z/z0 as much as at
// z0 for the same length. No ray is more plausible than one at z0: the full density would be largest where the query is among the rig's
// cameras, and draw it there.
class DepthPrior {
 public:
  // From the inliers, whose errors are below the boundaries of the noise. A kind without errors has none. `arrays` must outlive it.
  DepthPrior(const correspondences::CorrespondenceArrays& arrays, const QueryPose& pose,
             const PerKind<std::vector<double>>& squaredErrors, const PerKind<ErrorMixture>& noise);

  // g of a ray; 1 if there are no inliers.
  double plausibility(std::size_t ray) const;

 private:
  double logDepth(std::size_t ray) const;

  const correspondences::CorrespondenceArrays& arrays_;
  QueryPose pose_;
  double deviation_;
  double logMode_ = 0, width_ = 0;
};

}  // namespace robust
}  // namespace hybridgv

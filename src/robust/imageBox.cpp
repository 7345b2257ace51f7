#include "robust/imageBox.hpp"

namespace hybridgv {
namespace robust {

RobustBox::Size imageBox(const correspondences::CorrespondenceArrays& arrays) {
  RobustBox box;
  for (const correspondences::RayMatch& match : arrays.rays()) box.add(match.u, match.v);
  for (const correspondences::PointMatch& match : arrays.points()) box.add(match.u, match.v);
  return box.size();
}

}  // namespace robust
}  // namespace hybridgv

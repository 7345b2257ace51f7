#include "robust/toPlain.hpp"

namespace hybridgv {
namespace robust {

PlainPose toPlain(const QueryPose& pose) {
  PlainPose plain;
  for (int k = 0; k < 3; ++k) {
    plain.r1[k] = pose.rotation(k, 0);
    plain.r2[k] = pose.rotation(k, 1);
    plain.r3[k] = pose.rotation(k, 2);
    plain.position[k] = pose.position[k];
  }
  plain.focalLength = pose.focalLength;
  plain.distortion = pose.distortion;
  return plain;
}

}  // namespace robust
}  // namespace hybridgv

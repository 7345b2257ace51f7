// The rig camera's side of a 2D-2D correspondence, as the Sampson error needs it.
#pragma once

#include <Eigen/Core>

namespace hybridgv {
namespace correspondences {

// A viewing ray centre + beta direction in the rig's frame, and the normal of the plane in which the map's image is measured: the
// sum of the squares of a vector's components along the image axes is |n|^2 - (imageNormal . n)^2.
struct EpipolarRay {
  Eigen::Vector3d direction;    // depth 1 in the rig camera (a pinhole image), or length 1 (tangent plane of the sphere)
  Eigen::Vector3d imageNormal;  // unit length
};

// A bearing vector with z > 0 has a pixel in the pinhole image, whose normal is the optical axis; any other is measured in the
// tangent plane of the unit sphere.
inline EpipolarRay makeEpipolarRay(const Eigen::Vector3d& bearingVector, const Eigen::Matrix3d& camRotation) {
  if (bearingVector[2] > 0) return {camRotation * (bearingVector / bearingVector[2]), camRotation.col(2)};
  const Eigen::Vector3d direction = (camRotation * bearingVector).normalized();
  return {direction, direction};
}

}  // namespace correspondences
}  // namespace hybridgv

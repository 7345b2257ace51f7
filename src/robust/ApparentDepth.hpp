// Where a ray seems to meet the viewing ray of its image point.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "correspondences/Correspondence.hpp"
#include "robust/QueryPose.hpp"

namespace hybridgv {
namespace robust {

// In a pinhole image, the ray's point at the depth z in the query is seen at q + b / z, on its epipolar line. So the place on the line
// that is nearest to the image point tells 1/z, to the accuracy of 1/|b| for an error of 1 px.
struct ApparentDepth {
  double inverse = 0;   // 1/z; negative: the nearest place is beyond infinity
  double perPixel = 0;  // 1/|b|; infinite where the query is in the rig camera
};

ApparentDepth apparentDepth(const correspondences::RayMatch& ray, const QueryPose& pose);

// Where that is in the frame of the rays, and how far 1 px along the line moves it there.
struct ApparentPlace {
  Eigen::Vector3d position, perPixel;
};

// None behind the camera, at infinity, or where the query is in the rig camera.
std::optional<ApparentPlace> apparentPlace(const correspondences::RayMatch& ray, const QueryPose& pose);

// The image point moved along its epipolar line, as the point on the ray moves to another inverse depth. None if it is not seen there.
std::optional<Eigen::Vector2d> movedToDepth(const correspondences::RayMatch& ray, const QueryPose& pose, double inverse);

}  // namespace robust
}  // namespace hybridgv

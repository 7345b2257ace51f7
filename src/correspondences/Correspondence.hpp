// A correspondence between the query and the rig as plain data.
#pragma once

#include <Eigen/Core>

namespace hybridgv {
namespace correspondences {

// A 2D-2D correspondence: the query's image point (u, v) and the viewing ray centre + beta direction in the rig's frame.
// Rays with equal `camera` have the same centre.
struct RayMatch {
  double u, v;
  Eigen::Vector3d centre;
  Eigen::Vector3d direction;  // unit length
  int camera;
};

// A 2D-3D correspondence: the query's image point (u, v) and a point in the rig's frame.
struct PointMatch {
  double u, v;
  Eigen::Vector3d point;
};

}  // namespace correspondences
}  // namespace hybridgv

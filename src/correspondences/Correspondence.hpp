// A correspondence between the query and the rig as plain data.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "correspondences/EpipolarRay.hpp"

namespace hybridgv {
namespace correspondences {

// A 2D-2D correspondence: the query's image point (u, v) and the viewing ray centre + beta direction in the rig's frame.
// Of the rays that are solved or drawn together, those with equal `camera` have the same centre, and the others have not.
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

// Where a ray is seen in its map image: coordinates for focal length 1 (in the tangent plane of the sphere, the origin, if there
// is no pinhole image), and that image's focal length, 0 if unknown.
struct MapImagePoint {
  double x, y, focalLength;
};

// All that is known of a 2D-2D correspondence: what a solver takes, and what the Sampson error needs beside it.
struct RigRay {
  RayMatch match;
  EpipolarRay epipolar;
  MapImagePoint mapImagePoint;
};

// Correspondences of both kinds, in the rig's frame and unit.
struct Correspondences {
  std::vector<RigRay> rays;
  std::vector<PointMatch> points;
  std::vector<int> rayFeatures, pointFeatures;  // numbers of the query's features, negative if not known; empty if none is

  // Those with these indices, in their order.
  Correspondences subset(const std::vector<int>& rayIndices, const std::vector<int>& pointIndices) const;
};

}  // namespace correspondences
}  // namespace hybridgv

// The point that several calibrated images see.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hybridgv {
namespace sfm {

// An undistorted image point of a camera with known pose: (u, v) = focalLength * (x/z, y/z), (x, y, z) = rotation^T (X -
// position).
struct View {
  Eigen::Matrix3d rotation;  // camera -> model
  Eigen::Vector3d position;
  double focalLength, u, v;  // [px]

  Eigen::Vector3d direction() const;  // of the viewing ray in the camera's frame, unit length
};

struct Triangulation {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  bool isInFront = false;   // finite, and in front of every camera
  double largestError = 0;  // of the reprojections [px], if isInFront
};

// Minimizes the sum of squared reprojection errors of two or more views: Gauss-Newton from the point nearest to all rays.
Triangulation triangulate(const std::vector<View>& views);

// Do the viewing rays of any two views meet at `minAngle` [rad] or a larger angle?
bool haveParallax(const std::vector<View>& views, double minAngle);

}  // namespace sfm
}  // namespace hybridgv

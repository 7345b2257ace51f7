// 1. One minimal solver: the pose and focal length of a query image from one 2D-2D and three 2D-3D correspondences (H13f).
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/hybrid_pose/methods.hpp>

#include <cstdio>

int main() {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  // The camera that we shall pretend not to know: it looks along +z of the rig's frame from (0.5, -0.2, -1), f = 900 px.
  const Vector3d position(0.5, -0.2, -1);
  const double focalLength = 900;
  const auto project = [&](const Vector3d& point) {
    const Vector3d y = point - position;
    return Vector3d(focalLength * y[0] / y[2], focalLength * y[1] / y[2], 1);
  };
  // What is known: three points of the map, and a rig camera at (2, 0, 0) that saw a fourth one, of unknown depth.
  const std::vector<Vector3d> points{{-1, -1, 6}, {1.5, -0.5, 5}, {0.3, 1.2, 7}};
  const Vector3d fourth(1, 0.5, 6), offset(2, 0, 0);
  const std::vector<Vector3d> imagePoints2d3d{project(points[0]), project(points[1]), project(points[2])};
  const std::vector<Vector3d> imagePoints2d2d{project(fourth)};

  // [readme]
  // Pixels are relative to the principal point; points, bearing vectors and offsets are those of the calibrated rig.
  const hybridgv::NoncentralHybridAdapter adapter(imagePoints2d2d, {fourth - offset}, {0}, {offset}, {Matrix3d::Identity()},
                                                  imagePoints2d3d, points);
  for (const hybridgv::FocalPose& pose : hybridgv::hybrid_pose::h13f(adapter))
    std::printf("focal length %8.3f px, position %7.4f %7.4f %7.4f\n", pose.focalLength, pose.position[0], pose.position[1],
                pose.position[2]);
  // [readme]
}

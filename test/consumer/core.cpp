// A program that uses the core alone: localizes an exact query by H13f.
#include <cmath>
#include <cstdio>
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/hybrid_pose/methods.hpp>

int main() {
  // A query at the rig's origin with focal length 800; the rig camera is at (2, 0, 0) and sees the point (0.5, -1, 6).
  const std::vector<Eigen::Vector3d> points{{-1, 1, 5}, {2, 0.5, 7}, {0.3, -1.5, 4}};
  const auto project = [](const Eigen::Vector3d& p) { return Eigen::Vector3d(800 * p[0] / p[2], 800 * p[1] / p[2], 1); };
  std::vector<Eigen::Vector3d> imagePoints;
  for (const Eigen::Vector3d& point : points) imagePoints.push_back(project(point));
  const Eigen::Vector3d seen(0.5, -1, 6), centre(2, 0, 0);
  const hybridgv::NoncentralHybridAdapter adapter({project(seen)}, {seen - centre}, {0}, {centre}, {Eigen::Matrix3d::Identity()},
                                                  imagePoints, points);
  for (const hybridgv::FocalPose& pose : hybridgv::hybrid_pose::h13f(adapter))
    if (std::abs(pose.focalLength - 800) < 1e-3 && pose.position.norm() < 1e-5)
      return std::printf("hybridgv %s: f = %.3f\n", hybridgv::version(), pose.focalLength), 0;
  return std::printf("the query was not found\n"), 1;
}

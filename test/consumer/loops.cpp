// A program that runs H13f in OpenGV's Ransac. It needs OpenGV's headers, not its library.
#include <cmath>
#include <cstdio>
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/sac_problems/hybrid_pose/HybridPoseSacProblem.hpp>
#include <opengv/sac/Ransac.hpp>

using hybridgv::sac_problems::hybrid_pose::HybridPoseSacProblem;

int main() {
  // A query at the rig's origin with focal length 800 and two rig cameras; every fifth 2D-3D correspondence is wrong.
  std::vector<Eigen::Vector3d> image2d2d, bearings, image2d3d, points;
  std::vector<int> cameras;
  const std::vector<Eigen::Vector3d> centres{{2, 0, 0}, {-1, 1, 0}};
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d point(2 * std::sin(1.7 * i), 2 * std::cos(2.9 * i), 6 + 2 * std::sin(4.1 * i));
    const Eigen::Vector3d image(800 * point[0] / point[2], 800 * point[1] / point[2], 1);
    if (i % 3 == 0) {
      image2d2d.push_back(image);
      cameras.push_back(i % 2);
      bearings.push_back(point - centres[static_cast<std::size_t>(i % 2)]);
    } else {
      image2d3d.push_back(i % 5 == 0 ? Eigen::Vector3d(-image) : image);
      points.push_back(point);
      if (i % 5 == 0) image2d3d.back()[2] = 1;
    }
  }
  const std::vector<Eigen::Matrix3d> rotations(2, Eigen::Matrix3d::Identity());
  const hybridgv::NoncentralHybridAdapter adapter(image2d2d, bearings, cameras, centres, rotations, image2d3d, points);

  opengv::sac::Ransac<HybridPoseSacProblem> ransac;
  ransac.sac_model_ = std::make_shared<HybridPoseSacProblem>(adapter, hybridgv::Solver::H13f, 2.0, 1.0);
  if (!ransac.computeModel()) return std::printf("no model\n"), 1;
  hybridgv::FocalPose pose;
  ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, pose);
  std::printf("f = %.3f, %zu of 30 are inliers\n", pose.focalLength, ransac.inliers_.size());
  return std::abs(pose.focalLength - 800) < 1e-2 && pose.position.norm() < 1e-4 ? 0 : 1;
}

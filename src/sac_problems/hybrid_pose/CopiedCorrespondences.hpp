// The correspondences of an adapter, copied once into plain arrays.
#pragma once

#include <vector>

#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

class CopiedCorrespondences : public hybridgv::hybrid_pose::HybridAdapterBase {
 public:
  // Throws std::invalid_argument for values that are not finite. Cameras with equal centres become one camera.
  explicit CopiedCorrespondences(const HybridAdapterBase& adapter);

  // What a minimal solver takes.
  const correspondences::RayMatch& ray(std::size_t index) const { return rays_[index]; }
  const correspondences::PointMatch& pointMatch(std::size_t index) const { return points_[index]; }

  std::size_t getNumberCorrespondences2d2d() const override { return rays_.size(); }
  Eigen::Vector3d getImagePoint2d2d(std::size_t index) const override { return {rays_[index].u, rays_[index].v, 1}; }
  Eigen::Vector3d getBearingVector(std::size_t index) const override { return bearingVectors_[index]; }
  int getCamIndex(std::size_t index) const override { return rays_[index].camera; }
  Eigen::Vector3d getCamOffset(std::size_t index) const override { return rays_[index].centre; }
  Eigen::Matrix3d getCamRotation(std::size_t index) const override { return camRotations_[index]; }
  double getRigFocalLength(std::size_t index) const override { return rigFocalLengths_[index]; }
  double getWeight2d2d(std::size_t index) const override { return weights2d2d_[index]; }

  std::size_t getNumberCorrespondences2d3d() const override { return points_.size(); }
  Eigen::Vector3d getImagePoint2d3d(std::size_t index) const override { return {points_[index].u, points_[index].v, 1}; }
  Eigen::Vector3d getPoint(std::size_t index) const override { return points_[index].point; }
  double getWeight2d3d(std::size_t index) const override { return weights2d3d_[index]; }

 private:
  std::vector<correspondences::RayMatch> rays_;
  std::vector<correspondences::PointMatch> points_;
  std::vector<Eigen::Vector3d> bearingVectors_;
  std::vector<Eigen::Matrix3d> camRotations_;
  std::vector<double> rigFocalLengths_, weights2d2d_, weights2d3d_;
};

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv

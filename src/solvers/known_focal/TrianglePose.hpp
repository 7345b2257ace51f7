// The pose from a triangle of points and their depths.
#pragma once

#include <Eigen/Core>

#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

// Three points and the bearings at which a camera of focal length 1 sees them. Lengths are measured in a unit in which the squares
// of the triangle's sides have the sum 1.
class TrianglePose {
 public:
  // False for points that are collinear or at one place.
  bool set(const PointMatch* points);

  const Eigen::Vector3d& bearing(int i) const { return bearings_[i]; }
  double squaredSide(int i, int j) const { return squaredSides_[i + j - 1]; }

  // Where the depths along the bearings are those of a congruent triangle, the pose; false if its image misses the image points,
  // relative to the largest image coordinate, by more than 1e-7.
  bool set(const Eigen::Vector3d& depths, FocalPose& pose) const;

 private:
  void setDuals();
  // From the depths' differences a, b of the other points to the first.
  bool setRotation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Eigen::Matrix3d& rotation) const;
  bool isMet(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& first) const;

  const PointMatch* points_;
  Eigen::Vector3d bearings_[3];
  double squaredSides_[3];  // of the pairs 01, 02, 12
  double unit_;
  Eigen::Vector3d fromFirst_[3];  // in that unit; [0] is zero
  Eigen::Matrix3d duals_;         // columns: the basis dual to both sides from the first point and their vector product
  bool isThin_;                   // so that rounding errors show in the duals
  double imageScale_;             // the largest image coordinate
};

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

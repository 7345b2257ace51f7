// The motions that five rays of one camera leave, up to scale.
#pragma once

#include <Eigen/Core>

#include "solvers/MinimalSolver.hpp"
#include "solvers/NullSpace.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

// Five rays from one centre and the image points of a query of focal length 1: at most ten motions for which they meet in front of both
// cameras. The query's frame is R times the rig's, and the centre lies in the direction t of the query's frame:
//
//     v . (t x R q) = 0   for every ray, v the bearing of its image point, q its direction.
class FivePoints {
 public:
  static constexpr int kRays = 5, kMaxMotions = 10;
  struct Motion {
    Eigen::Matrix3d R;
    Eigen::Vector3d t;
  };

  // `rays`: five. The camera's number is not used.
  explicit FivePoints(const RayMatch* rays);

  const Motion* begin() const { return motions_; }
  const Motion* end() const { return motions_ + count_; }

 private:
  // Of the essential matrices in the space of the basis; the smallest pivot of the elimination.
  double addMotionsOf(const PaddedMatrix (&basis)[4]);
  void addMotionsOf(const Eigen::Matrix3d& E);
  void addInFront(const Eigen::Matrix3d& R, const Eigen::Vector3d& t);
  void add(Motion motion);  // refined
  bool areInFront(const Motion& motion) const;
  bool refine(Motion& motion) const;

  const RayMatch* rays_;
  Eigen::Vector3d bearings_[kRays];
  double imageScale_;  // the largest image coordinate
  Motion motions_[kMaxMotions];
  int count_ = 0;
};

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

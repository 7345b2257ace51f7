// H51f [5]: five rays from one centre c and one point X. The line of sight from c to X is a sixth ray, and X then fixes the
// scale:  with the sixth image point p = (u, v, f), d = X - c and t = -R position,
//
//     X is seen at p:   p x (R d + kappa R b) = 0,   R c + t = kappa R b,   position = c - kappa b.
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "solvers/OneFocalFundamental.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace solvers {
namespace {

constexpr int kRays = 5;

// The pose of a motion with the given choice of its rotation, if all depths are positive.
bool completePose(const SixCorrespondences& six, const OneFocalMotion& motion, const Eigen::Matrix3d& rotation,
                  const Eigen::Vector3d& centre, double range, FocalPose& pose) {
  const double f = motion.focalLength;
  const Eigen::Vector3d p(six.u[kRays], six.v[kRays], f);
  const Eigen::Vector3d pb = p.cross(motion.baselineInQuery), point = range * (rotation * six.direction[kRays]);
  const double kappa = -pb.dot(p.cross(point)) / pb.squaredNorm();
  if (!std::isfinite(kappa)) return false;  // X lies on the line of the two centres
  if (!(point[2] + kappa * motion.baselineInQuery[2] > 0)) return false;
  const Eigen::Vector3d rigCentre = std::copysign(1.0, kappa) * motion.baselineInQuery;  // its direction
  for (int k = 0; k < kRays; ++k)
    if (!meetInFront(six.u[k], six.v[k], f, rotation * six.direction[k], rigCentre)) return false;
  pose.rotation = rotation.transpose();
  pose.position = centre - kappa * motion.baseline;
  pose.focalLength = f * six.imageScale;
  return true;
}

}  // namespace

int h51fOneCentre(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  SixCorrespondences six;
  for (int k = 0; k < kRays; ++k) six.u[k] = rays[k].u, six.v[k] = rays[k].v, six.direction[k] = rays[k].direction;
  const Eigen::Vector3d centre = rays[0].centre, toPoint = points[0].point - centre;
  const double range = toPoint.norm();
  if (!(range > 0)) return 0;
  six.u[kRays] = points[0].u, six.v[kRays] = points[0].v, six.direction[kRays] = toPoint / range;
  if (!six.normalise()) return 0;
  OneFocalMotion motions[kMaxOneFocalMotions];
  const int found = oneFocalFundamental(six, motions);
  int count = 0;
  for (int i = 0; i < found; ++i) {
    // Exactly one of the two rotations puts X in front of the query.
    if (completePose(six, motions[i], motions[i].rotation, centre, range, solutions[count]) ||
        completePose(six, motions[i], motions[i].otherRotation(), centre, range, solutions[count]))
      ++count;
  }
  return count;
}

}  // namespace solvers
}  // namespace hybridgv

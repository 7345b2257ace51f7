// H51f [5]: five rays from one centre c and one point X. The line of sight from c to X is a sixth ray, and X then fixes the
// length kappa of the baseline:  with the sixth image point p = (u, v, f) and d = X - c,
//
//     X is seen at p:   p x (R d + kappa R b) = 0,   position = c - kappa b.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "solvers/MinimalProblems.hpp"
#include "solvers/one_centre/OneFocalFundamental.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

int h51f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  constexpr int kRays = 5;
  const Eigen::Vector3d centre = rays[0].centre, toPoint = points[0].point - centre;
  const double range = toPoint.norm();
  if (!(range > 0)) return 0;
  SixCorrespondences six;
  for (int k = 0; k < kRays; ++k) six.set(k, rays[k].u, rays[k].v, rays[k].direction);
  six.set(kRays, points[0].u, points[0].v, toPoint / range);
  if (!six.normalize()) return 0;
  OneFocalMotion motions[kMaxOneFocalMotions];
  const int found = oneFocalFundamental(six, motions);
  int count = 0;
  for (int i = 0; i < found; ++i) {
    const OneFocalMotion& motion = motions[i];
    const Eigen::Vector3d p(six.u[kRays], six.v[kRays], motion.focalLength);
    const Eigen::Vector3d pb = p.cross(motion.baselineInQuery);
    const double kappa = -pb.dot(p.cross(motion.rotation * toPoint)) / pb.squaredNorm();
    if (!(kappa > 0) || !std::isfinite(kappa)) continue;
    solutions[count].rotation = motion.rotation.transpose();
    solutions[count].position = centre - kappa * motion.baseline;
    solutions[count].focalLength = motion.focalLength * six.imageScale;
    ++count;
  }
  return count;
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv

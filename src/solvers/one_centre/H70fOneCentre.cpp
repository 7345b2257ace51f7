// H70f [6+1]: six rays from one centre c give the pose up to the length kappa of the baseline b, and a ray q of another centre c7
// fixes it. With d = R^T (u, v, f), e = c7 - c and the query's centre at c - kappa b, the rays d and q are coplanar:
//
//     d.(q x e) - kappa b.(q x d) = 0.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "solvers/MinimalProblems.hpp"
#include "solvers/meetInFront.hpp"
#include "solvers/one_centre/SeventhRay.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

using Eigen::Vector3d;

bool poseThroughRay(const OneFocalMotion& motion, const Vector3d& centre, double imageScale, const RayMatch& ray,
                    FocalPose* pose) {
  const double u = ray.u / imageScale, v = ray.v / imageScale, f = motion.focalLength;
  const Vector3d d = motion.rotation.transpose() * Vector3d(u, v, f), e = ray.centre - centre;
  const double kappa = d.dot(ray.direction.cross(e)) / motion.baseline.dot(ray.direction.cross(d));
  if (!(kappa > 0) || !std::isfinite(kappa)) return false;
  const Vector3d toCentre = motion.rotation * (e + kappa * motion.baseline).normalized();
  if (!meetInFront(u, v, f, motion.rotation * ray.direction, toCentre)) return false;
  pose->rotation = motion.rotation.transpose();
  pose->position = centre - kappa * motion.baseline;
  pose->focalLength = f * imageScale;
  return true;
}

int h70f(const RayMatch* rays, const PointMatch* /*points*/, FocalPose* solutions) {
  SixCorrespondences six;
  if (!six.setRays(rays)) return 0;
  OneFocalMotion motions[kMaxOneFocalMotions];
  const int found = oneFocalFundamental(six, motions);
  int count = 0;
  for (int i = 0; i < found; ++i)
    count += poseThroughRay(motions[i], rays[0].centre, six.imageScale, rays[kSix], &solutions[count]);
  return count;
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv

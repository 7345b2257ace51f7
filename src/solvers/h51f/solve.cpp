#include "solvers/h51f/solve.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solvers/h51f/Reduction.hpp"
#include "solvers/h51f/StartSystems.hpp"
#include "solvers/meetInFront.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using Eigen::Vector3d;

// Relative to the image scale: the distance of image points from the images of their rays, and the focal length, below which
// image points at the principal point make spurious solutions.
constexpr double kLargestResidual = 1e-7, kSmallestFocalLength = 1e-4;

// Is the ray seen at its image point, in front of both cameras?
static bool agrees(const FocalPose& pose, const RayMatch& ray, double imageScale) {
  const double f = pose.focalLength;
  const Vector3d direction = pose.rotation.transpose() * ray.direction;
  const Vector3d centre = pose.rotation.transpose() * (ray.centre - pose.position);
  const Vector3d normal = direction.cross(centre), line(normal[0], normal[1], normal[2] * f);  // line.(u, v, 1) = 0
  const double residual = std::abs(line.dot(Vector3d(ray.u, ray.v, 1)));
  return residual < kLargestResidual * imageScale * line.head<2>().norm() &&
         meetInFront(ray.u / imageScale, ray.v / imageScale, f / imageScale, direction, centre.normalized());
}

static Solution solutionAt(const math::Point<double, kUnknowns>& p) {
  return {{p.re[0], p.im[0]}, {p.re[1], p.im[1]}, {p.re[2], p.im[2]}, {p.re[3], p.im[3]}, {p.re[4], p.im[4]}};
}

int solve(math::SimdLevel level, const RayMatch* rays, const PointMatch& point, FocalPose* solutions, EndPoints* ends) {
  *ends = EndPoints();
  RayMatch arranged[kRays];
  const Sharing sharing = arrange(rays, point, arranged);
  Frame frame;
  if (!normalize(sharing, arranged, point, &frame)) return 0;
  const StartSystem& start = *caseOf(sharing).start;
  alignWith(start, arranged, point, &frame);
  Parameters target = parametersIn(frame, sharing, arranged, point);
  scaleRaysLike(start.parameters, &target);
  solvePaths(level, start, target, ends);
  int count = 0;
  for (int i = 0; i < ends->count; ++i) {
    const FocalPose pose = poseOf(solutionAt(ends->point[i]), frame, point);
    if (!(pose.focalLength > kSmallestFocalLength * frame.imageScale)) continue;
    if (std::all_of(rays, rays + kRays, [&](const RayMatch& ray) { return agrees(pose, ray, frame.imageScale); }))
      solutions[count++] = pose;
  }
  return count;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

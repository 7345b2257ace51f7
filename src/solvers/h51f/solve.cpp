#include "solvers/h51f/solve.hpp"

#include <algorithm>

#include "solvers/h51f/Reduction.hpp"
#include "solvers/h51f/StartSystems.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

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
  complex_rays::scaleRaysLike<kRays>(start.parameters, &target);
  solvePaths(level, start, target, ends);
  int count = 0;
  for (int i = 0; i < ends->count; ++i) {
    const FocalPose pose = poseOf(solutionAt(ends->point[i]), frame, point);
    if (!(pose.focalLength > complex_rays::kSmallestFocalLength * frame.imageScale)) continue;
    if (std::all_of(rays, rays + kRays, [&](const RayMatch& ray) { return complex_rays::agrees(pose, ray, frame.imageScale); }))
      solutions[count++] = pose;
  }
  return count;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

#include "solvers/h70f/solve.hpp"

#include <algorithm>

namespace hybridgv {
namespace solvers {
namespace h70f {

static Solution solutionAt(const math::Point<double, kUnknowns>& p) {
  const auto number = [&p](int k) { return std::complex<double>(p.re[k], p.im[k]); };
  return {number(0), number(1), number(2), number(3), number(4), number(5), number(6)};
}

int solve(math::SimdLevel level, const RayMatch* rays, const Groups& groups, FocalPose* solutions, EndPoints* ends) {
  *ends = EndPoints();
  const StartSystem& start = *caseOf(sharingOf(groups)).start;
  RayMatch arranged[kRays];
  arrange(rays, groups, start, arranged);
  Frame frame;
  if (!normalize(start.sharing, arranged, &frame)) return 0;
  solvePaths(level, start, alignWith(start, arranged, &frame), ends);
  int count = 0;
  for (int i = 0; i < ends->count; ++i) {
    const FocalPose pose = poseOf(solutionAt(ends->point[i]), frame);
    if (!(pose.focalLength > complex_rays::kSmallestFocalLength * frame.imageScale)) continue;
    const auto isSeen = [&](const RayMatch& ray) { return complex_rays::agrees(pose, ray, frame.imageScale); };
    if (std::all_of(rays, rays + kRays, isSeen)) solutions[count++] = pose;
  }
  return count;
}

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv

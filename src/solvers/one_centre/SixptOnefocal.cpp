// Six rays from one centre c: pose up to the length of the baseline, which is returned as 1.
#include <Eigen/Core>

#include "solvers/MinimalProblems.hpp"
#include "solvers/one_centre/OneFocalFundamental.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

int sixptOnefocal(const RayMatch* rays, const PointMatch* /*points*/, FocalPose* solutions) {
  SixCorrespondences six;
  if (!six.setRays(rays)) return 0;
  OneFocalMotion motions[kMaxOneFocalMotions];
  const int count = oneFocalFundamental(six, motions);
  for (int i = 0; i < count; ++i) {
    solutions[i].rotation = motions[i].rotation.transpose();
    solutions[i].position = rays[0].centre - motions[i].baseline;
    solutions[i].focalLength = motions[i].focalLength * six.imageScale;
  }
  return count;
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv

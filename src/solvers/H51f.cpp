// H51f: five rays and one point; the algorithm depends on which rays share a centre.
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace solvers {

int h51f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  for (int i = 1; i < 5; ++i)
    if (rays[i].camera != rays[0].camera && rays[i].centre != rays[0].centre) return 0;
  return h51fOneCentre(rays, points, solutions);
}

}  // namespace solvers
}  // namespace hybridgv

#include "hybridgv/hybrid_pose/methods.hpp"
#include "solvers/solvers.hpp"
namespace hybridgv {
namespace solvers {
int p4pf(const RayMatch*, const PointMatch*, FocalPose*) { return 0; }
int p35pf(const RayMatch*, const PointMatch*, FocalPose*) { return 0; }
int h13f(const RayMatch*, const PointMatch*, FocalPose*) { return 0; }
}  // namespace solvers
namespace hybrid_pose {
NonlinearResult optimize_nonlinear(const HybridAdapterBase&, const std::vector<std::vector<int>>&, const FocalPose& i) {
  NonlinearResult r;
  r.pose = i;
  return r;
}
NonlinearResult optimize_nonlinear(const HybridAdapterBase&, const FocalPose& i) {
  NonlinearResult r;
  r.pose = i;
  return r;
}
}  // namespace hybrid_pose
}  // namespace hybridgv

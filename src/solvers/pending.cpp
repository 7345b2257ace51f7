#include "hybridgv/hybrid_pose/methods.hpp"
namespace hybridgv {
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

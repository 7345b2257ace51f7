#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace sac {

HybridRansacResult hybridRansac(const hybrid_pose::HybridAdapterBase& adapter, const HybridRansacOptions& options) {
  options.check();
  HybridRansacResult result;
  result.inliers2d2d.resize(adapter.getNumberCorrespondences2d2d());
  result.inliers2d3d.resize(adapter.getNumberCorrespondences2d3d());
  return result;
}

}  // namespace sac
}  // namespace hybridgv

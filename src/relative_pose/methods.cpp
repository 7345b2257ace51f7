#include "hybridgv/relative_pose/methods.hpp"

#include "CheckArguments.hpp"
#include "hybrid_pose/solveSample.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace relative_pose {

FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  const hybrid_pose::Sample sample = hybrid_pose::readRays(6, adapter, indices);
  for (std::size_t i = 1; i < 6; ++i)
    if (sample.rays[i].camera != sample.rays[0].camera)
      throwInvalid("indices", "correspondences " + std::to_string(indices[0]) + " and " + std::to_string(indices[i]) +
                                  " belong to different rig cameras; sixpt_onefocal needs six rays of one camera");
  return sample.solve(&solvers::one_centre::sixptOnefocal, 9);
}
FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter) { return sixpt_onefocal(adapter, {0, 1, 2, 3, 4, 5}); }

}  // namespace relative_pose
}  // namespace hybridgv

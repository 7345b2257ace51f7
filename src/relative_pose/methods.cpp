#include "hybridgv/relative_pose/methods.hpp"

#include "CheckArguments.hpp"
#include "solvers/solveSample.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace relative_pose {

FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices) {
  checkIndices("indices", indices, 6, adapter.getNumberCorrespondences2d2d());
  for (std::size_t i = 1; i < 6; ++i)
    if (adapter.getCamIndex(static_cast<std::size_t>(indices[i])) != adapter.getCamIndex(static_cast<std::size_t>(indices[0])))
      throwInvalid("indices", "correspondences " + std::to_string(indices[0]) + " and " + std::to_string(indices[i]) +
                                  " belong to different rig cameras; sixpt_onefocal needs six rays of one camera");
  return solvers::solveSample(&solvers::sixptOnefocal, 6, 0, 9, adapter, {indices, {}});
}
FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter) { return sixpt_onefocal(adapter, {0, 1, 2, 3, 4, 5}); }

}  // namespace relative_pose
}  // namespace hybridgv

// Compiled several times, for different instruction sets; it holds constants only, so that linking the results is safe.
#include "Layout.hpp"

#include "hybridgv/adapters/NoncentralHybridAdapter.hpp"
#include "hybridgv/adapters/sfm/Camera.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/distortion.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace test {

template <class T>
constexpr LayoutEntry entry(const char* type) {
  static_assert(alignof(T) <= alignof(double), "exported types hold only members that Eigen never aligns");
  return {type, sizeof(T), alignof(T)};
}

#define HYBRIDGV_ENTRY(T) entry<T>(#T)
static constexpr LayoutEntry kEntries[] = {
    HYBRIDGV_ENTRY(CamFromWorld),
    HYBRIDGV_ENTRY(FocalPose),
    HYBRIDGV_ENTRY(FocalPoses),
    HYBRIDGV_ENTRY(NoncentralHybridAdapter),
    HYBRIDGV_ENTRY(SimpleRadial),
    HYBRIDGV_ENTRY(hybrid_pose::HybridAdapterBase),
    HYBRIDGV_ENTRY(hybrid_pose::NonlinearResult),
    HYBRIDGV_ENTRY(sac::HybridRansacOptions),
    HYBRIDGV_ENTRY(sac::HybridRansacResult),
    HYBRIDGV_ENTRY(sac::SolverPrior),
    HYBRIDGV_ENTRY(sac_problems::hybrid_pose::HybridProblemCore),
    HYBRIDGV_ENTRY(sfm::Camera),
    HYBRIDGV_ENTRY(sfm::FileError),
    HYBRIDGV_ENTRY(sfm::Image),
    HYBRIDGV_ENTRY(sfm::LocalizationProblem),
    HYBRIDGV_ENTRY(sfm::LocalizationProblemOptions),
    HYBRIDGV_ENTRY(sfm::Observation),
    HYBRIDGV_ENTRY(sfm::Point),
    HYBRIDGV_ENTRY(sfm::SparseModel),
    HYBRIDGV_ENTRY(sfm::TrackElement),
};

const Layout HYBRIDGV_LAYOUT = {kEntries, sizeof(kEntries) / sizeof(kEntries[0])};

}  // namespace test
}  // namespace hybridgv

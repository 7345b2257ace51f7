// Which of several poses in which a scene looks the same is the likeliest.
#pragma once

#include <optional>

#include "robust/LocalOptimizer.hpp"
#include "robust/LookAlikes.hpp"
#include "robust/PoseScorer.hpp"

namespace hybridgv {
namespace robust {

struct LikelierPose {
  FinalPose pose;
  std::optional<QueryPose> nearlyAsLikely;  // another one, of which the correspondences do not clearly say that it is wrong
};

// Of the pose, an optimum of the likelihood, and the optima that the others lead to. `scorer`, `estimated`: the optimizer's.
//
// Where the focal length is known, little speaks against the mirrored pose of a flat scene: an optimum of its own, which the search may well
// have found instead. (A focal length that such a scene determines leaves no doubt about the pose.)
LikelierPose likelierPose(const FinalPose& pose, const LookAlikes& others, const LocalOptimizer& optimizer,
                          const PoseScorer& scorer, Intrinsics estimated);

}  // namespace robust
}  // namespace hybridgv

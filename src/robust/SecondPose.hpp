// Another pose that the data of a search speak for.
#pragma once

#include <optional>

#include "robust/HybridSearch.hpp"

namespace hybridgv {
namespace robust {

// A second pose with more than this share of the best one's support leaves open which is right.
constexpr double kAsGood = 0.8;

struct SecondPose {
  QueryPose pose;
  double support = 0;  // what only this pose explains, over what only the best one does
};

// Searches among the correspondences that are no inliers of the best pose, after `finish`, if they are enough for a second one that
// is as good; samples of three miss it with a probability of at most 5 %. Only a pose that could be relied on without the best one counts.
std::optional<SecondPose> findSecondPose(const HybridSearch& search, const hybrid_pose::HybridAdapterBase& adapter,
                                         const sac::HybridRansacOptions& options, Clock::time_point start);

}  // namespace robust
}  // namespace hybridgv

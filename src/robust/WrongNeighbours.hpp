// What the image points of a point's neighbours say of accidents.
#pragma once

#include <cstddef>
#include <vector>

#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/Levels.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {

// A point and the neighbour in space with whose image point it is paired.
struct NeighbourPair {
  std::size_t point, neighbour;
};

// The share of pairs with an error below each threshold if neighbours' image points were accidents, which is what they are at a pose that
// takes one object for another. At the right pose a neighbour's image point is near because it is right; that says nothing. So only
// neighbours count that are no inliers themselves.
//
// Their image points are outside the circle of radius T around where the neighbour is seen. Where this covers a part o of the circle around
// where the point is seen, they are as much rarer in it. So the share is
//
//     (errors below T) / sum of (1 - o),   o = 2/pi (arccos x - x sqrt(1 - x^2)),   x = d / 2T,
//
// over these pairs, d the distance of the two centres. Where the sum is small, because all neighbours are nearer than T, the share of all
// pairs remains. `squaredErrors`: of each pair; `ofAll`: that share.
LevelShares sharesOfWrongNeighbours(const correspondences::CorrespondenceArrays& arrays, const std::vector<NeighbourPair>& pairs,
                                    const std::vector<double>& squaredErrors, const PlainPose& pose, double maxReprojectionError,
                                    const LevelShares& ofAll);

}  // namespace robust
}  // namespace hybridgv

// The other poses in which a flat or a thin object that is far away looks the same.
#pragma once

#include <vector>

#include "robust/PoseScorer.hpp"

namespace hybridgv {
namespace robust {

// From far away, a plane with the normal n looks the same if the depths of its points are mirrored at its centre c, which the query sees in
// the direction d: where it is turned by Q = (I - 2 d d^T) (I - 2 n n^T), about the centre. So the query that is turned by Q^T instead,
// with Q^T R and the position c + Q^T (t - c), agrees with all correspondences as far as perspective does not tell. (The other minimum of
// G. Schweighofer, A. Pinz, Robust pose estimation from a planar target, PAMI 2006.)
//
// What is so thin that it nearly is a line looks about the same in all turns about it, whether or not they are mirrored, too; every plane
// through the line then is as good as another.
struct LookAlikes {
  std::vector<QueryPose> mirrored;  // one at most
  std::vector<QueryPose> turned;    // by eighths of a turn; mirrored ones among them
};

// None if the scene at this pose is clearly not of that kind: its extents are those of the inlier points (and the inlier rays', if the points are
// few), and most of the inliers must have errors within the bounds at the other pose.
LookAlikes lookAlikes(const PoseScorer& scorer, const QueryPose& pose);

}  // namespace robust
}  // namespace hybridgv

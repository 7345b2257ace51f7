/// \file
/// \brief Minimal solver for 2D-2D correspondences with one calibrated camera, unknown focal length of the query.
#pragma once

#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace relative_pose {

/// Pose up to scale and focal length of the query from six 2D-2D correspondences with one rig camera.
///
/// Equation, for each of the six image points (u, v) and viewing rays q of the rig camera with centre c (rig frame):
///
///     lambda (u, v, f) = rotation^T (c + beta q - position),   lambda > 0, beta > 0.
///
/// It says nothing about the distance of the two centres: if (rotation, position, f) is a solution, so is every position on the
/// half line from c through it.
///
/// \param[in] adapter Correspondences; only the 2D-2D ones are read. Image points in pixels relative to the principal point (any
///                    scale), viewing rays in the rig's frame.
/// \param[in] indices At least six indices of 2D-2D correspondences of one rig camera; the first six are used. The overload
///                    without indices takes correspondences 0 .. 5.
/// \return At most 9 poses (1.6 on average for the data of a rig camera and a query that see the same scene), each with
///         |position - c| = 1 (one unit of the rig's frame, whatever that is), the sign chosen so that all six rays meet in front
///         of both cameras. Poses for which a point would lie behind a camera are left out, as are those with a focal length
///         below 5e-4 times the largest image coordinate. An empty list if there is no such pose or the data are degenerate.
///
/// Degenerate, nothing is returned: the six points in the rig lie in one plane (then the focal length is not determined), the
/// query lies at c (no baseline), fewer than six independent constraints (repeated correspondences, all image points equal, ..),
/// two image points exactly at the principal point. A correspondence whose ray passes through the other camera's centre has no
/// point in front of both, and excludes the pose. Solved less reliably: five image points almost on one line (the plane of five
/// points seen edge-on).
///
/// \throws std::invalid_argument fewer than six indices, a repeated index or one out of range, correspondences of different rig
///         cameras, a value that is not finite.
///
/// Method: det F = 0 and the conditions on E = diag(f, f, 1) F reduce the three-parameter family of fundamental matrices to the
/// real roots of one binary form of degree 9. The problem: Bujnak, Kukelova, Pajdla, "3D reconstruction from image collections
/// with a single known focal length", ICCV 2009.
/// Cost: about 0.16 of opengv::absolute_pose::gp3p (2.6 microseconds where that takes 16.4).
HYBRIDGV_EXPORT FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
/// The six-point solver on the adapter's first six 2D-2D correspondences.
HYBRIDGV_EXPORT FocalPoses sixpt_onefocal(const hybrid_pose::HybridAdapterBase& adapter);

/// Five points: relative pose of two cameras from five 2D-2D correspondences of one rig camera, the query's focal length f being known.
/// With the camera's centre c and the viewing rays c + beta q_i,
///
///     (u_i, v_i, f) x rotation^T (c + beta_i q_i - position) = 0,   beta_i > 0,   in front of the query,   i = 1 .. 5.
///
/// \param adapter      its 2D-2D correspondences: image points relative to the principal point, undistorted; any unit. They are
///                     homogeneous: bearing vectors (x, y, z), z > 0, are image points of a camera with f = 1
/// \param focalLength  f, in the unit of the image points
/// \param indices      five different 2D-2D correspondences of one rig camera (the first five entries are used)
/// \return at most 10 poses (2.1 on average), in no particular order, each with |position - c| = 1, because the scale is not
///         determined. Empty if there is none or the data are degenerate: no baseline, repeated rays, four points on one line. Five
///         points in one plane are no special case. With a baseline of less than a hundredth of the distance one pose in fifty is lost.
/// \throws std::invalid_argument for too few, repeated or out-of-range indices, correspondences of different rig cameras, data that
///         are not finite, and a focal length that is not positive and finite
///
/// The ten cubics of the essential matrix, reduced to one form of degree 10; about 0.2 times OpenGV's gp3p. The problem: Nister, "An
/// efficient solution to the five-point relative pose problem", 2004.
HYBRIDGV_EXPORT FocalPoses fivept(const hybrid_pose::HybridAdapterBase& adapter, double focalLength,
                                  const std::vector<int>& indices);
/// The five-point solver on the adapter's first five 2D-2D correspondences.
HYBRIDGV_EXPORT FocalPoses fivept(const hybrid_pose::HybridAdapterBase& adapter, double focalLength);

}  // namespace relative_pose
}  // namespace hybridgv

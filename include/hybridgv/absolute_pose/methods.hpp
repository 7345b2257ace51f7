/// \file
/// \brief Minimal solvers for 2D-3D correspondences alone, with unknown or known focal length.
#pragma once

#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace absolute_pose {

/// P4Pf: pose and focal length from four 2D-3D correspondences. With f = focalLength, each gives
///
///     (u_i, v_i) = f (x_i/z_i, y_i/z_i),   (x_i, y_i, z_i) = rotation^T (X_i - position),   z_i > 0.
///
/// These are eight equations for seven unknowns: seven are solved (all of the first three points, and that the fourth image point
/// lies on the image of the normal through X_4 to the plane of the other three), the eighth ranks the solutions.
///
/// \param adapter  its 2D-3D correspondences: image points relative to the principal point, undistorted; any unit
/// \param indices  four different 2D-3D correspondences (the first four entries are used)
/// \return at most 6 poses (1.9 on average), by increasing reprojection error of the fourth point. All fit the first three points
///         exactly; for exact data the first is the truth, for noisy data it is usually the best. Empty for collinear or
///         coinciding points, coinciding image points and data without a real solution. Coplanar points are no special case,
///         but with a view along the normal of their plane they do not fix the focal length.
/// \throws std::invalid_argument for too few, repeated or out-of-range indices and data that are not finite
///
/// One form of degree 6 in the direction of the optical axis in the plane of three points; about 0.09 times OpenGV's gp3p.
HYBRIDGV_EXPORT FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
/// P4Pf on the adapter's first four 2D-3D correspondences.
HYBRIDGV_EXPORT FocalPoses p4pf(const hybrid_pose::HybridAdapterBase& adapter);

/// P3.5Pf: the minimal version of p4pf, which leaves out the v coordinate of the fourth image point, so that the seven equations
/// are as many as the unknowns.
///
/// \param adapter  its 2D-3D correspondences: image points relative to the principal point, undistorted; any unit
/// \param indices  four different 2D-3D correspondences; of the last one only u is used
/// \return at most 10 poses (1.8 on average), in no particular order. Empty for collinear or coinciding points, coinciding image
///         points and data without a real solution
/// \throws std::invalid_argument for too few, repeated or out-of-range indices and data that are not finite
///
/// One form of degree 10; about 0.12 times OpenGV's gp3p.
HYBRIDGV_EXPORT FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices);
/// P3.5Pf on the adapter's first four 2D-3D correspondences.
HYBRIDGV_EXPORT FocalPoses p35pf(const hybrid_pose::HybridAdapterBase& adapter);

/// P3P: pose from three 2D-3D correspondences, the focal length f being known. Each gives
///
///     (u_i, v_i) = f (x_i/z_i, y_i/z_i),   (x_i, y_i, z_i) = rotation^T (X_i - position),   z_i > 0.
///
/// \param adapter      its 2D-3D correspondences: image points relative to the principal point, undistorted; any unit. Image points
///                     are homogeneous, so that bearing vectors (x, y, z), z > 0, are image points of a camera with f = 1
/// \param focalLength  f, in the unit of the image points
/// \param indices      three different 2D-3D correspondences (the first three entries are used)
/// \return at most 4 poses (2.1 on average), in no particular order, with f as their focal length. Empty for collinear or coinciding
///         points, coinciding image points and data without a real solution. Where the query is on the cylinder over the points'
///         circumcircle, two solutions coincide: they are returned once, with half the digits.
/// \throws std::invalid_argument for too few, repeated or out-of-range indices, data that are not finite, and a focal length that
///         is not positive and finite
///
/// A pair of lines in a pencil of conics: one root of a cubic and quadratic equations; about 0.02 times OpenGV's gp3p.
HYBRIDGV_EXPORT FocalPoses p3p(const hybrid_pose::HybridAdapterBase& adapter, double focalLength,
                               const std::vector<int>& indices);
/// P3P on the adapter's first three 2D-3D correspondences.
HYBRIDGV_EXPORT FocalPoses p3p(const hybrid_pose::HybridAdapterBase& adapter, double focalLength);

}  // namespace absolute_pose
}  // namespace hybridgv

/// \file
/// \brief Minimal solvers for mixed 2D-2D and 2D-3D correspondences, unknown focal length.
#pragma once

#include <array>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace hybrid_pose {

/// H13f: pose and focal length from one 2D-2D and three 2D-3D correspondences. Each 2D-3D correspondence gives two equations,
///
///     (u_i, v_i) = focalLength (x_i/z_i, y_i/z_i),   (x_i, y_i, z_i) = rotation^T (X_i - position),   z_i > 0,
///
/// the 2D-2D one the last: the ray through (u, v) meets the rig camera's ray camOffset + beta q in front of both.
///
/// \param adapter  image points relative to the principal point, undistorted; any unit
/// \param indices  `indices[0]`: one 2D-2D correspondence, `indices[1]`: three different 2D-3D ones
/// \return at most 12 poses (1.9 on average), in no particular order. Empty for three collinear or coinciding points, coinciding
///         image points, a ray through one of the points (it adds no equation) and data without a real solution.
/// \throws std::invalid_argument for too few, repeated or out-of-range indices and data that are not finite
///
/// The problem is that of Bhayani et al., WACV 2023; solved by one form of degree 12, in about 0.17 times OpenGV's gp3p.
HYBRIDGV_EXPORT FocalPoses h13f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices);
/// H13f on the adapter's first 2D-2D and its first three 2D-3D correspondences.
HYBRIDGV_EXPORT FocalPoses h13f(const HybridAdapterBase& adapter);

/// H32f: pose and focal length of the query from three 2D-2D and two 2D-3D correspondences, whatever rig cameras the three
/// viewing rays come from (configurations [1], [2], [3]).
///
/// Equations, for the image points (u_k, v_k) of the viewing rays c_k + beta q_k and (u_j, v_j) of the points X_j (rig frame):
///
///     lambda_k (u_k, v_k, f) = rotation^T (c_k + beta_k q_k - position),   lambda_k > 0, beta_k > 0,   k = 1..3,
///     lambda_j (u_j, v_j, f) = rotation^T (X_j - position),                lambda_j > 0,               j = 1, 2.
///
/// \param[in] adapter Correspondences: image points in pixels relative to the principal point (any scale); rays and points in the
///                    rig's frame and unit.
/// \param[in] indices indices[0]: three 2D-2D correspondences, indices[1]: two 2D-3D correspondences; more are ignored. The
///                    overload without indices takes the first three and the first two.
/// \return At most 26 poses (2.1 on average) with positive focal length that satisfy all equations; an empty list if there is
///         none or the data are degenerate. With all rays from one rig camera, a query at that camera's centre satisfies the
///         equations trivially and is not returned.
///
/// Degenerate, nothing is returned: equal points X_j; both image points of the X_j at the principal point; rays that give fewer
/// than three independent equations (a ray given twice with the same image point, rays through one of the X_j, rays through a
/// common point that have one image point). Two image points of the X_j closer than about 1e-3 pixels to each other, or one that
/// close to the principal point, are solved less reliably.
///
/// \throws std::invalid_argument too few indices, a repeated index or one out of range, a value that is not finite.
///
/// Method: the cosine e between the optical axis and the line through X_1 and X_2 is the hidden variable; the 8x8 Dixon resultant
/// of the three ray equations has degree 26 in e. Cost: 0.64 to 0.7 of opengv::absolute_pose::gp3p with SSE2, 0.4 with AVX2, 0.34
/// to 0.38 with AVX-512 (chosen at run time).
///
/// Source: Bhayani, Sattler, Larsson, Heikkila, Kukelova, "Partially calibrated semi-generalized pose from hybrid point
/// correspondences", WACV 2023, which poses the problem and counts its solutions.
HYBRIDGV_EXPORT FocalPoses h32f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices);
/// H32f on the adapter's first three 2D-2D and its first two 2D-3D correspondences.
HYBRIDGV_EXPORT FocalPoses h32f(const HybridAdapterBase& adapter);

/// H51f: pose and focal length of the query from five 2D-2D correspondences and one 2D-3D correspondence.
///
/// Equations, for the image points (u_k, v_k) of the viewing rays c_k + beta q_k and (u, v) of the point X (rig frame):
///
///     lambda_k (u_k, v_k, f) = rotation^T (c_k + beta_k q_k - position),   lambda_k > 0, beta_k > 0,   k = 1..5,
///     lambda (u, v, f) = rotation^T (X - position),   lambda > 0.
///
/// \param[in] adapter Correspondences: image points in pixels relative to the principal point (any scale); rays and points in the
///                    rig's frame and unit.
/// \param[in] indices indices[0]: five 2D-2D correspondences, indices[1]: one 2D-3D correspondence; more are ignored. The
///                    overload without indices takes the first five and the first.
/// \return Poses with positive focal length that satisfy all equations; an empty list if there is none or the data are
///         degenerate.
///
/// How many solutions there are depends on the configuration [k], k the largest number of rays that share one centre. Rays have
/// one centre if they belong to one rig camera, or if their centres differ by less than 1e-9 of the distance from X.
///
/// | configuration | solutions at most | poses on average | time, x opengv::absolute_pose::gp3p |
/// |---|---|---|---|
/// | [1], [2] | 56 | 2.5 | 8 to 23, by the instruction set |
/// | [3] | 50 | 2.5 | 8 to 23 |
/// | [4] | 36 | 2.5 | 6 to 16 |
/// | [5], all rays from one rig camera | 9 | 1.6 | 0.16 |
///
/// Degenerate, normally nothing is returned, with several rig cameras: a repeated ray, a ray through X, all image points equal, all
/// rays parallel, all points on one line. With one, nothing is returned: X and the five points in one plane (then the focal length is
/// not determined), the query at the rig camera's centre, X there or on the line through both centres, fewer than six independent constraints
/// (repeated correspondences, all image points equal), two image points exactly at the principal point.
///
/// Less reliable: of two solutions that nearly coincide one may be missing; an image point exactly at the principal point moves 8
/// to 24 of the 56 solutions to infinity, where they are left out; with one rig camera, five image points almost on one line, and
/// focal lengths below 5e-4 times the largest image coordinate are left out.
///
/// \throws std::invalid_argument too few indices, a repeated index or one out of range, a value that is not finite.
///
/// Method: [1] to [4] a parameter homotopy, [5] a binary form of degree 9. The pages "One point and five rays" and "One centre"
/// derive them and say how reliable they are.
///
/// Source: Bhayani, Sattler, Larsson, Heikkila, Kukelova, "Partially calibrated semi-generalized pose from hybrid point
/// correspondences", WACV 2023, which poses the problem and counts its solutions.
HYBRIDGV_EXPORT FocalPoses h51f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices);
/// H51f on the adapter's first five 2D-2D correspondences and its first 2D-3D correspondence.
HYBRIDGV_EXPORT FocalPoses h51f(const HybridAdapterBase& adapter);

/// H70f: pose and focal length of the query from seven 2D-2D correspondences, without any 3D point.
///
/// Equations, for the image points (u_k, v_k) of the viewing rays c_k + beta q_k (rig frame):
///
///     lambda_k (u_k, v_k, f) = rotation^T (c_k + beta_k q_k - position),   lambda_k > 0, beta_k > 0,   k = 1..7.
///
/// \param[in] adapter Correspondences: image points in pixels relative to the principal point (any scale); rays in the rig's frame
///                    and unit.
/// \param[in] indices indices[0]: seven 2D-2D correspondences, more are ignored; indices[1]: none. The overload without indices
///                    takes the first seven.
/// \return Poses with positive focal length that satisfy all equations; an empty list if there is none or the data are degenerate.
///
/// How many solutions there are depends on how many rays share a centre. Rays have one centre if they belong to one rig camera, or
/// if their centres differ by less than 1e-9 of the largest distance between two centres.
///
/// | rays of the centres with three or more | solutions at most | time, x opengv::absolute_pose::gp3p |
/// |---|---|---|
/// | 6 | 9 | 0.17 |
/// | 5 | 50 | 17 to 46, by the instruction set |
/// | 4 + 3 | 76 | 24 to 64 |
/// | 4 | 84 | 26 to 73 |
/// | 3 + 3 | 98 | 27 to 82 |
/// | 3 | 108 | 32 to 101 |
/// | none | 118 | 26 to 89 |
///
/// Real solutions in front of all cameras are few: 3 on average, 8 on a rig with a short baseline, at most 20 were ever seen.
///
/// Degenerate, normally nothing is returned: all seven rays from one centre (the scale is not determined), a repeated ray, all image
/// points equal, all rays parallel, the query at the centre that three or more rays share. With six rays from one centre also: their
/// six points in one plane (then the focal length is not determined); all other patterns are solved for points in a plane as well.
///
/// Less reliable: of two solutions that nearly coincide one may be missing; an image point exactly at the principal point moves
/// solutions to infinity, where they are left out; four or more rays whose centres differ, but by less than 1e-4 of their distance
/// from the scene, take up to ten times as long.
///
/// \throws std::invalid_argument too few indices, a repeated index or one out of range, a value that is not finite.
///
/// Method: six rays from one centre by a binary form of degree 9, all other patterns by a parameter homotopy. The page "Seven rays"
/// derives them and says how reliable they are.
HYBRIDGV_EXPORT FocalPoses h70f(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices);
/// H70f on the adapter's first seven 2D-2D correspondences.
HYBRIDGV_EXPORT FocalPoses h70f(const HybridAdapterBase& adapter);

/// H22: pose from two 2D-2D and two 2D-3D correspondences, the focal length f being known. With camFromWorld() = (R, t), a point X and a
/// viewing ray c + beta q satisfy
///
///     (u, v, f) x (R X + t) = 0,   (u, v, f) . ((R c + t) x R q) = 0,   everything in front of the cameras.
///
/// \param adapter      the correspondences: image points relative to the principal point, undistorted; any unit. They are homogeneous:
///                     bearing vectors (x, y, z), z > 0, are image points of a camera with f = 1
/// \param focalLength  f, in the unit of the image points
/// \param indices      {two 2D-2D, two 2D-3D}: the rays of one rig camera or of two
/// \return at most 16 poses (2.5 on average), in no particular order, with f as their focal length. Empty for points, image points of
///         points or rays that coincide, and data without a real solution. A ray that passes through one of the points says nothing.
/// \throws std::invalid_argument for too few, repeated or out-of-range indices, data that are not finite, and a focal length that is
///         not positive and finite
///
/// The two points leave two angles, of which one is eliminated: a form of degree 16, searched where the points are in front; about 0.1
/// times OpenGV's gp3p.
HYBRIDGV_EXPORT FocalPoses h22(const HybridAdapterBase& adapter, double focalLength,
                               const std::vector<std::vector<int>>& indices);
/// H22 on the adapter's first correspondences.
HYBRIDGV_EXPORT FocalPoses h22(const HybridAdapterBase& adapter, double focalLength);

/// H41: pose from four 2D-2D correspondences of one rig camera and one 2D-3D correspondence, the focal length f being known. The
/// equations are those of h22. The line from the camera's centre to the point is a fifth ray, and gives the scale.
///
/// \param adapter      the correspondences: image points relative to the principal point, undistorted; any unit. They are homogeneous:
///                     bearing vectors (x, y, z), z > 0, are image points of a camera with f = 1
/// \param focalLength  f, in the unit of the image points
/// \param indices      {four 2D-2D of one rig camera, one 2D-3D}
/// \return at most 10 poses (2.1 on average), in no particular order, with f as their focal length. Empty where relative_pose::fivept is,
///         and if the point is the camera's centre or on one of the rays.
/// \throws std::invalid_argument for too few, repeated or out-of-range indices, correspondences of different rig cameras, data that are not finite, and a focal length that is
///         not positive and finite
///
/// relative_pose::fivept and one linear equation; about 0.22 times OpenGV's gp3p.
HYBRIDGV_EXPORT FocalPoses h41(const HybridAdapterBase& adapter, double focalLength,
                               const std::vector<std::vector<int>>& indices);
/// H41 on the adapter's first correspondences.
HYBRIDGV_EXPORT FocalPoses h41(const HybridAdapterBase& adapter, double focalLength);

/// H60: pose from six 2D-2D correspondences, five of one rig camera and one of another, the focal length f being known. The equations
/// are those of h22. The sixth ray gives the scale.
///
/// \param adapter      the correspondences: image points relative to the principal point, undistorted; any unit. They are homogeneous:
///                     bearing vectors (x, y, z), z > 0, are image points of a camera with f = 1
/// \param focalLength  f, in the unit of the image points
/// \param indices      {six 2D-2D, {}}: five of one rig camera and one of another, in any order
/// \return at most 10 poses (2.0 on average), in no particular order, with f as their focal length. Empty where relative_pose::fivept is.
/// \throws std::invalid_argument for too few, repeated or out-of-range indices, rays that are shared by rig cameras in another way, data that are not finite, and a focal length that is
///         not positive and finite
///
/// relative_pose::fivept and one linear equation; about 0.22 times OpenGV's gp3p. Six rays of other patterns have up to 64 solutions,
/// and are not solved here: where one camera has five rays, this is the sample to draw.
HYBRIDGV_EXPORT FocalPoses h60(const HybridAdapterBase& adapter, double focalLength,
                               const std::vector<std::vector<int>>& indices);
/// H60 on the adapter's first six 2D-2D correspondences.
HYBRIDGV_EXPORT FocalPoses h60(const HybridAdapterBase& adapter, double focalLength);

/// Result of optimize_nonlinear. What it says of the distortion is 0 unless that was estimated.
struct HYBRIDGV_EXPORT NonlinearResult {
  FocalPose pose;          ///< the local minimum
  bool converged = false;  ///< false: the data do not fix the pose, or the iterations were used up
  int iterations = 0;      ///< steps tried
  double cost = 0;         ///< sum of the squared residuals at the result [px^2]; infinite where the start has none
  /// J^T J at the result, 7x7 row-major [px^2 per product of the parameters' units]: small rotation in the query's frame
  /// (rotation * exp([.]x)) [rad], position, log focal length.
  std::array<double, 49> information{};
  /// Standard deviation of the focal length [px] for residuals of 1 px standard deviation; infinite if the data do not fix it.
  double focalLengthStandardDeviation = 0;
  double distortion = 0;                   ///< of the division model [1/px^2] (distortion.hpp), to which pose.focalLength belongs
  double distortionStandardDeviation = 0;  ///< [1/px^2], as that of the focal length
};

/// Levenberg-Marquardt on rotation, position and log focal length: a local minimum of
///
///     sum over 2D-3D | f (x/z, y/z) - (u, v) |^2  +  sum over 2D-2D (Sampson error)^2     [px^2]
///
/// (see residuals.hpp; the rays of a 2D-2D correspondence need not meet in front of the cameras here), with exact derivatives.
/// There is no robust loss: give inliers only, or call sac::hybridRansac.
///
/// \param indices  {2D-2D, 2D-3D} correspondences to use, any number
/// \param initial  where to start
/// \return never worse than the start. Degenerate data give the start itself with converged = false: fewer than seven equations
///         (two per 2D-3D and one per 2D-2D correspondence), data that do not fix all seven parameters at the start (such as rays
///         from one centre only), a point that is not in front of the query at the start.
/// \throws std::invalid_argument for indices out of range or repeated, data or a start that are not finite
///
/// Cost: about 5 to 10 iterations of 20 to 60 ns per correspondence, by the processor's instruction set.
HYBRIDGV_EXPORT NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                                   const FocalPose& initial);
/// The optimization over all correspondences of the adapter.
HYBRIDGV_EXPORT NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const FocalPose& initial);

/// The same with the radial distortion of the query's image as an eighth parameter: image points are raw pixels, relative to the
/// principal point, and residuals are errors in the distorted image (residuals.hpp).
///
/// \param initialDistortion  where to start, 0 as a rule [1/px^2]. The distortion stays between -0.7 and 0.3 over the square of the
///                           largest distance of an image point from the principal point, or between that and the start.
/// \return as above, with eight equations at least; `information` is that of the seven other parameters for unknown distortion. A
///         start for which 1 + initialDistortion (u^2 + v^2) <= 0 at an image point of a 2D-2D correspondence has infinite cost.
/// \throws std::invalid_argument also for an initialDistortion that is not finite
HYBRIDGV_EXPORT NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const std::vector<std::vector<int>>& indices,
                                                   const FocalPose& initial, double initialDistortion);
/// The optimization with distortion over all correspondences of the adapter.
HYBRIDGV_EXPORT NonlinearResult optimize_nonlinear(const HybridAdapterBase& adapter, const FocalPose& initial,
                                                   double initialDistortion);

}  // namespace hybrid_pose
}  // namespace hybridgv

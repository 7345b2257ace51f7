/// \file
/// \brief The pose with focal length that everything here estimates, and the list of minimal solvers.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/version.hpp"

namespace hybridgv {

/// A camera's pose as COLMAP (cam_from_world) and PoseLib write it: a point X of the world, here the rig's frame, is at
/// rotation * X + translation in the camera's frame.
struct CamFromWorld {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< world -> camera
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< the world's origin in the camera's frame
};

/// Pose and focal length of the query camera with respect to the rig (the generalized camera, whose frame is the world frame of
/// the 3D points).
///
/// A rig point X is seen at
///
///     (u, v) = focalLength * (x/z, y/z),   (x, y, z) = rotation^T (X - position),   z > 0,
///
/// with (u, v) relative to the principal point, lens distortion removed.
///
/// The members are OpenGV's: rotation turns query coordinates into rig coordinates, position is the query's centre seen from the
/// rig. The usual computer-vision pair X_query = R X_rig + t is R = rotation^T, t = -rotation^T position: camFromWorld() gives it,
/// fromCamFromWorld() takes it.
struct FocalPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< query -> rig
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< centre of the query, in the rig's frame and unit
  double focalLength = 1;                                  ///< in the unit of the query's image points, > 0

  /// OpenGV's transformation_t [rotation | position]: what opengv::absolute_pose::gp3p returns for a camera without offset.
  Eigen::Matrix<double, 3, 4> transformation() const {
    Eigen::Matrix<double, 3, 4> result;
    result << rotation, position;
    return result;
  }

  /// The inverse transformation, rig -> query: {rotation^T, -rotation^T position}.
  CamFromWorld camFromWorld() const { return {rotation.transpose(), -(rotation.transpose() * position)}; }

  /// The pose with camFromWorld() == {worldToCamera, translation}.
  ///
  /// \param worldToCamera  rotation of the pair X_camera = R X_world + t
  /// \param translation    t of the same pair; not the camera's centre, which is -R^T t
  /// \param focalLength    in the unit of the query's image points
  /// \throws std::invalid_argument for a matrix that is not a rotation, a translation that is not finite, a focal length that is not
  ///         positive and finite
  HYBRIDGV_EXPORT static FocalPose fromCamFromWorld(const Eigen::Matrix3d& worldToCamera, const Eigen::Vector3d& translation,
                                                    double focalLength);
};

/// Solutions of a minimal problem, in no particular order unless the solver says so.
using FocalPoses = std::vector<FocalPose>;

// Whatever instruction set a program is compiled for, it must see the same layout as the library.
static_assert(alignof(FocalPose) == alignof(double) && sizeof(FocalPose) == 13 * sizeof(double),
              "hybridgv::FocalPose must not depend on Eigen's alignment settings");
static_assert(alignof(CamFromWorld) == alignof(double) && sizeof(CamFromWorld) == 12 * sizeof(double),
              "hybridgv::CamFromWorld must not depend on Eigen's alignment settings");

/// The minimal solvers. HmnF takes m 2D-2D and n 2D-3D correspondences, and finds the focal length; those without an F need it.
enum class Solver {
  P4Pf,   ///< 4 2D-3D, at most 6 solutions
  P35Pf,  ///< 4 2D-3D of which the last gives one equation only, at most 10 solutions
  H13f,   ///< 1 2D-2D and 3 2D-3D, at most 12 solutions
  H32f,   ///< 3 2D-2D and 2 2D-3D, at most 26 solutions
  H51f,   ///< 5 2D-2D and 1 2D-3D, at most 56 solutions (9 if the five rays share one centre)
  H70f,   ///< 7 2D-2D, at most 118 solutions (9 if six of the rays share one centre)
  P3P,    ///< 3 2D-3D with known focal length, at most 4 solutions
  H22,    ///< 2 2D-2D and 2 2D-3D with known focal length, at most 16 solutions
  H41,    ///< 4 2D-2D of one rig camera and 1 2D-3D with known focal length, at most 10 solutions
  H60,    ///< 6 2D-2D, five of them of one rig camera, with known focal length, at most 10 solutions
};

/// All of them, in the order of the enumerators.
HYBRIDGV_EXPORT std::vector<Solver> allSolvers();
/// The name of the solver's function: "p4pf", "p35pf", ...
///
/// \throws std::invalid_argument for a value that is none of the enumerators
HYBRIDGV_EXPORT const char* toString(Solver solver);
/// The solver of that name; std::invalid_argument for any other name, with a list of the valid ones.
HYBRIDGV_EXPORT Solver solverFromString(const std::string& name);

/// The library's version at run time ("1.2.3"); HYBRIDGV_VERSION_STRING is that of the headers.
HYBRIDGV_EXPORT const char* version();

}  // namespace hybridgv

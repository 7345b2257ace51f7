/// \file
/// \brief The interface through which every function of the library reads correspondences.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "hybridgv/export.hpp"

namespace hybridgv {
namespace hybrid_pose {

/// Gives access to hybrid correspondences between a query camera of unknown focal length and a rig of calibrated cameras.
///
/// The style is OpenGV's (the rig is viewpoint 1, the query is viewpoint 2), with one difference: the query's side is given as
/// **image points** (u, v, 1), in pixels relative to the principal point and free of lens distortion, because bearing vectors
/// would need the focal length that is to be found.
///
/// * 2D-2D correspondence i: the query's image point and a viewing ray in the rig's frame,
///   `getCamOffset(i) + beta * getCamRotation(i) * getBearingVector(i)`, beta > 0.
/// * 2D-3D correspondence i: the query's image point and a point in the rig's frame.
///
/// Adapters are only read, and may be shared between threads as long as the derived class's getters may. No function of the library
/// calls getters from several threads at a time unless the adapter allows it, see allowsConcurrentReads.
class HYBRIDGV_EXPORT HybridAdapterBase {
 public:
  virtual ~HybridAdapterBase();

  /// Number of 2D-2D correspondences.
  virtual std::size_t getNumberCorrespondences2d2d() const = 0;
  /// Image point (u, v, 1) of 2D-2D correspondence `index` in the query.
  virtual Eigen::Vector3d getImagePoint2d2d(std::size_t index) const = 0;
  /// Viewing direction of 2D-2D correspondence `index` in the frame of its rig camera; any positive length.
  virtual Eigen::Vector3d getBearingVector(std::size_t index) const = 0;
  /// The rig camera of 2D-2D correspondence `index`: any number, only the order matters. Which rays share a camera is seen from
  /// their centres: those with equal getCamOffset do.
  virtual int getCamIndex(std::size_t index) const = 0;
  /// Centre of the rig camera of 2D-2D correspondence `index`, in the rig's frame.
  virtual Eigen::Vector3d getCamOffset(std::size_t index) const = 0;
  /// Rotation from the frame of that rig camera to the rig's frame (COLMAP stores the inverse).
  virtual Eigen::Matrix3d getCamRotation(std::size_t index) const = 0;
  /// Focal length of the rig camera of 2D-2D correspondence `index` in that camera's own pixels, 0 if it is not known (the
  /// default). It only weighs the map image's part of the Sampson error.
  virtual double getRigFocalLength(std::size_t index) const;
  /// Quality of 2D-2D correspondence `index`, larger is better (the default is 1 for all). Only the order matters.
  virtual double getWeight2d2d(std::size_t index) const;

  /// Number of 2D-3D correspondences.
  virtual std::size_t getNumberCorrespondences2d3d() const = 0;
  /// Image point (u, v, 1) of 2D-3D correspondence `index` in the query.
  virtual Eigen::Vector3d getImagePoint2d3d(std::size_t index) const = 0;
  /// The 3D point of 2D-3D correspondence `index`, in the rig's frame.
  virtual Eigen::Vector3d getPoint(std::size_t index) const = 0;
  /// Quality of 2D-3D correspondence `index`, larger is better (the default is 1 for all). Only the order matters.
  virtual double getWeight2d3d(std::size_t index) const;

  /// Number of the query's feature (keypoint) from which 2D-2D correspondence `index` comes; negative if it is not known (the default).
  /// The correspondences of one feature, of both kinds, share its error: one keypoint that is matched in five map images has been
  /// measured once. So they count as one accident where a pose is told from chance, and the covariance allows for what they share.
  /// Equal image points count as one feature without a number, too. Any numbers will do; only which are equal matters.
  virtual int getFeature2d2d(std::size_t index) const;
  /// The same of 2D-3D correspondence `index`. Both kinds use the same numbers.
  virtual int getFeature2d3d(std::size_t index) const;

  /// Whether getters may be called from several threads at the same time (the default: no). Then hybridRansac reads many thousands of
  /// correspondences by all its threads. Getters that only read memory may be; those that run Python, keep a cache or count their
  /// calls as a rule may not.
  virtual bool allowsConcurrentReads() const;

 protected:
  HybridAdapterBase() = default;
  HybridAdapterBase(const HybridAdapterBase&) = default;
  HybridAdapterBase& operator=(const HybridAdapterBase&) = default;
};

}  // namespace hybrid_pose
}  // namespace hybridgv

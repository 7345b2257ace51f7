/// \file
/// \brief Hybrid correspondences held in plain vectors.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hybridgv/export.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"

namespace hybridgv {

/// The counterpart of OpenGV's Noncentral*Adapter. Unlike them it **copies** its data: the vectors may be temporaries.
class HYBRIDGV_EXPORT NoncentralHybridAdapter : public hybrid_pose::HybridAdapterBase {
 public:
  using Vectors = std::vector<Eigen::Vector3d>;   ///< image points, directions, centres, points
  using Matrices = std::vector<Eigen::Matrix3d>;  ///< rotations

  /// \param imagePoints2d2d  query image points (u, v, 1) of the 2D-2D correspondences: pixels relative to the principal point,
  ///                         lens distortion removed
  /// \param bearingVectors   their viewing directions in the frames of their rig cameras
  /// \param camIndices       the rig camera of each, an index into camOffsets and camRotations
  /// \param camOffsets       centres of the rig cameras in the rig's frame
  /// \param camRotations     rotations from the rig cameras' frames to the rig's
  /// \param imagePoints2d3d  query image points (u, v, 1) of the 2D-3D correspondences
  /// \param points           their points in the rig's frame
  ///
  /// \throws std::invalid_argument for lists of different lengths, a camera index out of range, values that are not finite, a
  ///         bearing vector of length zero, a camRotation that is not a rotation.
  NoncentralHybridAdapter(Vectors imagePoints2d2d, Vectors bearingVectors, std::vector<int> camIndices, Vectors camOffsets,
                          Matrices camRotations, Vectors imagePoints2d3d, Vectors points);
  ~NoncentralHybridAdapter() override;

  /// Focal lengths of the rig cameras in their own pixels (one per camera, 0 = unknown); see getRigFocalLength.
  void setRigFocalLengths(std::vector<double> focalLengths);
  /// Qualities of the correspondences, larger is better; an empty list means 1 for all.
  void setWeights(std::vector<double> weights2d2d, std::vector<double> weights2d3d);
  /// Numbers of the query's features (keypoints) from which the correspondences come, the same numbers for both kinds; negative where
  /// it is not known, an empty list where it is for none; see getFeature2d2d.
  ///
  /// \throws std::invalid_argument for a list that has neither an entry for every correspondence nor none.
  void setFeatures(std::vector<int> features2d2d, std::vector<int> features2d3d);

  std::size_t getNumberCorrespondences2d2d() const override;
  Eigen::Vector3d getImagePoint2d2d(std::size_t index) const override;
  Eigen::Vector3d getBearingVector(std::size_t index) const override;
  int getCamIndex(std::size_t index) const override;
  Eigen::Vector3d getCamOffset(std::size_t index) const override;
  Eigen::Matrix3d getCamRotation(std::size_t index) const override;
  double getRigFocalLength(std::size_t index) const override;
  double getWeight2d2d(std::size_t index) const override;

  std::size_t getNumberCorrespondences2d3d() const override;
  Eigen::Vector3d getImagePoint2d3d(std::size_t index) const override;
  Eigen::Vector3d getPoint(std::size_t index) const override;
  double getWeight2d3d(std::size_t index) const override;

  int getFeature2d2d(std::size_t index) const override;
  int getFeature2d3d(std::size_t index) const override;

  /// True, but for derived classes, of whose getters nothing is known: they say it themselves.
  bool allowsConcurrentReads() const override;

 private:
  Vectors imagePoints2d2d_, bearingVectors_;
  std::vector<int> camIndices_;
  Vectors camOffsets_;
  Matrices camRotations_;
  Vectors imagePoints2d3d_, points_;
  std::vector<double> rigFocalLengths_, weights2d2d_, weights2d3d_;
  std::vector<int> features2d2d_, features2d3d_;
};

}  // namespace hybridgv

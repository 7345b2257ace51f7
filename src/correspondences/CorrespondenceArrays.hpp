// The correspondences as the robust estimation holds them: copied once from the adapter, centred and scaled, one array per
// quantity.
#pragma once

#include <vector>

#include "correspondences/ArrayViews.hpp"
#include "correspondences/Correspondence.hpp"
#include "correspondences/ForEach.hpp"
#include "correspondences/UnsetVector.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace correspondences {

// The rig's frame, moved and scaled so that coordinates are of the order of 1: x' = (x - centre) / unit.
struct Normalization {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double unit = 1;

  Eigen::Vector3d apply(const Eigen::Vector3d& x) const { return (x - centre) / unit; }
  // `Pose`: a FocalPose, or one with more.
  template <class Pose>
  Pose applyTo(Pose pose) const {
    pose.position = apply(pose.position);
    return pose;
  }
  FocalPose apply(const FocalPose& pose) const { return applyTo(pose); }
  FocalPose undo(FocalPose pose) const { return pose.position = centre + unit * pose.position, pose; }
};

class CorrespondenceArrays {
 public:
  CorrespondenceArrays() = default;
  explicit CorrespondenceArrays(const Correspondences& correspondences);
  // Reads the correspondences indices2d2d and indices2d3d, in this order, several at a time if the adapter allows it. Throws as
  // readCorrespondences does.
  CorrespondenceArrays(const hybrid_pose::HybridAdapterBase& adapter, const std::vector<int>& indices2d2d,
                       const std::vector<int>& indices2d3d, const ForEach& forEach = oneByOne);

  // Those with these indices, in their order: the same numbers, in the same normalized frame.
  CorrespondenceArrays subset(const std::vector<int>& rayIndices, const std::vector<int>& pointIndices) const;

  // A rig camera of unknown focal length then has about the width of the query's image as its own, at least this one. It must not follow a
  // focal length of the query that is to be found: the Sampson error of any data vanishes as that goes to 0, and falls as it grows.
  void fixUnknownFocalLengths(double least = 0);
  // About the width of the query's image: twice the largest coordinate, if the image points reach the image's border evenly. A few
  // points far away do not decide. 0 if there are none.
  double imageSize() const;
  // At most that: by the median of these coordinates, which wrong matches do not move much. Of image points that crowd in the middle it is too small.
  double leastImageSize() const;

  // How far image points are from the principal point: the largest distance, but at most twice what nearly all are below,
  // so that a few far away do not decide. 0 without image points.
  double imageRadius() const;

  const Normalization& normalization() const { return normalization_; }
  // In the order in which they were given, normalized.
  const UnsetVector<RayMatch>& rays() const { return rays_; }
  const UnsetVector<PointMatch>& points() const { return points_; }
  using MapImagePoint = correspondences::MapImagePoint;
  const UnsetVector<MapImagePoint>& mapImagePoints() const { return mapImagePoints_; }
  // Numbers of the query's features; empty if none is known.
  const std::vector<int>& rayFeatures() const { return rayFeatures_; }
  const std::vector<int>& pointFeatures() const { return pointFeatures_; }
  RayArrays rayArrays() const;
  PointArrays pointArrays() const;

 private:
  // Of every image point, by size(u, v).
  template <class Size>
  std::vector<double> sizesOfImagePoints(const Size& size) const;
  void resize(std::size_t rays, std::size_t points);
  // A correspondence as it was given, and what of its columns does not depend on the normalization.
  void setRay(std::size_t i, const RigRay& ray);
  void setPoint(std::size_t i, const PointMatch& point) { points_[i] = point; }
  // When all are set.
  void normalize(const ForEach& forEach);
  void normalizeRay(std::size_t i);
  void normalizePoint(std::size_t i);

  Normalization normalization_;
  UnsetVector<RayMatch> rays_;
  UnsetVector<PointMatch> points_;
  UnsetVector<MapImagePoint> mapImagePoints_;
  std::vector<int> rayFeatures_, pointFeatures_;
  UnsetVector<double> rayColumns_, pointColumns_;
};

// The next multiple of kPadding.
std::size_t padded(std::size_t size);

// 0, 1, .., count-1
std::vector<int> allIndices(std::size_t count);

}  // namespace correspondences
}  // namespace hybridgv

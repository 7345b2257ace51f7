/// \file
/// \brief Hybrid correspondences read from OpenGV's own adapters.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <opengv/absolute_pose/AbsoluteAdapterBase.hpp>
#include <opengv/relative_pose/RelativeAdapterBase.hpp>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "hybridgv/detail/format.hpp"
#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"

namespace hybridgv {

/// Presents a relative-pose adapter (the 2D-2D correspondences), an absolute-pose adapter (the 2D-3D correspondences), or both,
/// of OpenGV as one hybrid adapter.
///
/// * Relative: viewpoint 1 is the rig, viewpoint 2 is the query.
/// * Absolute: its bearing vectors are the query's, its world frame is the rig's frame (viewpoint 1 of the relative adapter).
///
/// OpenGV's adapters hold bearing vectors of the query, which somebody formed with a nominal focal length f0. The image points
/// are
///
///     (u, v) = f0 * (bx / bz, by / bz),
///
/// and the focal length that is found has the unit of f0: if f0 is in pixels, pixels; if f0 = 1 (bearing vectors of normalized
/// coordinates), it is the factor by which the nominal focal length was wrong, and the thresholds are in that unit too.
///
/// The query is one pinhole camera in the origin of its viewpoint: getCamOffset2 and getCamRotation2, and the absolute adapter's
/// getCamOffset and getCamRotation, must be zero and identity. (NoncentralRelativeAdapter has one list of cameras for both
/// viewpoints: append a camera with zero offset and identity rotation for the query.) Correspondences with equal getCamOffset1
/// belong to one rig camera; getCamIndex numbers these in the order of their first appearance.
///
/// **Lifetime**: OpenGV's adapters are referred to, as everywhere in OpenGV, and must outlive this one (temporaries do not
/// compile). They are only read, and must keep their number of correspondences and their cameras.
class OpenGVHybridAdapter : public hybrid_pose::HybridAdapterBase {
 public:
  using RelativeAdapter = opengv::relative_pose::RelativeAdapterBase;  ///< holds 2D-2D correspondences
  using AbsoluteAdapter = opengv::absolute_pose::AbsoluteAdapterBase;  ///< holds 2D-3D correspondences

  /// \param relative  2D-2D correspondences
  /// \param absolute  2D-3D correspondences
  /// \param nominalFocalLength  f0, the focal length with which the query's bearing vectors were formed, > 0
  ///
  /// \throws std::invalid_argument that names the correspondence, for a query bearing vector that is not finite or does not point
  ///         into the half space in front of the camera (bz <= 0: such a direction has no image point), a query camera that is
  ///         not in the origin of its viewpoint, or a nominal focal length that is not positive and finite.
  OpenGVHybridAdapter(const RelativeAdapter& relative, const AbsoluteAdapter& absolute, double nominalFocalLength = 1)
      : OpenGVHybridAdapter(&relative, &absolute, nominalFocalLength) {}
  /// 2D-2D correspondences only.
  explicit OpenGVHybridAdapter(const RelativeAdapter& relative, double nominalFocalLength = 1)
      : OpenGVHybridAdapter(&relative, nullptr, nominalFocalLength) {}
  /// 2D-3D correspondences only.
  explicit OpenGVHybridAdapter(const AbsoluteAdapter& absolute, double nominalFocalLength = 1)
      : OpenGVHybridAdapter(nullptr, &absolute, nominalFocalLength) {}

  OpenGVHybridAdapter(const RelativeAdapter&&, const AbsoluteAdapter&, double = 1) = delete;
  OpenGVHybridAdapter(const RelativeAdapter&, const AbsoluteAdapter&&, double = 1) = delete;
  OpenGVHybridAdapter(const RelativeAdapter&&, const AbsoluteAdapter&&, double = 1) = delete;
  explicit OpenGVHybridAdapter(const RelativeAdapter&&, double = 1) = delete;
  explicit OpenGVHybridAdapter(const AbsoluteAdapter&&, double = 1) = delete;

  std::size_t getNumberCorrespondences2d2d() const override { return camIndices_.size(); }
  Eigen::Vector3d getImagePoint2d2d(std::size_t index) const override { return imagePoint(relative_->getBearingVector2(index)); }
  Eigen::Vector3d getBearingVector(std::size_t index) const override { return relative_->getBearingVector1(index); }
  int getCamIndex(std::size_t index) const override { return camIndices_[index]; }
  Eigen::Vector3d getCamOffset(std::size_t index) const override { return relative_->getCamOffset1(index); }
  Eigen::Matrix3d getCamRotation(std::size_t index) const override { return relative_->getCamRotation1(index); }
  double getWeight2d2d(std::size_t index) const override { return relative_->getWeight(index); }

  std::size_t getNumberCorrespondences2d3d() const override { return count2d3d_; }
  Eigen::Vector3d getImagePoint2d3d(std::size_t index) const override { return imagePoint(absolute_->getBearingVector(index)); }
  Eigen::Vector3d getPoint(std::size_t index) const override { return absolute_->getPoint(index); }
  double getWeight2d3d(std::size_t index) const override { return absolute_->getWeight(index); }

 private:
  OpenGVHybridAdapter(const RelativeAdapter* relative, const AbsoluteAdapter* absolute, double nominalFocalLength)
      : relative_(relative), absolute_(absolute), nominalFocalLength_(nominalFocalLength) {
    if (!(nominalFocalLength > 0) || !std::isfinite(nominalFocalLength))
      throwInvalid("nominalFocalLength", "must be positive and finite, is " + detail::format(nominalFocalLength));
    if (relative_) readRelative();
    if (absolute_) readAbsolute();
  }

  using Centre = std::array<double, 3>;
  struct CentreHash {
    std::size_t operator()(const Centre& centre) const {
      std::size_t result = 0;
      for (double coordinate : centre) result = 31 * (result ^ (result >> 16)) + std::hash<double>()(coordinate);
      return result;
    }
  };

  void readRelative() {
    std::unordered_map<Centre, int, CentreHash> cameras;
    const std::size_t count = checkedCount("relative", relative_->getNumberCorrespondences());
    camIndices_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      checkQueryBearing("relative.getBearingVector2", i, relative_->getBearingVector2(i));
      checkQueryCamera("relative.getCamOffset2", "relative.getCamRotation2", i, relative_->getCamOffset2(i),
                       relative_->getCamRotation2(i));
      const Eigen::Vector3d centre = relative_->getCamOffset1(i);
      const int next = static_cast<int>(cameras.size());
      camIndices_.push_back(cameras.emplace(Centre{centre[0], centre[1], centre[2]}, next).first->second);
    }
  }

  void readAbsolute() {
    count2d3d_ = checkedCount("absolute", absolute_->getNumberCorrespondences());
    for (std::size_t i = 0; i < count2d3d_; ++i) {
      checkQueryBearing("absolute.getBearingVector", i, absolute_->getBearingVector(i));
      checkQueryCamera("absolute.getCamOffset", "absolute.getCamRotation", i, absolute_->getCamOffset(i),
                       absolute_->getCamRotation(i));
    }
  }

  static std::size_t checkedCount(const char* adapter, std::size_t count) {
    if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throwInvalid(std::string(adapter) + ".getNumberCorrespondences()",
                   "at most 2^31 - 1 are possible, is " + std::to_string(count));
    return count;
  }

  static void checkQueryBearing(const char* name, std::size_t index, const Eigen::Vector3d& bearing) {
    if (!bearing.allFinite() || !(bearing[2] > 0))
      throwInvalid(element(name, index), "must be finite and point forward (z > 0), is " + detail::format(bearing));
  }

  static void checkQueryCamera(const char* offsetName, const char* rotationName, std::size_t index, const Eigen::Vector3d& offset,
                               const Eigen::Matrix3d& rotation) {
    constexpr double kTolerance = 1e-12;
    const std::string reason = "the query camera must be in the origin of its viewpoint (zero offset, identity rotation), is ";
    if (!offset.isZero(kTolerance)) throwInvalid(element(offsetName, index), reason + "at " + detail::format(offset));
    if (!rotation.isIdentity(kTolerance))
      throwInvalid(element(rotationName, index), reason + "turned by " + detail::format(rotation));
  }

  static std::string element(const char* name, std::size_t index) {
    return std::string(name) + "(" + std::to_string(index) + ")";
  }

  [[noreturn]] static void throwInvalid(const std::string& argument, const std::string& reason) {
    throw std::invalid_argument("hybridgv: " + argument + ": " + reason);
  }

  Eigen::Vector3d imagePoint(const Eigen::Vector3d& bearing) const {
    return {nominalFocalLength_ * bearing[0] / bearing[2], nominalFocalLength_ * bearing[1] / bearing[2], 1};
  }

  const RelativeAdapter* relative_;
  const AbsoluteAdapter* absolute_;
  double nominalFocalLength_;
  std::vector<int> camIndices_;
  std::size_t count2d3d_ = 0;
};

}  // namespace hybridgv

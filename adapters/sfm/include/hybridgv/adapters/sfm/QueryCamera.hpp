/// \file
/// \brief The camera of a query image, of which not everything need be known.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "hybridgv/adapters/sfm/Camera.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// Turns the query's keypoints into image points as the adapters want them.
class HYBRIDGV_EXPORT QueryCamera {
 public:
  /// \param camera  kept by reference
  /// \throws std::invalid_argument for a camera that can be neither used nor estimated: of another model than SIMPLE_PINHOLE, PINHOLE,
  ///         SIMPLE_RADIAL, RADIAL and OPENCV unless it is known, or without size and parameters
  QueryCamera(const Camera& camera, CameraKnowledge knowledge);

  /// The image point (u, v, 1) [px] of a keypoint: relative to the principal point, of square pixels, undistorted if the camera is known.
  /// Empty outside of what the camera can see. A plane magnifies the pixels of a fisheye camera by 1/cos^2 of the angle to the axis,
  /// and their noise with them: more than 60 degrees off the axis is left out.
  std::optional<Eigen::Vector3d> imagePoint(double x, double y) const;

  double cx() const { return cx_; }          ///< [px] principal point of a camera that is not known
  double cy() const { return cy_; }          ///< [px] see cx()
  double aspect() const { return aspect_; }  ///< fx / fy of a camera that is not known

 private:
  const Camera& camera_;
  bool isKnown_;
  double cx_ = 0, cy_ = 0, aspect_ = 1;
};

/// The camera, of the same model and principal point, with this focal length (fx) and, where it has a place for it, this k1; no other
/// distortion.
/// \throws std::invalid_argument as QueryCamera, for a camera that is not known
HYBRIDGV_EXPORT Camera estimatedCamera(const Camera& camera, double focalLength, double k1);

}  // namespace sfm
}  // namespace hybridgv

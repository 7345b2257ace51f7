// The camera of a query image, of which not everything need be known.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "hybridgv/adapters/sfm/QueryImage.hpp"

namespace hybridgv {
namespace sfm {

// Turns the query's keypoints into image points as the adapters want them.
class QueryCamera {
 public:
  // std::invalid_argument for a camera that can be neither used nor estimated.
  QueryCamera(const Camera& camera, CameraKnowledge knowledge);

  // Empty outside of what the camera can see. A plane magnifies the pixels of a fisheye camera by 1/cos^2 of the angle to the axis,
  // and their noise with them: more than 60 degrees off the axis is left out.
  std::optional<Eigen::Vector3d> imagePoint(double x, double y) const;

 private:
  const Camera& camera_;
  bool isKnown_;
  double cx_ = 0, cy_ = 0, aspect_ = 1;  // of a camera that is not known
};

}  // namespace sfm
}  // namespace hybridgv

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

  // Of a camera that is not known: the principal point, and fx / fy.
  double cx() const { return cx_; }
  double cy() const { return cy_; }
  double aspect() const { return aspect_; }

 private:
  const Camera& camera_;
  bool isKnown_;
  double cx_ = 0, cy_ = 0, aspect_ = 1;
};

// Of the models that can be estimated: is there a place for k1?
bool hasDistortion(CameraModel model);

// The camera's k1 as of SIMPLE_RADIAL, to first order; 0 if it has none.
double firstDistortion(const Camera& camera);

// Of a camera with an image plane (mapsAPlane): leaves it its size and the shape of its pixels, and where the size is unknown the principal point, for which nothing else can
// stand.
void forgetCalibration(Camera& camera);

// The camera, of the same model and principal point, with this focal length (fx) and, where it has a place for it, this k1; no other
// distortion.
Camera estimatedCamera(const Camera& camera, double focalLength, double k1);

// The same with a model that has a place for k1 in any case.
Camera distortedCamera(const Camera& camera, double focalLength, double k1);

}  // namespace sfm
}  // namespace hybridgv

// What a query's camera has, and what is made of it, within the library.
#pragma once

#include "hybridgv/adapters/sfm/QueryCamera.hpp"

namespace hybridgv {
namespace sfm {

// Of the models that can be estimated: is there a place for k1?
bool hasDistortion(CameraModel model);

// The camera's k1 as of SIMPLE_RADIAL, to first order; 0 if it has none.
double firstDistortion(const Camera& camera);

// Of a camera with an image plane (mapsAPlane): leaves it its size and the shape of its pixels, and where the size is unknown the principal point, for which nothing else can
// stand.
void forgetCalibration(Camera& camera);

// estimatedCamera() with a model that has a place for k1 in any case.
Camera distortedCamera(const Camera& camera, double focalLength, double k1);

}  // namespace sfm
}  // namespace hybridgv

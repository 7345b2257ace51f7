// localize() on arrays, and the cameras' functions on arrays.
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/adapters/sfm/QueryCamera.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "Module.hpp"
#include "Options.hpp"
#include "Values.hpp"

namespace hybridgv {
namespace python {
namespace {

using sfm::CameraKnowledge;

// Image points of those pixels that the camera can see, and which they are.
struct ImagePoints {
  Vectors points;
  std::vector<std::size_t> kept;
  std::size_t count = 0;
};

ImagePoints imagePointsOf(const DoubleArray& pixels, const sfm::QueryCamera& camera) {
  ImagePoints result;
  result.count = static_cast<std::size_t>(pixels.shape(0));
  result.points.reserve(result.count);
  result.kept.reserve(result.count);
  const double* values = pixels.data();
  for (std::size_t i = 0; i < result.count; ++i) {
    if (const auto point = camera.imagePoint(values[2 * i], values[2 * i + 1])) {
      result.points.push_back(*point);
      result.kept.push_back(i);
    }
  }
  return result;
}

Vectors selected(Vectors all, const std::vector<std::size_t>& kept) {
  if (all.size() == kept.size()) return all;
  Vectors result;
  for (const std::size_t i : kept) result.push_back(all[i]);
  return result;
}

// Of as many weights as there are elements; none where there are none.
std::vector<double> selectedWeights(const char* name, const py::object& weights, const ImagePoints& points) {
  if (weights.is_none()) return {};
  const DoubleArray all = numbersOf(name, weights);
  checkCount(name, all.size(), "the correspondences", static_cast<py::ssize_t>(points.count));
  std::vector<double> result;
  for (const std::size_t i : points.kept) result.push_back(all.data()[i]);
  return result;
}

// The same of numbers of keypoints.
std::vector<int> selectedKeypoints(const char* name, const py::object& keypoints, const ImagePoints& points) {
  if (keypoints.is_none()) return {};
  const IndexArray all = indicesOf(name, keypoints, 0);
  checkCount(name, all.size(), "the correspondences", static_cast<py::ssize_t>(points.count));
  std::vector<int> result;
  for (const std::size_t i : points.kept) {
    const long long keypoint = all.data()[i];
    if (keypoint > std::numeric_limits<int>::max())
      throw std::invalid_argument(std::string(name) + "[" + std::to_string(i) + "] is " + std::to_string(keypoint) +
                                  ", at most 2^31 - 1 is possible");
    result.push_back(static_cast<int>(std::max(keypoint, -1LL)));
  }
  return result;
}

// The rig: cameras without a rotation, since rays are given in the frame of the map.
struct Rig {
  Vectors origins;
  std::vector<double> focalLengths;
  std::vector<int> cameras;  // of each ray
};

std::vector<double> focalLengthsOf(const py::object& values, const char* other, std::size_t count) {
  if (values.is_none()) return std::vector<double>(count, 0);
  const DoubleArray array = numbersOf("rig_focal_lengths", values);
  checkCount("rig_focal_lengths", array.size(), other, static_cast<py::ssize_t>(count));
  return listOf(array);
}

// An origin for each ray: those that follow each other and are equal share a camera.
Rig rigOfRays(const Vectors& origins, const py::object& focalLengths) {
  const std::vector<double> lengths = focalLengthsOf(focalLengths, "ray_origins", origins.size());
  Rig rig;
  for (std::size_t i = 0; i < origins.size(); ++i) {
    if (rig.origins.empty() || rig.origins.back() != origins[i] || rig.focalLengths.back() != lengths[i]) {
      rig.origins.push_back(origins[i]);
      rig.focalLengths.push_back(lengths[i]);
    }
    rig.cameras.push_back(static_cast<int>(rig.origins.size()) - 1);
  }
  return rig;
}

Rig rigOfCameras(Vectors origins, const py::object& indices, const py::object& focalLengths) {
  const IndexArray cameras = indicesOf("camera_idxs", indices, 0);
  Rig rig{std::move(origins), {}, {}};
  rig.focalLengths = focalLengthsOf(focalLengths, "ray_origins", rig.origins.size());
  for (py::ssize_t i = 0; i < cameras.size(); ++i) {
    const long long camera = cameras.data()[i];
    if (camera < 0 || camera >= static_cast<long long>(rig.origins.size()))
      throw std::invalid_argument("camera_idxs[" + std::to_string(i) + "] is " + std::to_string(camera) + ", ray_origins has " +
                                  std::to_string(rig.origins.size()));
    rig.cameras.push_back(static_cast<int>(camera));
  }
  return rig;
}

// What localize() is given about rays.
struct Rays {
  DoubleArray pixels;
  Vectors directions;
  Rig rig;
};

Rays raysOf(const py::object& pixels, const py::object& directions, const py::object& origins, const py::object& indices,
            const py::object& focalLengths) {
  if (pixels.is_none() && directions.is_none() && origins.is_none()) return {rowsOf("points2D_rays", py::list(), 2), {}, {}};
  Rays rays{rowsOf("points2D_rays", pixels, 2), vectorsOf(rowsOf("ray_directions", directions, 3)), {}};
  Vectors centres = vectorsOf(rowsOf("ray_origins", origins, 3));
  const py::ssize_t count = rays.pixels.shape(0);
  checkCount("ray_directions", static_cast<py::ssize_t>(rays.directions.size()), "points2D_rays", count);
  if (indices.is_none()) {
    checkCount("ray_origins", static_cast<py::ssize_t>(centres.size()), "points2D_rays", count);
    rays.rig = rigOfRays(centres, focalLengths);
  } else {
    rays.rig = rigOfCameras(std::move(centres), indices, focalLengths);
    checkCount("camera_idxs", static_cast<py::ssize_t>(rays.rig.cameras.size()), "points2D_rays", count);
  }
  return rays;
}

// Takes what it is given: there may be many correspondences.
NoncentralHybridAdapter adapterOf(ImagePoints& rayPoints, Rays& rays, ImagePoints& points, Vectors positions) {
  std::vector<int> cameras;
  cameras.reserve(rayPoints.kept.size());
  for (const std::size_t i : rayPoints.kept) cameras.push_back(rays.rig.cameras[i]);
  std::vector<Eigen::Matrix3d> rotations(rays.rig.origins.size(), Eigen::Matrix3d::Identity());
  return {std::move(rayPoints.points),
          selected(std::move(rays.directions), rayPoints.kept),
          std::move(cameras),
          std::move(rays.rig.origins),
          std::move(rotations),
          std::move(points.points),
          selected(std::move(positions), points.kept)};
}

bool isPinhole(sfm::CameraModel model) { return model == sfm::CameraModel::SimplePinhole || model == sfm::CameraModel::Pinhole; }

// The search, with what is known of the camera.
sac::HybridRansacOptions searchOptions(const sfm::QueryOptions& options, const sfm::Camera& camera, CameraKnowledge knowledge) {
  sac::HybridRansacOptions result = options.ransac;
  const bool isRadial = options.estimateDistortion && knowledge != CameraKnowledge::Known && !isPinhole(camera.model);
  result.queryCamera = isRadial ? sac::QueryCamera::Radial : sac::QueryCamera::Pinhole;
  if (isRadial && result.imageRadiusPx == 0)
    result.imageRadiusPx = std::hypot(static_cast<double>(camera.width), static_cast<double>(camera.height)) / 2;
  if (knowledge == CameraKnowledge::Known) result.knownFocalLengthPx = focalLength(camera);
  if (knowledge == CameraKnowledge::Prior) {
    result.focalLengthPriorPx = focalLength(camera);
    result.focalLengthPriorLogDeviation = options.priorDeviation;
  }
  return result;
}

py::dict localize(const py::object& points2D, const py::object& points3D, const py::object& points2DRays,
                  const py::object& rayDirections, const py::object& rayOrigins, const py::object& cameraIndices,
                  const py::object& rigFocalLengths, const py::object& weights, const py::object& weightsRays,
                  const py::object& keypoints, const py::object& keypointsRays, const py::tuple& cameraTuple,
                  const std::string& cameraKnowledge, const py::dict& optionDict) {
  const sfm::Camera camera = cameraOf(cameraTuple);
  const CameraKnowledge knowledge = knowledgeOf(cameraKnowledge);
  const sac::HybridRansacOptions options = searchOptions(optionsOf(optionDict), camera, knowledge);
  const sfm::QueryCamera queryCamera(camera, knowledge);
  const DoubleArray pixels = rowsOf("points2D", points2D, 2);
  Vectors positions = vectorsOf(rowsOf("points3D", points3D, 3));
  checkCount("points3D", static_cast<py::ssize_t>(positions.size()), "points2D", pixels.shape(0));
  Rays rays = raysOf(points2DRays, rayDirections, rayOrigins, cameraIndices, rigFocalLengths);
  ImagePoints points = imagePointsOf(pixels, queryCamera), rayPoints = imagePointsOf(rays.pixels, queryCamera);
  NoncentralHybridAdapter adapter = adapterOf(rayPoints, rays, points, std::move(positions));
  adapter.setRigFocalLengths(rays.rig.focalLengths);
  adapter.setWeights(selectedWeights("weights_rays", weightsRays, rayPoints), selectedWeights("weights", weights, points));
  adapter.setFeatures(selectedKeypoints("keypoint_idxs_rays", keypointsRays, rayPoints),
                      selectedKeypoints("keypoint_idxs", keypoints, points));
  sac::HybridRansacResult result;
  {
    const py::gil_scoped_release release;
    result = hybridRansac(adapter, options);
  }
  py::dict dict = dictOf(result);
  dict["inlier_mask"] = maskOf(result.inliers2d3d, points.kept, points.count);
  dict["inlier_mask_rays"] = maskOf(result.inliers2d2d, rayPoints.kept, rayPoints.count);
  const bool isEstimated = knowledge != CameraKnowledge::Known && result.score > 0;
  dict["camera"] = dictOf(isEstimated ? estimatedCamera(camera, result.simpleRadialFocalLength, result.simpleRadialK1) : camera);
  return dict;
}

// What `make` makes of each pixel, rows of zeros where that is nothing, and whether it is something.
template <class Make>
py::tuple forEachPixel(const py::object& points2D, py::ssize_t columns, const Make& make) {
  const DoubleArray pixels = rowsOf("points2D", points2D, 2);
  const py::ssize_t count = pixels.shape(0);
  py::array_t<double> values(std::vector<py::ssize_t>{count, columns});
  py::array_t<bool> isValid(count);
  double* value = values.mutable_data();
  for (py::ssize_t i = 0; i < count; ++i) {
    const std::optional<Eigen::Vector3d> made = make(pixels.data()[2 * i], pixels.data()[2 * i + 1]);
    isValid.mutable_data()[i] = made.has_value();
    for (py::ssize_t k = 0; k < columns; ++k) *value++ = made ? (*made)[k] : 0;
  }
  return py::make_tuple(values, isValid);
}

py::tuple undistortPixels(const py::object& points2D, const py::tuple& cameraTuple) {
  const sfm::Camera camera = cameraOf(cameraTuple);
  return forEachPixel(points2D, 2, [&](double x, double y) { return undistort(camera, x, y); });
}

py::tuple distortPoints(const py::object& points2D, const py::tuple& cameraTuple) {
  const sfm::Camera camera = cameraOf(cameraTuple);
  return forEachPixel(points2D, 2, [&](double u, double v) { return distort(camera, Eigen::Vector3d(u, v, 1)); });
}

py::tuple bearingVectors(const py::object& points2D, const py::tuple& cameraTuple) {
  const sfm::Camera camera = cameraOf(cameraTuple);
  return forEachPixel(points2D, 3, [&](double x, double y) { return bearingVector(camera, x, y); });
}

}  // namespace

void addLocalize(py::module_& module) {
  module.def("localize", &localize, py::arg("points2D"), py::arg("points3D"), py::arg("points2D_rays"), py::arg("ray_directions"),
             py::arg("ray_origins"), py::arg("camera_idxs"), py::arg("rig_focal_lengths"), py::arg("weights"),
             py::arg("weights_rays"), py::arg("keypoint_idxs"), py::arg("keypoint_idxs_rays"), py::arg("camera"),
             py::arg("camera_knowledge"), py::arg("options"));
  module.def("default_options", [] { return dictOf(sfm::QueryOptions()); });
  module.def("undistort", &undistortPixels, py::arg("points2D"), py::arg("camera"));
  module.def("distort", &distortPoints, py::arg("points2D"), py::arg("camera"));
  module.def("bearing_vectors", &bearingVectors, py::arg("points2D"), py::arg("camera"));
}

}  // namespace python
}  // namespace hybridgv

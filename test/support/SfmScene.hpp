// Exact sparse models: points in a box, images around it with every camera model.
#pragma once

#include <Eigen/Geometry>

#include "Random.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"

namespace hybridgv {
namespace test {

inline sfm::Camera makeCamera(sfm::CameraModel model, std::uint32_t id = 1) {
  sfm::Camera camera;
  camera.id = id;
  camera.model = model;
  camera.width = 1000;
  camera.height = 800;
  switch (model) {
    case sfm::CameraModel::SimplePinhole:
      camera.parameters = {700, 510, 390};
      break;
    case sfm::CameraModel::Pinhole:
      camera.parameters = {720, 690, 510, 390};
      break;
    case sfm::CameraModel::SimpleRadial:
      camera.parameters = {650, 500, 400, -0.11};
      break;
    case sfm::CameraModel::Radial:
      camera.parameters = {800, 495, 405, -0.2, 0.06};
      break;
    case sfm::CameraModel::OpenCV:
      camera.parameters = {760, 770, 505, 395, -0.15, 0.03, 0.0015, -0.001};
      break;
    case sfm::CameraModel::OpenCVFisheye:
      camera.parameters = {420, 425, 503, 398, 0.03, -0.008, 0.002, -0.0004};
      break;
    case sfm::CameraModel::FullOpenCV:
      camera.parameters = {700, 705, 502, 402, -0.21, 0.06, 0.0004, -0.0003, -0.01, 0.03, -0.012, 0.002};
      break;
    case sfm::CameraModel::Fov:
      camera.parameters = {600, 610, 505, 395, 0.9};
      break;
    case sfm::CameraModel::SimpleRadialFisheye:
      camera.parameters = {430, 500, 400, -0.02};
      break;
    case sfm::CameraModel::RadialFisheye:
      camera.parameters = {440, 498, 402, 0.02, -0.004};
      break;
    case sfm::CameraModel::ThinPrismFisheye:
      camera.parameters = {450, 455, 502, 401, 0.02, -0.01, 0.001, -0.0008, 0.002, -0.0003, 0.0006, -0.0005};
      break;
    case sfm::CameraModel::RadTanThinPrismFisheye:
      camera.parameters = {400,  402,   501,    399,     0.03,   -0.01, 0.003,   -0.0006,
                           1e-4, -1e-5, 0.0007, -0.0005, 0.0008, -1e-4, -0.0006, 1e-4};
      break;
    case sfm::CameraModel::SimpleDivision:
      camera.parameters = {650, 500, 400, -0.2};
      break;
    case sfm::CameraModel::Division:
      camera.parameters = {660, 670, 505, 405, 0.05};
      break;
    case sfm::CameraModel::SimpleFisheye:
      camera.parameters = {380, 500, 400};
      break;
    case sfm::CameraModel::Fisheye:
      camera.parameters = {390, 395, 505, 398};
      break;
    case sfm::CameraModel::Eucm:
      camera.parameters = {500, 505, 502, 398, 0.6, 1.1};
      break;
    case sfm::CameraModel::Equirectangular:
      camera.parameters = {1000, 800};
      break;
    case sfm::CameraModel::NvmRadial:
      camera.parameters = {710, 705, 0, 0, 0.08};
      break;
    case sfm::CameraModel::Unknown:
      break;
  }
  return camera;
}

// All of COLMAP's.
inline const std::vector<sfm::CameraModel>& colmapModels() {
  static const std::vector<sfm::CameraModel> models = [] {
    std::vector<sfm::CameraModel> result;
    for (int number = 0; number <= static_cast<int>(sfm::CameraModel::Equirectangular); ++number)
      result.push_back(static_cast<sfm::CameraModel>(number));
    return result;
  }();
  return models;
}

// Images at distance about 8 of the origin look at points within 2 of it; every point is seen by each image with probability
// `visibility`. Ids differ from indices; every image has some features without a point.
inline sfm::SparseModel makeScene(Random& random, std::size_t images, std::size_t points, double visibility,
                                  const std::vector<sfm::CameraModel>& models) {
  sfm::SparseModel model;
  for (std::size_t i = 0; i < models.size(); ++i)
    model.cameras.push_back(makeCamera(models[i], static_cast<std::uint32_t>(100 + 3 * i)));
  for (std::size_t i = 0; i < images; ++i) {
    sfm::Image image;
    image.id = static_cast<std::uint32_t>(1000 - 7 * i);
    image.name = "photo " + std::to_string(i) + ".jpg";
    image.camera = i % models.size();
    image.position = random.direction() * random.uniform(7, 9);
    const Eigen::Vector3d forward = (random.vector(-0.5, 0.5) - image.position).normalized();
    const Eigen::Vector3d right = forward.cross(random.direction()).normalized();
    image.rotation << right, forward.cross(right), forward;
    model.images.push_back(image);
  }
  for (std::size_t p = 0; p < points; ++p) {
    sfm::Point point;
    point.id = 5 + 2 * p;
    point.position = random.vector(-1.5, 1.5);
    point.error = random.uniform();
    for (std::uint8_t& channel : point.colour) channel = static_cast<std::uint8_t>(random.index(256));
    for (std::size_t i = 0; i < images; ++i) {
      if (random.uniform() > visibility) continue;
      sfm::Image& image = model.images[i];
      const sfm::Camera& camera = model.cameras[image.camera];
      const Eigen::Vector3d x = image.rotation.transpose() * (point.position - image.position);
      const auto pixel = sfm::project(camera, x);
      if (!pixel) continue;
      if (random.index(4) == 0) image.observations.push_back({random.uniform(0, 1000), random.uniform(0, 800)});
      point.track.push_back({i, image.observations.size()});
      image.observations.push_back({(*pixel)[0], (*pixel)[1], p});
    }
    model.points.push_back(point);
  }
  return model;
}

}  // namespace test
}  // namespace hybridgv

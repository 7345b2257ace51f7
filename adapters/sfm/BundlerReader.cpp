#include <Eigen/Geometry>

#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The shortest records, one character per number and one blank after each.
constexpr std::size_t kCameraBytes = std::size_t{15} * 2;
constexpr std::size_t kPointBytes = std::size_t{7} * 2;
constexpr std::size_t kViewBytes = std::size_t{4} * 2;

Eigen::Vector3d readVector(TextScanner& in, const char* what) {
  const double x = in.number(what), y = in.number(what), z = in.number(what);
  return {x, y, z};
}

// f k1 k2, R (three rows), t:  x = R X + t, the camera looks along -z and the image's y axis points up.
void readCamera(TextScanner& in, std::size_t index, SparseModel& model) {
  constexpr double kTolerance = 1e-3;  // of R^T R = I
  Camera& camera = model.cameras.emplace_back();
  Image& image = model.images.emplace_back();
  camera.id = image.id = static_cast<std::uint32_t>(index);
  camera.model = CameraModel::Radial;
  image.name = "image_" + std::to_string(index);
  image.camera = index;
  const Eigen::Vector3d intrinsics = readVector(in, "focal length and distortion of a camera");
  camera.parameters = {intrinsics[0], 0, 0, intrinsics[1], intrinsics[2]};
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row) rotation.row(row) = readVector(in, "the rotation of a camera").transpose();
  const Eigen::Vector3d translation = readVector(in, "the translation of a camera");
  image.registered = intrinsics[0] != 0;
  if (!image.registered) return;
  if (intrinsics[0] < 0) in.fail("the focal length of camera " + std::to_string(index) + " is negative");
  const Eigen::Matrix3d error = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
  if (!(error.cwiseAbs().maxCoeff() < kTolerance) || rotation.determinant() < 0)
    in.fail("the matrix of camera " + std::to_string(index) + " is not a rotation");
  const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, -1).asDiagonal();
  image.rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix().transpose() * flip;
  image.position = -(image.rotation * (flip * translation));
  if (!image.position.allFinite()) in.fail("the position of camera " + std::to_string(index) + " is not finite");
}

// X, colour, number of views; each view: camera, key, x, y
void readPoint(TextScanner& in, std::size_t index, SparseModel& model) {
  Point& point = model.points.emplace_back();
  point.id = index;
  point.position = readVector(in, "the position of a point");
  for (std::uint8_t& channel : point.colour) channel = in.integer<std::uint8_t>("the colour of a point");
  const std::size_t views = in.count("the number of views of a point", kViewBytes);
  point.track.reserve(views);
  for (std::size_t i = 0; i < views; ++i) {
    const auto view = in.integer<std::size_t>("the camera of a view");
    if (view >= model.images.size()) in.fail("there is no camera " + std::to_string(view));
    if (!model.images[view].registered) in.fail("camera " + std::to_string(view) + " has no pose and sees a point");
    in.integer<std::int64_t>("the key of a view");
    const double x = in.number("the position of a view"), y = in.number("the position of a view");
    std::vector<Observation>& observations = model.images[view].observations;
    point.track.push_back({view, observations.size()});
    observations.push_back({x, -y, index});
  }
}

}  // namespace

SparseModel readBundler(const std::string& path) {
  TextScanner in(path, TextScanner::Layout::Free);
  if (in.restOfLine() != "# Bundle file v0.3") throw FileError::atLine(path, 1, "expected '# Bundle file v0.3'");
  in.skipComments();
  SparseModel model;
  const std::size_t cameras = in.count("the number of cameras", kCameraBytes);
  const std::size_t points = in.count("the number of points", kPointBytes);
  model.images.reserve(cameras);
  model.points.reserve(points);
  for (std::size_t i = 0; i < cameras; ++i) readCamera(in, i, model);
  for (std::size_t i = 0; i < points; ++i) readPoint(in, i, model);
  if (!in.atEnd()) in.fail("there is more after the last point");
  return model;
}

}  // namespace sfm
}  // namespace hybridgv

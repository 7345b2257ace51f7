#include <Eigen/Core>

#include "Consistency.hpp"
#include "ModelLinks.hpp"
#include "PointList.hpp"
#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The shortest record, one character per number and one blank after each.
constexpr std::size_t kCameraBytes = std::size_t{15} * 2;

Eigen::Vector3d readVector(TextScanner& in, const char* what) {
  const double x = in.anyNumber(what), y = in.anyNumber(what), z = in.anyNumber(what);
  return {x, y, z};
}

// f k1 k2, R (three rows), t:  x = R X + t, the camera looks along -z and the image's y axis points up.
void readCamera(TextScanner& in, std::size_t index, SparseModel& model) {
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
  image.registered = false;
  if (intrinsics[0] == 0) return;
  const auto leaveOut = [&](Mend mend, const std::string& reason) {
    in.mending().note(mend, [&] { return in.error("camera " + std::to_string(index) + ": " + reason); });
  };
  if (!intrinsics.allFinite() || intrinsics[0] < 0) {
    leaveOut(Mend::UnusableCamera, intrinsics[0] < 0 ? "the focal length is negative" : "a parameter is not finite");
    return;
  }
  Image posed;
  const std::string fault = setPoseFromMatrix(rotation, translation, posed);
  if (!fault.empty()) {
    leaveOut(Mend::ImageWithoutUsablePose, fault);
    return;
  }
  image.registered = true;
  image.rotation = posed.rotation * Eigen::Vector3d(1, -1, -1).asDiagonal();
  image.position = posed.position;
}

}  // namespace

SparseModel readBundler(const std::string& path, const ReadOptions& options, ReadReport* report) {
  Mending mending(options, report);
  TextScanner in(path, TextScanner::Layout::Free, mending);
  if (in.restOfLine() != "# Bundle file v0.3") throw FileError::atLine(path, 1, "expected '# Bundle file v0.3'");
  in.skipComments();
  SparseModel model;
  const std::size_t cameras = in.count("the number of cameras", kCameraBytes);
  const std::size_t points = in.count("the number of points", kListedPointBytes);
  model.images.reserve(cameras);
  for (std::size_t i = 0; i < cameras; ++i) readCamera(in, i, model);
  readPointList(in, points, "camera", -1, model);
  if (!in.atEnd()) in.fail("there is more after the last point");
  checkConsistency(path, mending, model);
  return model;
}

}  // namespace sfm
}  // namespace hybridgv

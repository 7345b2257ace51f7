#include <algorithm>

#include "ModelLinks.hpp"
#include "Printable.hpp"
#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The shortest records, one character per word and one blank after each.
constexpr std::size_t kCameraBytes = std::size_t{11} * 2;
constexpr std::size_t kPointBytes = std::size_t{7} * 2;
constexpr std::size_t kMeasurementBytes = std::size_t{4} * 2;

// Common intrinsics of all images: "FixedK fx cx fy cy" after the format's name.
struct FixedCalibration {
  bool isGiven = false;
  double fx = 0, fy = 0;
};

FixedCalibration readHeader(TextScanner& in) {
  FixedCalibration result;
  const std::string_view format = in.word("NVM_V3");
  if (format != "NVM_V3") in.fail("expected the format NVM_V3, found '" + printable(format) + "'");
  if (in.lineEnds()) return result;
  const std::string_view option = in.word("FixedK");
  if (option != "FixedK") in.fail("expected FixedK or the end of the line, found '" + printable(option) + "'");
  result.isGiven = true;
  result.fx = in.number("fx");
  in.number("cx");  // image positions are relative to the principal point
  result.fy = in.number("fy");
  in.number("cy");
  if (!(result.fx > 0) || !(result.fy > 0)) in.fail("the focal lengths of FixedK must be positive");
  if (!in.lineEnds()) in.fail("FixedK must be followed by four numbers");
  return result;
}

// name, f, quaternion (w, x, y, z) of model -> camera, centre, radial distortion, 0
void readCamera(TextScanner& in, std::size_t index, const FixedCalibration& calibration, SparseModel& model) {
  Camera& camera = model.cameras.emplace_back();
  Image& image = model.images.emplace_back();
  camera.id = image.id = static_cast<std::uint32_t>(index);
  camera.model = CameraModel::NvmRadial;
  image.camera = index;
  image.name = in.word("the name of an image");
  std::replace(image.name.begin(), image.name.end(), '"', ' ');
  const double f = in.number("the focal length of an image");
  if (!(f > 0)) in.fail("the focal length of image " + std::to_string(index) + " must be positive, is " + detail::format(f));
  double q[4];
  for (double& coefficient : q) coefficient = in.number("the quaternion of an image");
  const std::string fault = setPoseFromQuaternion(q, Eigen::Vector3d::Zero(), image);
  if (!fault.empty()) in.fail(fault);
  for (double& coordinate : image.position) coordinate = in.number("the centre of an image");
  const double distortion = in.number("the radial distortion of an image");
  in.number("the 0 after the radial distortion");
  camera.parameters = {calibration.isGiven ? calibration.fx : f, calibration.isGiven ? calibration.fy : f, 0, 0, distortion};
}

// X, colour, number of measurements; each measurement: image, feature, x, y
void readPoint(TextScanner& in, std::size_t index, SparseModel& model) {
  Point& point = model.points.emplace_back();
  point.id = index;
  for (double& coordinate : point.position) coordinate = in.number("the position of a point");
  for (std::uint8_t& channel : point.colour) channel = in.integer<std::uint8_t>("the colour of a point");
  const std::size_t measurements = in.count("the number of measurements of a point", kMeasurementBytes);
  point.track.reserve(measurements);
  for (std::size_t i = 0; i < measurements; ++i) {
    const auto image = in.integer<std::size_t>("the image of a measurement");
    if (image >= model.images.size()) in.fail("there is no image " + std::to_string(image));
    in.integer<std::int64_t>("the feature of a measurement");
    const double x = in.number("the position of a measurement"), y = in.number("the position of a measurement");
    std::vector<Observation>& observations = model.images[image].observations;
    point.track.push_back({image, observations.size()});
    observations.push_back({x, y, index});
  }
}

SparseModel readOneModel(TextScanner& in, std::size_t images, const FixedCalibration& calibration) {
  SparseModel model;
  model.images.reserve(images);
  for (std::size_t i = 0; i < images; ++i) readCamera(in, i, calibration, model);
  const std::size_t points = in.count("the number of points", kPointBytes);
  model.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i) readPoint(in, i, model);
  return model;
}

// After the last model: how many models have a PLY file, and which ones, between comments.
void checkEpilogue(TextScanner& in) {
  in.skipComments();
  if (in.atEnd()) return;
  const std::size_t files = in.count("the number of PLY files", 2);
  for (std::size_t i = 0; i < files; ++i) in.integer<std::size_t>("the model of a PLY file");
  in.skipComments();
  if (!in.atEnd()) in.fail("there is more after the list of PLY files");
}

}  // namespace

SparseModel readNvm(const std::string& path) {
  TextScanner in(path, TextScanner::Layout::Free);
  const FixedCalibration calibration = readHeader(in);
  SparseModel first = readOneModel(in, in.count("the number of images", kCameraBytes), calibration);
  while (!in.atEnd()) {
    const std::size_t images = in.count("the number of images", kCameraBytes);
    if (images == 0) {
      checkEpilogue(in);
      break;
    }
    readOneModel(in, images, calibration);
  }
  return first;
}

}  // namespace sfm
}  // namespace hybridgv

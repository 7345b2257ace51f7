#include <algorithm>

#include "CameraModels.hpp"
#include "Consistency.hpp"
#include "ModelLinks.hpp"
#include "PointList.hpp"
#include "Printable.hpp"
#include "TextScanner.hpp"
#include "doubleFromChars.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "hybridgv/detail/format.hpp"
#include "imageName.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// The shortest record, one character per word and one blank after each.
constexpr std::size_t kCameraBytes = std::size_t{11} * 2;

// The format's name, and common intrinsics of all images: "FixedK fx cx fy cy" after it.
struct Header {
  bool hasMatrices = false;  // NVM_V3_R9T: rotation matrix and translation instead of quaternion and centre
  bool isCalibrated = false;
  double fx = 0, fy = 0;
};

Header readHeader(TextScanner& in) {
  Header result;
  const std::string_view format = in.word("NVM_V3");
  result.hasMatrices = format == "NVM_V3_R9T";
  if (format != "NVM_V3" && !result.hasMatrices)
    in.fail("expected the format NVM_V3 or NVM_V3_R9T, found '" + printable(format) + "'");
  if (in.lineEnds()) return result;
  const std::string_view option = in.word("FixedK");
  if (option != "FixedK") in.fail("expected FixedK or the end of the line, found '" + printable(option) + "'");
  result.isCalibrated = true;
  result.fx = in.number("fx");
  in.number("cx");  // image positions are relative to the principal point
  result.fy = in.number("fy");
  in.number("cy");
  if (!(result.fx > 0) || !(result.fy > 0)) in.fail("the focal lengths of FixedK must be positive");
  if (!in.lineEnds()) in.fail("FixedK must be followed by four numbers");
  return result;
}

bool isNumber(std::string_view word) {
  double value = 0;
  const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
  const auto result = doubleFromChars(begin, word.data() + word.size(), value);
  return result.ec != std::errc::invalid_argument && result.ptr == word.data() + word.size();
}

std::vector<std::string_view> wordsOf(std::string_view line) {
  constexpr const char* kBlanks = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

// The first word, in which a double quote stands for a space; or, if `numbers` numbers at the end of the line leave several words,
// all of these: a name whose spaces are not quoted.
std::string readName(TextScanner& in, std::size_t numbers) {
  const std::vector<std::string_view> words = wordsOf(in.peekLine());
  const auto areNumbers = [&](std::size_t first) {
    return std::all_of(words.begin() + static_cast<std::ptrdiff_t>(first),
                       words.begin() + static_cast<std::ptrdiff_t>(first + numbers), isNumber);
  };
  const std::size_t standard = numbers + 1;
  const bool hasSpaces =
      words.size() > standard && areNumbers(words.size() - numbers) && (words.size() % standard != 0 || !areNumbers(1));
  if (hasSpaces) {
    const std::string_view last = words[words.size() - numbers - 1];
    const std::string_view name(words.front().data(), static_cast<std::size_t>(last.data() + last.size() - words.front().data()));
    in.mending().note(Mend::NameWithSpaces, [&] { return in.error("the image name '" + printable(name) + "' has spaces"); });
    in.skipTo(name);
    return std::string(name);
  }
  std::string name(in.word("the name of an image"));
  std::replace(name.begin(), name.end(), '"', ' ');
  return name;
}

// Quaternion (w, x, y, z) of model -> camera and centre, or rotation matrix (row by row) and translation. Empty, or what is wrong.
std::string readPose(TextScanner& in, bool hasMatrices, Image& image) {
  if (hasMatrices) {
    Eigen::Matrix3d rotation;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) rotation(row, column) = in.anyNumber("the rotation of an image");
    Eigen::Vector3d translation;
    for (double& coordinate : translation) coordinate = in.anyNumber("the translation of an image");
    return setPoseFromMatrix(rotation, translation, image);
  }
  double q[4];
  for (double& coefficient : q) coefficient = in.anyNumber("the quaternion of an image");
  const std::string fault = setPoseFromQuaternion(q, Eigen::Vector3d::Zero(), image);
  for (double& coordinate : image.position) coordinate = in.anyNumber("the centre of an image");
  return !fault.empty() || image.position.allFinite() ? fault : "the centre is not finite";
}

// name, f, pose, radial distortion, 0
void readCamera(TextScanner& in, std::size_t index, const Header& header, SparseModel& model) {
  constexpr std::size_t kNumbers = 10, kNumbersWithMatrix = 15;
  Camera& camera = model.cameras.emplace_back();
  Image& image = model.images.emplace_back();
  camera.id = image.id = static_cast<std::uint32_t>(index);
  camera.model = CameraModel::NvmRadial;
  image.camera = index;
  image.name = usableName(in, in.mending(), readName(in, header.hasMatrices ? kNumbersWithMatrix : kNumbers), image.id);
  const double f = in.anyNumber("the focal length of an image");
  Image posed;
  const std::string fault = readPose(in, header.hasMatrices, posed);
  const double distortion = in.anyNumber("the radial distortion of an image");
  in.anyNumber("the 0 after the radial distortion");
  camera.parameters = {header.isCalibrated ? header.fx : f, header.isCalibrated ? header.fy : f, 0, 0, distortion};
  const std::string cameraFault = findCameraFault(camera);
  image.registered = fault.empty() && cameraFault.empty();
  if (image.registered) {
    image.rotation = posed.rotation;
    image.position = posed.position;
    return;
  }
  const bool hasFaultyCamera = !cameraFault.empty();
  in.mending().note(hasFaultyCamera ? Mend::UnusableCamera : Mend::ImageWithoutUsablePose,
                    [&] { return in.error("image " + std::to_string(index) + ": " + (hasFaultyCamera ? cameraFault : fault)); });
}

SparseModel readOneModel(TextScanner& in, std::size_t images, const Header& header) {
  SparseModel model;
  model.images.reserve(images);
  for (std::size_t i = 0; i < images; ++i) readCamera(in, i, header, model);
  readPointList(in, in.count("the number of points", kListedPointBytes), "image", 1, model);
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

SparseModel readNvm(const std::string& path, const ReadOptions& options, ReadReport* report) {
  Mending mending(options, report);
  TextScanner in(path, TextScanner::Layout::Free, mending);
  const Header header = readHeader(in);
  SparseModel first = readOneModel(in, in.count("the number of images", kCameraBytes), header);
  while (!in.atEnd()) {
    const std::size_t images = in.count("the number of images", kCameraBytes);
    if (images == 0) {
      checkEpilogue(in);
      break;
    }
    readOneModel(in, images, header);
  }
  checkConsistency(path, mending, first);
  return first;
}

}  // namespace sfm
}  // namespace hybridgv

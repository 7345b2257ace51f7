#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string_view>

#include "FileContents.hpp"
#include "ModelLinks.hpp"
#include "NumberWriter.hpp"
#include "Printable.hpp"
#include "TextScanner.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/detail/format.hpp"

namespace hybridgv {
namespace sfm {
namespace {

Eigen::Vector3d readVector(TextScanner& in, const char* what) {
  const double x = in.number(what), y = in.number(what), z = in.number(what);
  return {x, y, z};
}

Eigen::Vector3d readImagePoint(TextScanner& in) {
  const double u = in.number("u"), v = in.number("v");
  return {u, v, 1};
}

std::vector<std::string_view> linesOf(std::string_view text) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// The lines of a problem file, rig cameras still by their ids.
struct Lines {
  std::optional<FocalPose> reference;
  std::map<std::int64_t, std::size_t> cameraIndices;  // id -> index into centres
  std::uint32_t imageWidth = 0, imageHeight = 0;
  std::vector<double> focalLengths;  // of the rig cameras
  NoncentralHybridAdapter::Matrices rotations;
  NoncentralHybridAdapter::Vectors centres, imagePoints2d2d, directions, imagePoints2d3d, points;
  std::vector<std::int64_t> cameraIds;        // of the 2D-2D correspondences
  std::vector<std::size_t> cameraIdLocation;  // their lines in the file
};

bool lineGoesOn(TextScanner& in) {
  const std::string_view rest = in.peekLine();
  return !rest.empty() && rest.front() != '#';
}

// The rotation of a frame into the query's or the rig's, as matrix R(q)^T.
Image readPose(TextScanner& in, bool withTranslation) {
  double q[4];
  for (double& coefficient : q) coefficient = in.number("the quaternion");
  Image image;
  const Eigen::Vector3d translation = withTranslation ? readVector(in, "the translation") : Eigen::Vector3d(0, 0, 0);
  const std::string fault = setPoseFromQuaternion(q, translation, image);
  if (!fault.empty()) in.fail(fault);
  return image;
}

double readFocalLength(TextScanner& in) {
  const double focalLength = in.number("the focal length");
  if (!(focalLength >= 0)) in.fail("the focal length must not be negative, is " + detail::format(focalLength));
  return focalLength;
}

void readImageSize(TextScanner& in, Lines& lines) {
  if (lines.imageWidth > 0) in.fail("there is a second 'image' line");
  lines.imageWidth = in.integer<std::uint32_t>("the image's width");
  lines.imageHeight = in.integer<std::uint32_t>("the image's height");
  if (lines.imageWidth == 0 || lines.imageHeight == 0) in.fail("the image's size must be positive");
}

void readReference(TextScanner& in, Lines& lines) {
  if (lines.reference) in.fail("there is a second 'query' line");
  FocalPose pose;
  pose.focalLength = readFocalLength(in);
  if (pose.focalLength == 0) in.fail("the focal length must be positive, is " + detail::format(pose.focalLength));
  const Image image = readPose(in, true);
  pose.rotation = image.rotation;
  pose.position = image.position;
  lines.reference = pose;
}

void readRigCamera(TextScanner& in, Lines& lines) {
  const auto id = in.integer<std::int64_t>("the camera's id");
  if (!lines.cameraIndices.emplace(id, lines.centres.size()).second) in.fail("camera " + std::to_string(id) + " occurs twice");
  lines.centres.push_back(readVector(in, "the camera's centre"));
  const bool isComplete = lineGoesOn(in);
  lines.focalLengths.push_back(isComplete ? readFocalLength(in) : 0);
  lines.rotations.emplace_back(isComplete ? Eigen::Matrix3d(readPose(in, false).rotation.transpose())
                                          : Eigen::Matrix3d::Identity());
}

void readRay(TextScanner& in, Lines& lines) {
  lines.imagePoints2d2d.push_back(readImagePoint(in));
  lines.cameraIds.push_back(in.integer<std::int64_t>("the camera's id"));
  lines.cameraIdLocation.push_back(in.line());
  const Eigen::Vector3d direction = readVector(in, "the ray's direction");
  const double length = direction.stableNorm();
  if (!(length > 0)) in.fail("the ray's direction has length zero");
  lines.directions.push_back(direction / length);
}

void readPoint(TextScanner& in, Lines& lines) {
  lines.imagePoints2d3d.push_back(readImagePoint(in));
  lines.points.push_back(readVector(in, "the point"));
}

Lines readLines(const std::string& path, Mending& mending) {
  TextScanner in(path, TextScanner::Layout::Lines, mending);
  Lines lines;
  while (in.toNextRecord()) {
    const std::string_view kind = in.word("the kind of line");
    if (kind == "query")
      readReference(in, lines);
    else if (kind == "image")
      readImageSize(in, lines);
    else if (kind == "cam")
      readRigCamera(in, lines);
    else if (kind == "p2")
      readRay(in, lines);
    else if (kind == "p3")
      readPoint(in, lines);
    else
      in.fail("expected query, image, cam, p2 or p3, found '" + printable(kind) + "'");
    in.endLineOrComment();
  }
  return lines;
}

void appendQuaternion(std::string& text, const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  appendNumbers(text, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
}

void appendRigCameras(std::string& text, const NoncentralHybridAdapter& adapter) {
  std::map<int, std::size_t> rays;  // one of each camera
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d2d(); ++i) rays.emplace(adapter.getCamIndex(i), i);
  for (const auto& [camera, ray] : rays) {
    text += "cam";
    appendNumber(text, camera);
    appendNumbers(text, adapter.getCamOffset(ray));
    const double focalLength = adapter.getRigFocalLength(ray);
    const Eigen::Matrix3d rotation = adapter.getCamRotation(ray);
    if (focalLength > 0 || !rotation.isIdentity(0)) {
      appendNumber(text, focalLength);
      appendQuaternion(text, rotation);
    }
    text += '\n';
  }
}

}  // namespace

bool isProblemFile(const std::string& path) {
  constexpr std::size_t kBytes = 1 << 16;
  const std::string start = readStart(path, kBytes);
  for (const std::string_view line : linesOf(start)) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    const std::string_view word = line.substr(begin, line.find_first_of(" \t\r", begin) - begin);
    return word == "query" || word == "image" || word == "cam" || word == "p2" || word == "p3";
  }
  return false;
}

LocalizationProblem readProblem(const std::string& path, const ReadOptions& options, ReadReport* report) {
  Mending mending(options, report);
  const Lines lines = readLines(path, mending);
  std::vector<int> camIndices;
  for (std::size_t i = 0; i < lines.cameraIds.size(); ++i) {
    const auto camera = lines.cameraIndices.find(lines.cameraIds[i]);
    if (camera == lines.cameraIndices.end())
      throw FileError::atLine(path, lines.cameraIdLocation[i], "there is no camera " + std::to_string(lines.cameraIds[i]));
    camIndices.push_back(static_cast<int>(camera->second));
  }
  NoncentralHybridAdapter::Vectors bearings;
  for (std::size_t i = 0; i < camIndices.size(); ++i)
    bearings.emplace_back(lines.rotations[static_cast<std::size_t>(camIndices[i])].transpose() * lines.directions[i]);
  NoncentralHybridAdapter adapter(lines.imagePoints2d2d, bearings, camIndices, lines.centres, lines.rotations,
                                  lines.imagePoints2d3d, lines.points);
  adapter.setRigFocalLengths(lines.focalLengths);
  LocalizationProblem problem{std::filesystem::path(path).stem().string(),
                              std::move(adapter),
                              lines.reference,
                              {},
                              {},
                              {},
                              std::vector<bool>(lines.imagePoints2d2d.size()),
                              std::vector<bool>(lines.imagePoints2d3d.size())};
  problem.imageWidth = lines.imageWidth;
  problem.imageHeight = lines.imageHeight;
  return problem;
}

void writeProblem(const std::string& path, const LocalizationProblem& problem) {
  const NoncentralHybridAdapter& adapter = problem.adapter;
  std::string text =
      "# query f qw qx qy qz tx ty tz | image width height | cam id cx cy cz f qw qx qy qz | p3 u v X Y Z | p2 u v camid qx qy "
      "qz\n";
  if (problem.reference) {
    const FocalPose& pose = *problem.reference;
    text += "query";
    appendNumber(text, pose.focalLength);
    appendQuaternion(text, pose.rotation.transpose());
    appendNumbers(text, Eigen::Vector3d(-(pose.rotation.transpose() * pose.position)));
    text += '\n';
  }
  if (problem.imageWidth > 0 && problem.imageHeight > 0) {
    text += "image";
    appendNumber(text, problem.imageWidth);
    appendNumber(text, problem.imageHeight);
    text += '\n';
  }
  appendRigCameras(text, adapter);
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i) {
    text += "p3";
    appendNumbers(text, Eigen::Vector2d(adapter.getImagePoint2d3d(i).hnormalized()));
    appendNumbers(text, adapter.getPoint(i));
    text += '\n';
  }
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d2d(); ++i) {
    text += "p2";
    appendNumbers(text, Eigen::Vector2d(adapter.getImagePoint2d2d(i).hnormalized()));
    appendNumber(text, adapter.getCamIndex(i));
    appendNumbers(text, Eigen::Vector3d((adapter.getCamRotation(i) * adapter.getBearingVector(i)).normalized()));
    text += '\n';
  }
  writeFile(path, text);
}

}  // namespace sfm
}  // namespace hybridgv

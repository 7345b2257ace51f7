// Writes a fuzzer's input to files, reads them, and stops the program if a reader breaks a promise: FileError that names the
// file, or valid data that survive being written and read again. Any other exception stops it as well.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "ModelChecks.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace fuzz {

[[noreturn]] inline void reportFault(const std::string& promise) {
  std::fprintf(stderr, "broken promise: %s\n", promise.c_str());
  std::abort();
}

inline const test::TemporaryFolder& folder() {
  static const test::TemporaryFolder instance;
  return instance;
}

// Stands between the files of a COLMAP model in one input.
constexpr char kSeparator[] = "\n%%%\n";

inline std::vector<std::string> split(const std::uint8_t* data, std::size_t size) {
  const std::string all(reinterpret_cast<const char*>(data), size), separator = kSeparator;
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = all.find(separator); end != std::string::npos; end = all.find(separator, begin)) {
    parts.push_back(all.substr(begin, end - begin));
    begin = end + separator.size();
  }
  parts.push_back(all.substr(begin));
  return parts;
}

inline void writeColmapFiles(const std::uint8_t* data, std::size_t size, const std::string& extension) {
  const std::vector<std::string> parts = split(data, size);
  const char* names[] = {"cameras", "images", "points3D"};
  for (std::size_t i = 0; i < 3; ++i) folder().write(names[i] + extension, i < parts.size() ? parts[i] : "");
}

inline std::string writeFile(const std::uint8_t* data, std::size_t size) {
  return folder().write("input", std::string(reinterpret_cast<const char*>(data), size));
}

template <class Read>
auto readOrFileError(const std::string& path, Read read, bool& isRead) -> decltype(read(path)) {
  isRead = true;
  try {
    return read(path);
  } catch (const sfm::FileError& error) {
    if (error.file().rfind(path, 0) != 0 || std::string(error.what()).rfind(error.file(), 0) != 0)
      reportFault("an error names its file");
    isRead = false;
  }
  return decltype(read(path))();
}

// The writers want names that fit in a line of text.
inline void simplifyNames(sfm::SparseModel& model) {
  for (std::size_t i = 0; i < model.images.size(); ++i) model.images[i].name = "image " + std::to_string(i);
}

// Those whose camera has a model of tomorrow are not in the files of another format.
inline std::ptrdiff_t countRegistered(const sfm::SparseModel& model) {
  return std::count_if(model.images.begin(), model.images.end(), [](const sfm::Image& image) { return image.registered; });
}

inline bool canBeWritten(const sfm::SparseModel& model) {
  for (const sfm::Camera& camera : model.cameras)
    if (camera.model == sfm::CameraModel::NvmRadial && camera.parameters.back() != 0) return false;
  return true;
}

// Hardly any damaged map agrees with itself: without that check more of them are read.
constexpr sfm::ReadOptions kUnchecked{false, false};

inline void useModel(sfm::SparseModel model) {
  simplifyNames(model);
  sfm::checkModel(model);
  for (std::size_t i = 0; i < model.images.size() && i < 3; ++i)
    if (model.images[i].registered && sfm::hasImagePlane(model.cameras[model.images[i].camera].model))
      sfm::makeLocalizationProblem(model, i);
  if (!canBeWritten(model)) return;
  const std::string copy = folder().path();
  sfm::writeColmapText(copy, model);
  const sfm::SparseModel text = sfm::readColmapText(copy, kUnchecked);
  sfm::writeColmapBinary(copy, text);
  const sfm::SparseModel binary = sfm::readColmapBinary(copy, kUnchecked);
  if (text.points.size() != model.points.size() || binary.points.size() != model.points.size() ||
      countRegistered(binary) != countRegistered(text))
    reportFault("what is written is read again");
}

template <class Read>
int fuzzModelReader(const std::string& path, Read readFile) {
  for (const sfm::ReadOptions& options : {sfm::ReadOptions{true, true}, sfm::ReadOptions{false, true}, kUnchecked}) {
    sfm::ReadReport report;
    bool isRead = false;
    const auto read = [&](const std::string& file) { return readFile(file, options, &report); };
    sfm::SparseModel model = readOrFileError(path, read, isRead);
    if (!isRead) continue;
    if (options.strict && std::any_of(report.counts.begin(), report.counts.end(), [](std::size_t n) { return n > 0; }))
      reportFault("strict mode mends nothing");
    report.sentences();
    useModel(std::move(model));
  }
  return 0;
}

}  // namespace fuzz
}  // namespace hybridgv

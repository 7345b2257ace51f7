#include "FileContents.hpp"

#include <filesystem>
#include <fstream>

#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {

bool isFile(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

bool isFolder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

std::string joinPath(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

std::string readStart(const std::string& path, std::size_t count) {
  if (!isFile(path)) return {};
  std::ifstream stream(path, std::ios::binary);
  std::string result(count, '\0');
  stream.read(&result[0], static_cast<std::streamsize>(count));
  result.resize(static_cast<std::size_t>(stream.gcount()));
  return result;
}

std::string readFile(const std::string& path) {
  if (!isFile(path)) throw FileError::inFile(path, isFolder(path) ? "is a folder, expected a file" : "no such file");
  std::ifstream stream(path, std::ios::binary);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (!stream || error) throw FileError::inFile(path, "cannot be opened");
  std::string contents(size, '\0');
  stream.read(&contents[0], static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) throw FileError::inFile(path, "cannot be read");
  return contents;
}

void writeFile(const std::string& path, const std::string& contents) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  if (!stream) throw FileError::inFile(path, "cannot be written");
}

namespace {

constexpr const char* kUnfinished = ".tmp";

}  // namespace

FileReplacement::~FileReplacement() {
  std::error_code ignored;
  for (const std::string& path : written_) std::filesystem::remove(path + kUnfinished, ignored);
}

void FileReplacement::write(const std::string& path, const std::string& contents) {
  written_.push_back(path);
  writeFile(path + kUnfinished, contents);
}

void FileReplacement::commit() {
  std::error_code error;
  for (const std::string& path : written_) {
    std::filesystem::rename(path + kUnfinished, path, error);
    if (error) throw FileError::inFile(path, "cannot be written: " + error.message());
  }
  for (const std::string& path : removed_) {
    std::filesystem::remove(path, error);
    if (error) throw FileError::inFile(path, "cannot be removed");
  }
  written_.clear();
}

}  // namespace sfm
}  // namespace hybridgv

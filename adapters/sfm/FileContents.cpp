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

void replaceFile(const std::string& path, const std::string& contents) {
  const std::string unfinished = path + ".tmp";
  std::error_code error;
  try {
    writeFile(unfinished, contents);
  } catch (const FileError&) {
    std::filesystem::remove(unfinished, error);
    throw;
  }
  std::filesystem::rename(unfinished, path, error);
  if (error) throw FileError::inFile(path, "cannot be written: " + error.message());
}

}  // namespace sfm
}  // namespace hybridgv

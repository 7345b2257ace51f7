#include "FileContents.hpp"
#include "Printable.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

#include <fstream>

namespace hybridgv {
namespace sfm {
namespace {

bool holds(const std::string& folder, const char* extension) {
  for (const char* name : {"cameras", "images", "points3D"})
    if (!isFile(joinPath(folder, std::string(name) + extension))) return false;
  return true;
}

std::string firstBytes(const std::string& path, std::size_t count) {
  std::ifstream stream(path, std::ios::binary);
  std::string result(count, '\0');
  stream.read(&result[0], static_cast<std::streamsize>(count));
  result.resize(static_cast<std::size_t>(stream.gcount()));
  return result;
}

}  // namespace

SparseModel readModel(const std::string& path) {
  if (isFolder(path)) {
    if (holds(path, ".bin")) return readColmapBinary(path);
    if (holds(path, ".txt")) return readColmapText(path);
    throw FileError::inFile(path, "the folder holds no COLMAP model (cameras, images, points3D as .bin or .txt)");
  }
  if (!isFile(path)) throw FileError::inFile(path, "no such file or folder");
  const std::string start = firstBytes(path, 64);
  if (start.rfind("NVM_", 0) == 0) return readNvm(path);
  if (start.rfind("# Bundle", 0) == 0) return readBundler(path);
  const std::string line = start.substr(0, start.find('\n'));
  throw FileError::atLine(path, 1, "starts with '" + printable(line) + "', neither with 'NVM_V3' nor with '# Bundle file v0.3'");
}

}  // namespace sfm
}  // namespace hybridgv

// Whole files in memory.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hybridgv {
namespace sfm {

bool isFile(const std::string& path);
bool isFolder(const std::string& path);
std::string joinPath(const std::string& folder, const std::string& name);

// The first bytes of a file, at most `count`; empty if it cannot be read.
std::string readStart(const std::string& path, std::size_t count);

// Both throw FileError. Only regular files are read: a device has no end.
std::string readFile(const std::string& path);
void writeFile(const std::string& path, const std::string& contents);

// Files that take their places together: each is written beside its place first, as PATH.tmp, so that whoever is interrupted in
// writing leaves the old ones as they were.
class FileReplacement {
 public:
  FileReplacement() = default;
  // Removes what has not taken its place.
  ~FileReplacement();
  FileReplacement(const FileReplacement&) = delete;
  FileReplacement& operator=(const FileReplacement&) = delete;

  void write(const std::string& path, const std::string& contents);
  // The file is not to be there afterwards.
  void remove(const std::string& path) { removed_.push_back(path); }
  // In the order in which they were written.
  void commit();

 private:
  std::vector<std::string> written_, removed_;
};

}  // namespace sfm
}  // namespace hybridgv

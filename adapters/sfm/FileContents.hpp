// Whole files in memory.
#pragma once

#include <string>

namespace hybridgv {
namespace sfm {

bool isFile(const std::string& path);
bool isFolder(const std::string& path);
std::string joinPath(const std::string& folder, const std::string& name);

// Both throw FileError. Only regular files are read: a device has no end.
std::string readFile(const std::string& path);
void writeFile(const std::string& path, const std::string& contents);

}  // namespace sfm
}  // namespace hybridgv

// Whole files in memory.
#pragma once

#include <cstddef>
#include <string>

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

// The same beside its place first, as PATH.tmp, so that whoever is interrupted in writing leaves the old file as it was.
void replaceFile(const std::string& path, const std::string& contents);

}  // namespace sfm
}  // namespace hybridgv

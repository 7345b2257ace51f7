#include "FileKind.hpp"

#include <algorithm>

namespace hybridgv {
namespace sfm {
namespace {

struct Signature {
  std::string_view start;
  const char* description;
};

using std::string_view_literals::operator""sv;

constexpr Signature kSignatures[] = {
    {"SQLite format 3\0"sv, "an SQLite database; of COLMAP's project, name the folder of the model instead of database.db"},
    {"\x89PNG"sv, "a picture (PNG)"},
    {"\xff\xd8\xff"sv, "a picture (JPEG)"},
    {"II*\0"sv, "a picture (TIFF)"},
    {"MM\0*"sv, "a picture (TIFF)"},
    {"ply\n"sv, "a point cloud or mesh (PLY), which has no images"},
    {"ply\r\n"sv, "a point cloud or mesh (PLY), which has no images"},
    {"# .PCD"sv, "a point cloud (PCD), which has no images"},
    {"LASF"sv, "a point cloud (LAS), which has no images"},
    {"\x89HDF"sv, "an HDF5 file (features or matches), not a map"},
    {"PK\x03\x04"sv, "a zip archive (or .npz); unpack it"},
    {"\x1f\x8b"sv, "a gzip archive; unpack it"},
    {"BZh"sv, "a bzip2 archive; unpack it"},
    {"\xfd\x37zXZ"sv, "an xz archive; unpack it"},
    {"7z\xbc\xaf"sv, "a 7-zip archive; unpack it"},
    {"\x93NUMPY"sv, "a NumPy array"},
    {"\x7f\x45LF"sv, "a program"},
    {"%PDF"sv, "a document (PDF)"},
    {"<?xml"sv, "XML (Agisoft, RealityCapture or ContextCapture?); export the map as Bundler or COLMAP"},
    {"<!DOCTYPE"sv, "a web page: was the download complete?"},
    {"<html"sv, "a web page: was the download complete?"},
    {"version https://git-lfs"sv, "a pointer of Git LFS; fetch the file itself"},
    {"# Bundle"sv, "a Bundler file of another version than v0.3"},
    {"NVM_"sv, "an NVM file of another version than NVM_V3"},
    {"# Camera list"sv, "one file of a COLMAP model; name its folder"},
    {"# Image list"sv, "one file of a COLMAP model; name its folder"},
    {"# 3D point list"sv, "one file of a COLMAP model; name its folder"},
};

}  // namespace

std::string describeFile(std::string_view start) {
  for (const Signature& signature : kSignatures)
    if (start.substr(0, signature.start.size()) == signature.start) return signature.description;
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && (start[first] == '{' || start[first] == '['))
    return "JSON (OpenMVG, OpenSfM, Meshroom or NeRF?); export the map as COLMAP, Bundler or NVM";
  if (start.find('\0') != std::string_view::npos) return "binary data";
  return {};
}

std::string readableFormats() {
  return "a COLMAP folder (cameras, images, points3D as .bin or .txt), a Bundler v0.3 file, an NVM_V3 file";
}

}  // namespace sfm
}  // namespace hybridgv

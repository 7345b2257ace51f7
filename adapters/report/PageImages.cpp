#include "PageImages.hpp"

#include <algorithm>
#include <filesystem>

#include "../sfm/FileContents.hpp"
#include "Json.hpp"

namespace hybridgv {
namespace report {
namespace {

namespace fs = std::filesystem;

// The name comes from a file of somebody: it is not to lead to other folders.
bool staysInFolder(const fs::path& name) {
  const auto leadsOut = [](const fs::path& part) { return part == ".."; };
  return !name.empty() && !name.is_absolute() && std::none_of(name.begin(), name.end(), leadsOut);
}

// By the first bytes; empty: neither JPEG nor PNG.
const char* mediaType(const std::string& start) {
  if (start.compare(0, 3, "\xFF\xD8\xFF") == 0) return "image/jpeg";
  if (start.compare(0, 4, "\x89PNG") == 0) return "image/png";
  return "";
}

// "./" in front: no name is taken for the name of a protocol.
std::string asLink(const std::string& path) {
  constexpr const char* kHex = "0123456789ABCDEF";
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  std::string link = "./";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (plain.find(c) != std::string::npos)
      link += c;
    else
      link += {'%', kHex[byte >> 4u], kHex[byte & 15u]};
  }
  return link;
}

}  // namespace

std::string PageImages::addressOf(const std::string& name) {
  if (options_.imageFolder.empty() || name.find('\0') != std::string::npos || !staysInFolder(name)) return {};
  const fs::path path = fs::path(options_.imageFolder) / name;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  constexpr std::size_t kStart = 4;
  const std::string type = mediaType(sfm::readStart(path.string(), kStart));
  if (type.empty()) return {};
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size <= options_.maxImageBytes && bytes_ + size <= options_.maxBytesOfAllImages) {
    bytes_ += size;
    return "data:" + type + ";base64," + base64(sfm::readFile(path.string()));
  }
  const fs::path link = fs::relative(path, fs::absolute(page_, error).parent_path(), error);
  return error ? std::string() : asLink(link.string());
}

}  // namespace report
}  // namespace hybridgv

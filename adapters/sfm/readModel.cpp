#include <algorithm>
#include <filesystem>

#include "FileContents.hpp"
#include "FileKind.hpp"
#include "Printable.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

constexpr const char* kParts[] = {"cameras", "images", "points3D"};

bool holds(const std::string& folder, const char* extension) {
  return std::all_of(std::begin(kParts), std::end(kParts),
                     [&](const char* name) { return isFile(joinPath(folder, std::string(name) + extension)); });
}

bool holdsModel(const std::string& folder) { return holds(folder, ".bin") || holds(folder, ".txt"); }

// Where a project folder has its models.
std::vector<std::string> modelsInside(const std::string& folder) {
  std::vector<std::string> result;
  for (const char* place : {"sparse", "", "dense/sparse"}) {
    const std::string parent = *place == '\0' ? folder : joinPath(folder, place);
    if (parent != folder && holdsModel(parent)) result.push_back(parent);
    for (int number = 0; isFolder(joinPath(parent, std::to_string(number))); ++number)
      if (holdsModel(joinPath(parent, std::to_string(number)))) result.push_back(joinPath(parent, std::to_string(number)));
  }
  return result;
}

std::string lacking(const std::string& folder) {
  std::string result;
  for (const char* name : kParts)
    if (!isFile(joinPath(folder, std::string(name) + ".bin")) && !isFile(joinPath(folder, std::string(name) + ".txt")))
      result += std::string(result.empty() ? "" : ", ") + name;
  return result;
}

// Files in the folder that look like maps of other formats.
std::string otherMaps(const std::string& folder) {
  std::string result;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string start = readStart(entry.path().string(), 16);
    if (start.rfind("NVM_V3", 0) == 0 || start.rfind("# Bundle file", 0) == 0)
      result += std::string(result.empty() ? "" : ", ") + entry.path().filename().string();
  }
  return result;
}

[[noreturn]] void failInFolder(const std::string& folder) {
  std::string reason = "the folder holds no COLMAP model (cameras, images, points3D as .bin or .txt), nor does its sparse/0";
  const std::string missing = lacking(folder), others = otherMaps(folder);
  if (!others.empty())
    reason += "; it holds " + others + ": name that file";
  else if (missing != "cameras, images, points3D")
    reason += missing.empty() ? "; all three must be .bin or all three .txt" : "; it lacks " + missing;
  throw FileError::inFile(folder, reason);
}

SparseModel readColmap(const std::string& folder, const ReadOptions& options, ReadReport* report) {
  return holds(folder, ".bin") ? readColmapBinary(folder, options, report) : readColmapText(folder, options, report);
}

SparseModel readProject(const std::string& folder, const ReadOptions& options, ReadReport* report) {
  const std::vector<std::string> models = modelsInside(folder);
  if (models.empty()) failInFolder(folder);
  SparseModel model = readColmap(models.front(), options, report);
  if (report == nullptr) return model;
  std::string note = folder + ": " + models.front() + " was read";
  if (models.size() > 1) note += ", one of " + std::to_string(models.size()) + " models; name the folder of another to read that";
  report->notes.push_back(note);
  return model;
}

bool isPartOfModel(const std::filesystem::path& path) {
  const std::string extension = path.extension().string(), stem = path.stem().string();
  return (extension == ".bin" || extension == ".txt") &&
         std::any_of(std::begin(kParts), std::end(kParts), [&](const char* name) { return stem == name; });
}

}  // namespace

SparseModel readModel(const std::string& path, const ReadOptions& options, ReadReport* report) {
  if (isFolder(path)) return holdsModel(path) ? readColmap(path, options, report) : readProject(path, options, report);
  if (!isFile(path)) throw FileError::inFile(path, "no such file or folder");
  const std::string folder = std::filesystem::path(path).parent_path().string();
  if (isPartOfModel(path) && holdsModel(folder.empty() ? "." : folder))
    return readColmap(folder.empty() ? "." : folder, options, report);
  std::string start = readStart(path, 256);
  if (start.empty()) throw FileError::inFile(path, "the file is empty");
  if (start.rfind("\xef\xbb\xbf", 0) == 0) start.erase(0, 3);
  const bool isUtf16 = start.rfind("\xff\xfe", 0) == 0 || start.rfind("\xfe\xff", 0) == 0;
  if (isUtf16) {
    start.erase(0, 2);
    start.erase(std::remove(start.begin(), start.end(), '\0'), start.end());
  }
  if (start.rfind("NVM_V3", 0) == 0) return readNvm(path, options, report);
  if (start.rfind("# Bundle file v0.3", 0) == 0) return readBundler(path, options, report);
  if (start.find_first_not_of(" \t\r\n") == std::string::npos) throw FileError::inFile(path, "the file holds blanks only");
  const std::string kind = describeFile(start);
  const std::string line = start.substr(0, start.find('\n'));
  throw FileError::atLine(path, 1,
                          "this is no map: it " +
                              (kind.empty() ? "starts with '" + printable(line) + "'" : "looks like " + kind) +
                              "; what can be read: " + readableFormats());
}

}  // namespace sfm
}  // namespace hybridgv

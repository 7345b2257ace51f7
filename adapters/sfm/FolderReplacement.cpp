#include "FolderReplacement.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include "FileContents.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBeside = ".hybridgv-unfinished";
constexpr const char *kInside = ".hybridgv-unfinished", *kComplete = ".hybridgv-complete";
// In a folder of complete files: the names of those that are not to be in the model's folder.
constexpr const char* kRemoved = "removed";

// Without links and a slash at the end, so that there is a place beside it.
std::string resolved(const std::string& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (!error) return real.string();
  fs::path path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).string();
}

std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string parentOf(const std::string& folder) { return fs::path(folder).parent_path().string(); }

bool isWorkingFolder(const std::string& folder) {
  std::error_code error;
  return fs::equivalent(fs::current_path(error), folder, error);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

FolderReplacement::FolderReplacement(const std::string& folder, DiskWatch watch)
    : disk_(std::move(watch)),
      folder_(resolved(folder)),
      beside_(folder_ + kBeside),
      inside_(joinPath(folder_, kInside)),
      complete_(joinPath(folder_, kComplete)) {
  std::error_code error;
  if (fs::exists(folder_, error) && !isFolder(folder_)) throw FileError::inFile(folder, "is no folder");
  disk_.removeFolder(inside_);
  if (isFolder(complete_)) completeMove();
}

FolderReplacement::~FolderReplacement() {
  std::error_code ignored;
  if (!place_.empty()) fs::remove_all(place_, ignored);
}

void FolderReplacement::write(const std::string& name, const std::string& contents) {
  if (place_.empty()) makePlace();
  written_.push_back(name);
  disk_.write(joinPath(place_, name), contents);
}

// Beside the folder, if it may be written there.
void FolderReplacement::makePlace() {
  try {
    disk_.removeFolder(beside_);
    disk_.makeFolder(beside_);
    place_ = beside_;
  } catch (const FileError&) {
    if (!isFolder(folder_)) throw;
    disk_.makeFolder(inside_);
    place_ = inside_;
  }
}

void FolderReplacement::commit() {
  disk_.flush(place_);
  const bool isBeside = place_ == beside_;
  if (!isBeside || !(takeFreePlace() || exchange())) moveOneByOne();
  disk_.flush(parentOf(folder_));
  place_.clear();
}

bool FolderReplacement::takeFreePlace() {
  if (!isFolder(folder_)) {
    disk_.rename(beside_, folder_);
    return true;
  }
  return namesIn(folder_).empty() && !isWorkingFolder(folder_) && disk_.copyOwner(folder_, beside_) &&
         disk_.tryRename(beside_, folder_);
}

bool FolderReplacement::exchange() {
  if (isWorkingFolder(folder_) || !linkOthers() || !disk_.copyOwner(folder_, beside_)) return false;
  disk_.flush(beside_);
  if (!disk_.exchange(beside_, folder_)) return false;
  // What someone else has put into the old folder in the meantime.
  const std::vector<std::string> present = namesIn(folder_);
  for (const std::string& name : namesIn(beside_))
    if (!isReplaced(name) && !contains(present, name)) disk_.rename(joinPath(beside_, name), joinPath(folder_, name));
  disk_.removeFolder(beside_);
  return true;
}

bool FolderReplacement::isReplaced(const std::string& name) const { return contains(written_, name) || contains(removed_, name); }

bool FolderReplacement::linkOthers() {
  for (const std::string& name : namesIn(folder_)) {
    if (isReplaced(name)) continue;
    const std::string path = joinPath(folder_, name);
    std::error_code error;
    const bool isPlain = fs::symlink_status(path, error).type() == fs::file_type::regular;
    if (!isPlain || !disk_.link(path, joinPath(beside_, name))) return false;
  }
  return true;
}

void FolderReplacement::moveOneByOne() {
  for (const std::string& name : namesIn(place_))
    if (!contains(written_, name)) disk_.remove(joinPath(place_, name));
  std::string names;
  for (const std::string& name : removed_) names += name + "\n";
  disk_.write(joinPath(place_, kRemoved), names);
  disk_.flush(place_);
  if (!disk_.tryRename(place_, complete_)) bringInside();
  disk_.flush(folder_);
  completeMove();
}

// The folder is on another file system than what is beside it.
void FolderReplacement::bringInside() {
  disk_.makeFolder(inside_);
  for (const std::string& name : namesIn(beside_)) disk_.write(joinPath(inside_, name), readFile(joinPath(beside_, name)));
  disk_.flush(inside_);
  disk_.rename(inside_, complete_);
  disk_.removeFolder(beside_);
}

void FolderReplacement::completeMove() {
  const std::string list = joinPath(complete_, kRemoved);
  for (const std::string& name : namesIn(complete_))
    if (name != kRemoved) disk_.rename(joinPath(complete_, name), joinPath(folder_, name));
  std::istringstream names(isFile(list) ? readFile(list) : "");
  for (std::string name; std::getline(names, name);)
    if (isFile(joinPath(folder_, name))) disk_.remove(joinPath(folder_, name));
  disk_.flush(folder_);
  disk_.removeFolder(complete_);
}

void checkIsComplete(const std::string& folder) {
  const std::string complete = joinPath(folder, kComplete);
  if (isFolder(complete))
    throw FileError::inFile(folder, "writing it was interrupted; " + complete + " has files that belong into it");
}

}  // namespace sfm
}  // namespace hybridgv

#include "Disk.hpp"

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "FileContents.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

#ifndef _WIN32
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace hybridgv {
namespace sfm {
namespace {

namespace fs = std::filesystem;

void throwIf(const std::error_code& error, const std::string& path, const char* what) {
  if (error) throw FileError::inFile(path, std::string(what) + ": " + error.message());
}

#ifndef _WIN32
// False if the device has failed or is full. A file system that cannot do it does what it can anyway.
bool flushed(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return true;
  const bool hasFailed = fsync(file) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  close(file);
  return !hasFailed;
}

bool ownerIsCopied(const std::string& from, const std::string& to) {
  struct stat wanted {
  }, current{};
  if (stat(from.c_str(), &wanted) != 0 || stat(to.c_str(), &current) != 0) return false;
  const bool isOwned = wanted.st_uid == current.st_uid && wanted.st_gid == current.st_gid;
  return (isOwned || chown(to.c_str(), wanted.st_uid, wanted.st_gid) == 0) && chmod(to.c_str(), wanted.st_mode & 07777) == 0;
}
#else
bool flushed(const std::string&) { return true; }
bool ownerIsCopied(const std::string&, const std::string&) { return true; }
#endif

}  // namespace

void Disk::announce(const char* change, const std::string& path) const {
  if (watch_) watch_(std::string(change) + " " + path);
}

void Disk::makeFolder(const std::string& path) const {
  announce("make", path);
  std::error_code error;
  fs::create_directory(path, error);
  throwIf(error, path, "cannot be made");
}

void Disk::write(const std::string& path, const std::string& contents) const {
  announce("write", path);
  writeFile(path, contents);
  if (!flushed(path)) throw FileError::inFile(path, "cannot be written");
}

void Disk::flush(const std::string& folder) const {
  if (!flushed(folder)) throw FileError::inFile(folder, "cannot be written");
}

void Disk::rename(const std::string& from, const std::string& to) const {
  announce("rename", from);
  std::error_code error;
  fs::rename(from, to, error);
  throwIf(error, to, "cannot be written");
}

bool Disk::tryRename(const std::string& from, const std::string& to) const {
  announce("rename", from);
  std::error_code error;
  fs::rename(from, to, error);
  return !error;
}

void Disk::remove(const std::string& path) const {
  announce("remove", path);
  std::error_code error;
  fs::remove(path, error);
  throwIf(error, path, "cannot be removed");
}

void Disk::removeFolder(const std::string& path) const {
  if (!isFolder(path)) return;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path, error)) remove(entry.path().string());
  throwIf(error, path, "cannot be removed");
  remove(path);
}

bool Disk::exchange(const std::string& one, const std::string& other) const {
#ifdef RENAME_EXCHANGE
  announce("exchange", one);
  return renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
#else
  (void)one, (void)other;
  return false;
#endif
}

bool Disk::link(const std::string& file, const std::string& name) const {
  announce("link", name);
  std::error_code error;
  fs::create_hard_link(file, name, error);
  return !error;
}

bool Disk::copyOwner(const std::string& from, const std::string& to) const {
  announce("own", to);
  return ownerIsCopied(from, to);
}

}  // namespace sfm
}  // namespace hybridgv

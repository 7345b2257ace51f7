// Changes of files and folders, one after the other.
#pragma once

#include <functional>
#include <string>

namespace hybridgv {
namespace sfm {

// Is told of each change before it is made, by its name: what is done to which path.
using DiskWatch = std::function<void(const std::string& change)>;

// What is written is on the device when the function returns, as far as the system allows. Functions without a result throw FileError.
class Disk {
 public:
  explicit Disk(DiskWatch watch = {}) : watch_(std::move(watch)) {}

  void makeFolder(const std::string& path) const;
  void write(const std::string& path, const std::string& contents) const;
  // The names in a folder, so that they are there after a loss of power.
  void flush(const std::string& folder) const;
  void rename(const std::string& from, const std::string& to) const;
  // False if the system refuses.
  bool tryRename(const std::string& from, const std::string& to) const;
  void remove(const std::string& path) const;
  // A folder that holds files only; nothing if there is none.
  void removeFolder(const std::string& path) const;
  // The two folders change places at once. False if the system cannot.
  bool exchange(const std::string& one, const std::string& other) const;
  // The file gets a second name. False if the system cannot.
  bool link(const std::string& file, const std::string& name) const;
  // Owner and permissions of a folder become those of the other one. False if the system refuses.
  bool copyOwner(const std::string& from, const std::string& to) const;

 private:
  void announce(const char* change, const std::string& path) const;

  DiskWatch watch_;
};

}  // namespace sfm
}  // namespace hybridgv

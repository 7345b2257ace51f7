// The files of a model, which take their places together.
#pragma once

#include <string>
#include <vector>

#include "Disk.hpp"

namespace hybridgv {
namespace sfm {

// New files for a folder. All are written into another folder beside it, FOLDER.hybridgv-unfinished; then
//
// * if there is no such folder yet, or it is empty, the other one gets its name;
// * else the two change places at once, if the system can (Linux, most file systems). What else is in the old folder has a second name in
//   the new one, so it must hold files only. The program's working folder keeps its place;
// * else, and where nothing can be written beside the folder or moved into it, the new files are moved one after the other. They are in
//   FOLDER/.hybridgv-complete then; if that exists, the move was interrupted, which checkIsComplete() and the next FolderReplacement see.
//
// So whoever is killed at any moment leaves, in the first two cases, the folder as it was or as it will be, and in the third case the same or a
// folder that is not read until it has been completed. What is left beside it is removed by the next who writes there.
class FolderReplacement {
 public:
  // Completes what was interrupted before.
  explicit FolderReplacement(const std::string& folder, DiskWatch watch = {});
  // Removes what has not taken its place.
  ~FolderReplacement();
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;

  // All throw FileError.
  void write(const std::string& name, const std::string& contents);
  // The file is not to be there afterwards.
  void remove(const std::string& name) { removed_.push_back(name); }
  void commit();

 private:
  void makePlace();
  // Both are false if the folder has to keep its place; then nothing has happened to it.
  bool takeFreePlace();
  bool exchange();
  bool linkOthers();
  bool isReplaced(const std::string& name) const;
  void moveOneByOne();
  void bringInside();
  void completeMove();

  Disk disk_;
  std::string folder_;
  std::string beside_, inside_, complete_;  // places of new files
  std::string place_;                       // the one of this object, empty if it has none
  std::vector<std::string> written_, removed_;
};

// Throws FileError if moving files into the folder was interrupted, so that it holds those of two models.
void checkIsComplete(const std::string& folder);

}  // namespace sfm
}  // namespace hybridgv

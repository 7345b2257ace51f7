// The files of a model take their places together, whenever the writer is killed.
#include "FolderReplacement.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "FileContents.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const Files kOld = {
    {"cameras.bin", "old cameras"}, {"images.bin", "old images"}, {"points3D.bin", "old points"}, {"rigs.bin", "old"}};
const Files kNew = {{"cameras.bin", "new cameras"}, {"images.bin", "new images"}, {"points3D.bin", std::string(100000, 'p')}};

// What is in a folder, subfolders as "(folder)".
Files contentsOf(const std::string& folder) {
  Files result;
  if (!isFolder(folder)) return result;
  for (const auto& entry : fs::directory_iterator(folder))
    result[entry.path().filename().string()] = entry.is_directory() ? "(folder)" : readFile(entry.path().string());
  return result;
}

void replace(const std::string& folder, const DiskWatch& watch = {}) {
  FolderReplacement files(folder, watch);
  for (const auto& [name, contents] : kNew) files.write(name, contents);
  files.remove("rigs.bin");
  files.commit();
}

// In a process of its own, which is killed before its change number `change`; whether it came to that.
bool replaceUntil(int change, const std::string& folder, const std::string& workingFolder) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(workingFolder.c_str()) != 0) _exit(2);
    int changes = 0;
    replace(folder, [&](const std::string&) {
      if (changes++ == change) raise(SIGKILL);
    });
    _exit(0);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) == 0));
  return WIFSIGNALED(status);
}

struct Place {
  const char* name;
  bool exists;
  Files before;
  bool hasSubfolder, isWorkingFolder, isBlockedBeside;
  bool isReplacedAtOnce;
};

Files with(Files files, const Files& others) {
  files.insert(others.begin(), others.end());
  return files;
}

class KilledWriter : public testing::TestWithParam<Place> {
 protected:
  void prepare(const test::TemporaryFolder& scratch) const {
    const Place& place = GetParam();
    if (place.exists) fs::create_directory(scratch.file("model"));
    for (const auto& [name, contents] : place.before) scratch.write("model/" + name, contents);
    if (place.hasSubfolder) fs::create_directory(scratch.file("model/more"));
    if (place.isBlockedBeside) scratch.write("model.hybridgv-unfinished", "in the way");
  }

  Files others() const {
    Files result;
    for (const auto& [name, contents] : GetParam().before)
      if (kOld.count(name) == 0) result[name] = contents;
    if (GetParam().hasSubfolder) result["more"] = "(folder)";
    return result;
  }
  Files before() const { return with(GetParam().before, others()); }
  Files after() const { return with(kNew, others()); }
};

bool canExchange() {
  const test::TemporaryFolder scratch;
  fs::create_directory(scratch.file("a"));
  fs::create_directory(scratch.file("b"));
  return Disk().exchange(scratch.file("a"), scratch.file("b"));
}

bool isRefused(const std::string& folder) {
  try {
    checkIsComplete(folder);
    return false;
  } catch (const FileError&) {
    return true;
  }
}

Files withoutPlaces(Files files) {
  files.erase(".hybridgv-unfinished");
  return files;
}

TEST_P(KilledWriter, LeavesTheOldFilesOrTheNewOnes) {
  const bool isAtOnce = GetParam().isReplacedAtOnce && (GetParam().before.empty() || canExchange());
  bool wasKilled = true, wasOld = false, wasNew = false;
  int change = 0;
  for (; wasKilled; ++change) {
    const test::TemporaryFolder scratch;
    prepare(scratch);
    const std::string folder = scratch.file("model");
    wasKilled = replaceUntil(change, folder, GetParam().isWorkingFolder ? folder : scratch.path());
    const Files found = withoutPlaces(contentsOf(folder));
    if (found == before()) wasOld = true;
    if (found == after()) wasNew = true;
    EXPECT_FALSE(isAtOnce && isRefused(folder)) << "change " << change;
    EXPECT_TRUE(found == before() || found == after() || isRefused(folder)) << "change " << change;
    // Whoever comes next has the new ones, and nothing is left over.
    replace(folder);
    EXPECT_EQ(contentsOf(folder), after()) << "change " << change;
    EXPECT_EQ(contentsOf(scratch.path()).size(), GetParam().isBlockedBeside ? 2u : 1u) << "change " << change;
  }
  EXPECT_GT(change, 5);
  EXPECT_TRUE(wasOld && wasNew);
}

INSTANTIATE_TEST_SUITE_P(
    Places, KilledWriter,
    testing::Values(Place{"Absent", false, {}, false, false, false, true}, Place{"Empty", true, {}, false, false, false, true},
                    Place{"OldModel", true, kOld, false, false, false, true},
                    Place{"OtherFiles", true, with(kOld, {{"project.ini", "options"}}), false, false, false, true},
                    Place{"Subfolder", true, kOld, true, false, false, false},
                    Place{"WorkingFolder", true, kOld, false, true, false, false},
                    Place{"NothingBeside", true, with(kOld, {{"project.ini", "options"}}), false, false, true, false}),
    [](const testing::TestParamInfo<Place>& info) { return info.param.name; });

TEST(FolderReplacement, WhoFailsLeavesNothing) {
  const test::TemporaryFolder scratch;
  scratch.write("file", "");
  EXPECT_THROW(FolderReplacement files(scratch.file("file")), FileError);
  fs::create_directory(scratch.file("model"));
  scratch.write("model/cameras.bin", "old");
  {
    FolderReplacement files(scratch.file("model"));
    files.write("cameras.bin", "new");
    EXPECT_THROW(files.write("no/such/folder", "new"), FileError);
  }
  EXPECT_EQ(scratch.read("model/cameras.bin"), "old");
  EXPECT_EQ(contentsOf(scratch.path()).size(), 2u);
  FolderReplacement files(scratch.file("no/model"));
  EXPECT_THROW(files.write("cameras.bin", "new"), FileError);
}

TEST(FolderReplacement, KeepsPermissionsAndWhatALinkPointsTo) {
  const test::TemporaryFolder scratch;
  fs::create_directory(scratch.file("model"));
  scratch.write("model/images.bin", "old");
  fs::permissions(scratch.file("model"), fs::perms::owner_all | fs::perms::group_exec);
  fs::create_directory_symlink("model", scratch.file("link"));
  replace(scratch.file("link"));
  EXPECT_TRUE(fs::is_symlink(scratch.file("link")));
  EXPECT_EQ(contentsOf(scratch.file("model")), kNew);
  EXPECT_EQ(fs::status(scratch.file("model")).permissions(), fs::perms::owner_all | fs::perms::group_exec);
  replace(scratch.file("model") + "/");
  EXPECT_EQ(contentsOf(scratch.file("model")), kNew);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

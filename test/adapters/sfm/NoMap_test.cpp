// Files that are no map, and folders that hold one somewhere.
#include "DamagedMaps.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"

namespace hybridgv {
namespace sfm {
namespace {

void expectNoMap(const std::string& path, const std::string& words) {
  try {
    readModel(path);
    ADD_FAILURE() << words << ": was accepted";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
  EXPECT_FALSE(isProblemFile(path));
}

TEST(NoMap, FilesOfOtherProgramsAreNamed) {
  const TemporaryFolder folder;
  expectNoMap(folder.write("map.json", "{\"cameras\": []}"), "JSON");
  expectNoMap(folder.write("transforms.json", "\n [1]"), "JSON");
  expectNoMap(folder.write("points.ply", "ply\nformat ascii 1.0\n"), "PLY");
  expectNoMap(folder.write("a.png", "\x89PNG\r\n\x1a\n"), "PNG");
  expectNoMap(folder.write("database.db", std::string("SQLite format 3\0....", 20)), "SQLite");
  expectNoMap(folder.write("model.xml", "<?xml version=\"1.0\"?>"), "XML");
  expectNoMap(folder.write("model.zip", "PK\x03\x04...."), "zip");
  expectNoMap(folder.write("model.h5", "\x89HDF\r\n\x1a\n"), "HDF5");
  expectNoMap(folder.write("cameras_old.txt", "# Camera list with one line of data per camera:\n"), "COLMAP");
  expectNoMap(folder.write("model.out", "# Bundle file v0.4\n1 1\n"), "another version");
  expectNoMap(folder.write("hello.txt", "hello world\n"), "starts with 'hello world'");
  expectNoMap(folder.write("binary", std::string(100, '\1') + std::string(100, '\0')), "binary");
  expectNoMap(folder.write("empty.out", ""), "the file is empty");
  expectNoMap(folder.write("blank.nvm", "\n \r\n"), "blanks");
  for (const char* name : {"map.json", "hello.txt"}) expectNoMap(folder.file(name), "what can be read: a COLMAP folder");
}

TEST(NoMap, EmptyFilesOfAModelAreErrors) {
  const TemporaryFolder folder;
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) folder.write(name, "");
  EXPECT_THROW(readModel(folder.path()), FileError);
  const TextMap map(scene());
  map.folder.write("images.txt", "");
  EXPECT_THROW(readModel(map.folder.path()), FileError);
}

TEST(NoMap, FoldersWithoutAModelSayWhatIsMissing) {
  const TextMap map(scene());
  std::filesystem::remove(map.folder.file("points3D.txt"));
  expectNoMap(map.folder.path(), "lacks points3D");
  const TemporaryFolder other;
  other.write("scene.nvm", "NVM_V3\n0\n");
  expectNoMap(other.path(), "scene.nvm");
}

TEST(ProjectFolder, ItsModelIsFound) {
  for (const char* place : {"sparse/0", "sparse", "0", "dense/sparse"}) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() + "/" + place);
    writeColmapBinary(folder.path() + "/" + place, scene());
    ReadReport report;
    EXPECT_EQ(readModel(folder.path(), {}, &report).images.size(), 5u) << place;
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_NE(report.notes[0].find(place), std::string::npos) << report.notes[0];
    EXPECT_EQ(report.sentences(), report.notes);
  }
  const TemporaryFolder several;
  for (const char* place : {"/sparse/0", "/sparse/1"}) {
    std::filesystem::create_directories(several.path() + place);
    writeColmapText(several.path() + place, scene());
  }
  ReadReport report;
  readModel(several.path(), {}, &report);
  EXPECT_NE(report.notes.at(0).find("one of 2 models"), std::string::npos) << report.notes[0];
  EXPECT_EQ(readModel(several.path() + "/sparse/0/images.txt").images.size(), 5u);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

// Malformed models: every fault is reported with its place, nothing crashes. Those that are not mended, or in strict mode.
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "ModelChecks.hpp"
#include "SfmScene.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using test::TemporaryFolder;
using Files = std::map<std::string, std::string>;

const Files kText{{"cameras.txt", "# cameras\n1 SIMPLE_RADIAL 640 480 500 320 240 0.1\n2 PINHOLE 640 480 500 510 320 240\n"},
                  {"images.txt",
                   "# images\n1 1 0 0 0 0 0 5 1 a.jpg\n10 20 7 30 40 -1\n2 1 0 0 0 1 0 5 2 b.jpg\n50 60 7 70 80 8\n"
                   "3 1 0 0 0 2 0 5 2 c.jpg\n15 25 8\n"},
                  {"points3D.txt", "# points\n7 0 0 1 9 9 9 0.5 1 0 2 0\n8 1 1 1 9 9 9 0.5 2 1 3 0\n"}};
const std::string kBundler =
    "# Bundle file v0.3\n2 1\n500 0.1 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -5\n510 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 -5\n"
    "0 0 1\n1 2 3\n2 0 3 10 20 1 4 50 60\n";
const std::string kNvm =
    "NVM_V3 FixedK 500 320 510 240\n\n2\na.jpg 500 1 0 0 0 0 0 -5 0.1 0\nb.jpg 500 1 0 0 0 1 0 -5 0 0\n\n1\n"
    "0 0 1 9 9 9 2 0 3 10 20 1 4 50 60\n\n0\n#PLY\n0\n";
const std::string kProblem = "# problem\nquery 500 1 0 0 0 0 0 5\ncam 3 1 2 3\np3 10 20 1 2 3\np2 30 40 3 0 0 1\n";

const ReadOptions kStrict{true, true};

void writeFiles(const TemporaryFolder& folder, const Files& files) {
  for (const auto& [name, contents] : files) folder.write(name, contents);
}

// The text with the only occurrence of `from` replaced.
std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from;
  EXPECT_EQ(text.find(from, position + 1), std::string::npos) << "ambiguous: " << from;
  return position == std::string::npos ? text : text.substr(0, position) + to + text.substr(position + from.size());
}

struct Fault {
  std::string from, to;
  std::size_t line;
  std::string message;
};

void expectFault(const std::function<void()>& read, const std::string& file, const Fault& fault) {
  SCOPED_TRACE("'" + fault.from + "' -> '" + fault.to + "'");
  try {
    read();
    ADD_FAILURE() << "was accepted";
  } catch (const FileError& error) {
    EXPECT_EQ(error.file(), file);
    EXPECT_EQ(error.line(), fault.line) << error.what();
    EXPECT_NE(std::string(error.what()).find(fault.message), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).rfind(file, 0), 0u) << error.what();
  }
}

void expectColmapFaults(const std::string& name, const std::vector<Fault>& faults) {
  const TemporaryFolder folder;
  for (const Fault& fault : faults) {
    Files files = kText;
    files[name] = replaced(files[name], fault.from, fault.to);
    writeFiles(folder, files);
    expectFault([&] { readModel(folder.path(), kStrict); }, folder.file(name), fault);
  }
}

void expectFileFaults(const std::string& valid, const std::vector<Fault>& faults) {
  const TemporaryFolder folder;
  for (const Fault& fault : faults) {
    const std::string path = folder.write("file", replaced(valid, fault.from, fault.to));
    if (valid == kProblem)
      expectFault([&] { readProblem(path, kStrict); }, path, fault);
    else
      expectFault([&] { readModel(path, kStrict); }, path, fault);
  }
}

TEST(MalformedFiles, TheUndamagedFilesAreRead) {
  const TemporaryFolder folder;
  writeFiles(folder, kText);
  EXPECT_EQ(readModel(folder.path(), kStrict).points.size(), 2u);
  EXPECT_EQ(readModel(folder.write("bundle.out", kBundler), kStrict).points.size(), 1u);
  EXPECT_EQ(readModel(folder.write("model.nvm", kNvm), kStrict).points.size(), 1u);
  EXPECT_EQ(readProblem(folder.write("problem.txt", kProblem), kStrict).adapter.getNumberCorrespondences2d2d(), 1u);
}

TEST(MalformedFiles, ColmapCameras) {
  expectColmapFaults("cameras.txt", {
                                        {"SIMPLE_RADIAL", "OPENCV_FISHEYE_2", 2, "OPENCV_FISHEYE_2"},
                                        {"SIMPLE_RADIAL", "simple_radial", 2, "simple_radial"},
                                        {"SIMPLE_RADIAL", "", 2, "camera model"},
                                        {"1 SIMPLE", "2 SIMPLE", 3, "occurs twice"},
                                        {"1 SIMPLE", "-1 SIMPLE", 2, "'-1'"},
                                        {"1 SIMPLE", "4294967296 SIMPLE", 2, "4294967296"},
                                        {"320 240 0.1", "320 240", 2, "line ends"},
                                        {"320 240 0.1", "320 240 0.1 7", 2, "'7'"},
                                        {"320 240 0.1", "320 240 nan", 2, "must be finite"},
                                        {"320 240 0.1", "320 240 inf", 2, "must be finite"},
                                        {"320 240 0.1", "320 240 1e999", 2, "must be finite"},
                                        {"320 240 0.1", "320 240 0,1", 2, "'0,1'"},
                                        {"320 240 0.1", "320 240 0x1", 2, "'0x1'"},
                                        {"320 240 0.1", std::string("320 240 \0\1", 10), 2, "is not a number"},
                                        {"500 320", "0 320", 2, "focal length"},
                                        {"500 320", "-500 320", 2, "focal length"},
                                        {"640 480 500 510", "640.5 480 500 510", 3, "640.5"},
                                        {"640 480 500 510", "w 480 500 510", 3, "'w'"},
                                    });
}

TEST(MalformedFiles, ColmapImages) {
  expectColmapFaults("images.txt", {
                                       {"2 1 0 0 0 1 0 5 2 b.jpg", "1 1 0 0 0 1 0 5 2 b.jpg", 4, "image 1 occurs twice"},
                                       {"2 1 0 0 0 1 0 5 2 b.jpg", "2 0 0 0 0 1 0 5 2 b.jpg", 4, "quaternion"},
                                       {"2 1 0 0 0 1 0 5 2 b.jpg", "2 nan 0 0 0 1 0 5 2 b.jpg", 4, "quaternion"},
                                       {"2 1 0 0 0 1 0 5 2 b.jpg", "2 1 0.5 0 0 1.7e308 1.7e308 1.7e308 2 b.jpg", 4, "position"},
                                       {"2 1 0 0 0 1 0 5 2 b.jpg", "2 1 0 0 0 1 0 5 9 b.jpg", 4, "no camera 9"},
                                       {"2 1 0 0 0 1 0 5 2 b.jpg", "2 1 0 0 0 1 0 5 2", 4, "name"},
                                       {"2 1 0 0 0 1 0 5 2 b.jpg", "2 1 0 0 0 1 0", 4, "line ends"},
                                       {"2 1 0 0 0 1 0 5 2 b.jpg\n", "", 4, "line ends"},
                                       {"50 60 7 70 80 8\n", "", 5, "no point 0"},
                                       {"50 60 7 70 80 8", "50 60 7 70 80", 5, "line ends"},
                                       {"50 60 7 70 80 8", "50 60 7 70", 5, "line ends"},
                                       {"50 60 7", "50 60 9", 5, "no point 9"},
                                       {"50 60 7", "50 60 -2", 5, "'-2'"},
                                       {"50 60 7", "50 inf 7", 5, "not finite"},
                                       {"50 60 7", "50 60 7.5", 5, "7.5"},
                                       {"15 25 8\n", "", 7, "file ends"},
                                       {"30 40 -1", "30 40 7", FileError::kNowhere, "does not list it"},
                                   });
}

TEST(MalformedFiles, ColmapPoints) {
  expectColmapFaults("points3D.txt", {
                                         {"8 1 1 1", "7 1 1 1", 3, "point 7 occurs twice"},
                                         {"8 1 1 1", "8 1 1 nan", 3, "not finite"},
                                         {"8 1 1 1", "-8 1 1 1", 3, "'-8'"},
                                         {"8 1 1 1 9", "8 1 1 1 256", 3, "256"},
                                         {"8 1 1 1 9", "8 1 1 1 -1", 3, "'-1'"},
                                         {"2 1 3 0", "2 1 3", 3, "line ends"},
                                         {"2 1 3 0", "2 1 9 0", 3, "no image 9"},
                                         {"2 1 3 0", "2 7 3 0", 3, "2 observations"},
                                         {"2 1 3 0", "2 0 3 0", 3, "does not say"},
                                         {"2 1 3 0", "2 1 2 1", 3, "listed twice"},
                                         {"2 1 3 0", "2 99999999999 3 0", 3, "99999999999"},
                                         {"2 1 3 0", "x", 3, "'x'"},
                                         {"0.5 2 1 3 0", "", 3, "line ends"},
                                         {"8 1 1 1 9 9 9 0.5 2 1 3 0\n", "trash\n", 3, "'trash'"},
                                     });
}

TEST(MalformedFiles, ColmapFoldersThatLackSomething) {
  const TemporaryFolder folder;
  EXPECT_THROW(readModel(folder.file("missing")), FileError);
  EXPECT_THROW(readModel(folder.path()), FileError);
  EXPECT_THROW(readColmapText(folder.path()), FileError);
  EXPECT_THROW(readColmapBinary(folder.path()), FileError);
  writeFiles(folder, kText);
  std::filesystem::remove(folder.file("points3D.txt"));
  EXPECT_THROW(readModel(folder.path()), FileError);
  std::filesystem::create_directory(folder.file("points3D.txt"));
  EXPECT_THROW(readColmapText(folder.path()), FileError);
  EXPECT_THROW(readModel("/dev/zero"), FileError);
}

TEST(MalformedFiles, Bundler) {
  expectFileFaults(kBundler, {
                                 {"v0.3", "v0.4", 1, "v0.3"},
                                 {"2 1\n", "2\n", 3, "500 do not fit"},
                                 {"2 1\n500", "x 1\n500", 2, "'x'"},
                                 {"2 1\n500", "-2 1\n500", 2, "'-2'"},
                                 {"2 1\n500", "2000000000 1\n500", 2, "do not fit"},
                                 {"2 1\n500", "2 18446744073709551615\n500", 2, "do not fit"},
                                 {"2 1\n500", "2 99999999999999999999999\n500", 2, "out of range"},
                                 {"2 1\n500", "2 2\n500", 16, "file ends"},
                                 {"2 1\n500", "2 0\n500", 13, "more after"},
                                 {"500 0.1 0", "-500 0.1 0", 7, "negative"},
                                 {"500 0.1 0", "500 nan 0", 7, "not finite"},
                                 {"500 0.1 0", "500 text 0", 3, "'text'"},
                                 {"500 0.1 0\n1 0 0", "500 0.1 0\n1 1 0", 7, "not a rotation"},
                                 {"500 0.1 0\n1 0 0", "500 0.1 0\n-1 0 0", 7, "not a rotation"},
                                 {"500 0.1 0\n1 0 0", "0 0.1 0\n1 0 0", 15, "no pose"},
                                 {"1 0 -5\n", "1e308 -1e308 inf\n", 12, "not finite"},
                                 {"1 2 3\n", "1 2 300\n", 14, "300"},
                                 {"2 0 3 10", "2 5 3 10", 15, "no camera 5"},
                                 {"2 0 3 10", "2 -1 3 10", 15, "'-1'"},
                                 {"2 0 3 10", "99999999 0 3 10", 15, "do not fit"},
                                 {"2 0 3 10", "1 0 3 10", 15, "more after"},
                                 {"50 60", "50", 16, "file ends"},
                                 {"50 60", "50 -inf", 15, "not finite"},
                                 {"50 60", "50 60\ntrailing", 16, "more after"},
                             });
}

TEST(MalformedFiles, Nvm) {
  expectFileFaults(kNvm, {
                             {"NVM_V3", "NVM_V4", 1, "this is no map"},
                             {"FixedK", "FixedX", 1, "FixedX"},
                             {"FixedK 500", "FixedK -500", 1, "positive"},
                             {"FixedK 500 320 510 240", "FixedK 500 320 510", 4, "'a.jpg'"},
                             {"FixedK 500 320 510 240", "FixedK 500 320 510 240 7", 1, "four numbers"},
                             {"\n2\n", "\nb\n", 3, "'b'"},
                             {"\n2\n", "\n200000000000\n", 3, "do not fit"},
                             {"\n2\n", "\n1\n", 5, "'b.jpg'"},
                             {"NVM_V3 FixedK 500 320 510 240\n\n2\na.jpg 500", "NVM_V3\n\n2\na.jpg 0", 4, "positive"},
                             {"a.jpg 500 1", "a.jpg 500 0", 4, "quaternion"},
                             {"a.jpg 500 1", "a.jpg 500 nan", 4, "quaternion"},
                             {"\n1\n0 0", "\n99999999\n0 0", 7, "do not fit"},
                             {"\n1\n0 0", "\n-1\n0 0", 7, "'-1'"},
                             {"9 2 0 3", "9 2 2 3", 8, "no image 2"},
                             {"9 2 0 3", "9 200 0 3", 8, "do not fit"},
                             {"50 60", "50 6o", 8, "'6o'"},
                             {"#PLY\n0\n", "#PLY\n0\ngarbage\n", 13, "more after"},
                             {"#PLY\n0\n", "#PLY\n5\n", 12, "do not fit"},
                         });
}

TEST(MalformedFiles, Problems) {
  expectFileFaults(kProblem, {
                                 {"query", "question", 2, "'question'"},
                                 {"query 500", "query 0", 2, "positive"},
                                 {"query 500", "query x", 2, "'x'"},
                                 {"500 1 0 0 0", "500 0 0 0 0", 2, "quaternion"},
                                 {"0 0 5\n", "0 0 5 6\n", 2, "'6'"},
                                 {"0 0 5\n", "0 0\n", 2, "line ends"},
                                 {"cam 3 1 2 3", "query 500 1 0 0 0 0 0 5", 3, "second"},
                                 {"cam 3 1 2 3", "cam 3 1 2 3\ncam 3 1 2 3", 4, "occurs twice"},
                                 {"cam 3 1 2 3", "", 5, "no camera 3"},
                                 {"cam 3 1 2 3", "cam 3 1 2 nan", 3, "not finite"},
                                 {"cam 3 1 2 3", "cam 3 1 2 3 500", 3, "line ends"},
                                 {"cam 3 1 2 3", "cam 3 1 2 3 -1 1 0 0 0", 3, "negative"},
                                 {"cam 3 1 2 3", "cam 3 1 2 3 500 0 0 0 0", 3, "quaternion"},
                                 {"cam 3 1 2 3", "cam 3 1 2 3 500 1 0 0 0 7", 3, "'7'"},
                                 {"cam 3 1 2 3", "image 640\ncam 3 1 2 3", 3, "line ends"},
                                 {"cam 3 1 2 3", "image 640 0\ncam 3 1 2 3", 3, "positive"},
                                 {"cam 3 1 2 3", "image 9 9\nimage 9 9\ncam 3 1 2 3", 4, "second"},
                                 {"p3 10 20 1 2 3", "p3 10 20 1 2", 4, "line ends"},
                                 {"p2 30 40 3", "p2 30 40 4", 5, "no camera 4"},
                                 {"p2 30 40 3 0 0 1", "p2 30 40 3 0 0 0", 5, "length zero"},
                                 {"p2 30 40 3 0 0 1", "p2 30 40 3 0 0 inf", 5, "not finite"},
                             });
}

TEST(MalformedFiles, UnknownFormats) {
  const TemporaryFolder folder;
  for (const std::string& contents : {std::string(), std::string("\n"), std::string(1000, '\0'), std::string("\x89PNG\r\n\x1a\n"),
                                      std::string("ply\nformat ascii 1.0\n"), std::string(100000, 'x')})
    EXPECT_THROW(readModel(folder.write("file", contents)), FileError) << contents.substr(0, 10);
}

Files writtenBinary() {
  test::Random random(test::testSeed());
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), test::makeScene(random, 3, 6, 0.8, {CameraModel::SimpleRadial, CameraModel::OpenCV}));
  Files files;
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) files[name] = folder.read(name);
  return files;
}

TEST(MalformedFiles, BinaryTruncatedAnywhere) {
  const Files valid = writtenBinary();
  const TemporaryFolder folder;
  writeFiles(folder, valid);
  readModel(folder.path());
  for (const auto& [name, contents] : valid) {
    for (std::size_t length = 0; length < contents.size(); ++length) {
      folder.write(name, contents.substr(0, length));
      try {
        readModel(folder.path());
        ADD_FAILURE() << name << " of " << length << " bytes was accepted";
      } catch (const FileError& error) {
        EXPECT_EQ(error.file(), folder.file(name));
        EXPECT_LE(error.byteOffset(), length) << error.what();
      }
    }
    folder.write(name, contents + '\0');
    EXPECT_THROW(readModel(folder.path()), FileError) << name;
    folder.write(name, contents);
  }
}

// The eight bytes of every count replaced by gigantic numbers: refused before anything is allocated for them.
TEST(MalformedFiles, BinaryGiganticCounts) {
  const Files valid = writtenBinary();
  const TemporaryFolder folder;
  writeFiles(folder, valid);
  for (const auto& [name, contents] : valid)
    for (const unsigned char top : {0x00, 0x01, 0x7f, 0xff}) {
      std::string damaged = contents;
      for (std::size_t i = 0; i < 8; ++i) damaged[i] = static_cast<char>(i == 7 ? top : 0xff);
      folder.write(name, damaged);
      try {
        readModel(folder.path());
        ADD_FAILURE() << name << " was accepted";
      } catch (const FileError& error) {
        EXPECT_EQ(error.byteOffset(), 0u);
        EXPECT_NE(std::string(error.what()).find("do not fit"), std::string::npos) << error.what();
      }
      folder.write(name, contents);
    }
}

TEST(MalformedFiles, BinaryUnsupportedCameraIsNamed) {
  Files files = writtenBinary();
  const TemporaryFolder folder;
  for (const auto& [number, name] : std::map<int, std::string>{{18, "18"}, {99, "99"}, {255, "255"}}) {
    files["cameras.bin"][12] = static_cast<char>(number);
    writeFiles(folder, files);
    try {
      readModel(folder.path(), kStrict);
      ADD_FAILURE() << name;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      EXPECT_EQ(error.byteOffset(), 12u);
    }
  }
}

// Reads; a model that is accepted must be valid, an error must be a FileError.
void readAnything(const std::function<SparseModel()>& read) {
  try {
    checkModel(read());
  } catch (const FileError&) {
  }
}

TEST(MalformedFiles, TextTruncatedAnywhereIsRefusedOrAValidModel) {
  const TemporaryFolder folder;
  for (const auto& [name, contents] : kText)
    for (std::size_t length = 0; length < contents.size(); ++length) {
      Files files = kText;
      files[name] = contents.substr(0, length);
      writeFiles(folder, files);
      readAnything([&] { return readModel(folder.path()); });
      // Without a whole last line, some observation or point is missing that another file names.
      if (contents[length] == '\n' && length + 1 < contents.size()) {
        EXPECT_THROW(readModel(folder.path(), kStrict), FileError) << files[name];
      }
    }
  for (const std::string& contents : {kBundler, kNvm, kProblem})
    for (std::size_t length = 0; length < contents.size(); ++length) {
      const std::string path = folder.write("file", contents.substr(0, length));
      if (contents == kProblem) {
        try {
          readProblem(path);
        } catch (const FileError&) {
        }
      } else {
        readAnything([&] { return readModel(path); });
      }
    }
}

TEST(MalformedFiles, RandomDamageIsRefusedOrAValidModel) {
  test::Random random(test::testSeed(), 1);
  const auto damage = [&](std::string contents) {
    for (int i = random.index(3); i >= 0 && !contents.empty(); --i) {
      const auto at = static_cast<std::size_t>(random.index(static_cast<int>(contents.size())));
      switch (random.index(4)) {
        case 0:
          contents[at] = static_cast<char>(random.index(256));
          break;
        case 1:
          contents[at] = "0123456789-+.e \n#"[random.index(17)];
          break;
        case 2:
          contents.erase(at, static_cast<std::size_t>(random.index(12)));
          break;
        default:
          contents.insert(at, contents.substr(static_cast<std::size_t>(random.index(static_cast<int>(contents.size()))), 8));
      }
    }
    return contents;
  };
  const Files binary = writtenBinary();
  const TemporaryFolder text, bytes;
  for (int i = 0; i < 1500; ++i) {
    for (const auto& [folder, valid] : {std::make_pair(&text, &kText), std::make_pair(&bytes, &binary)}) {
      Files files = *valid;
      auto file = std::next(files.begin(), random.index(3));
      file->second = damage(file->second);
      writeFiles(*folder, files);
      readAnything([path = folder->path()] { return readModel(path); });
    }
    readAnything([&] { return readModel(text.write("file", damage(i % 2 ? kBundler : kNvm))); });
    try {
      readProblem(text.write("file", damage(kProblem)));
    } catch (const FileError&) {
    }
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

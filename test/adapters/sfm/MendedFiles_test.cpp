// Maps as other programs and scripts leave them: read, mended and told; in strict mode refused.
#include <gtest/gtest.h>

#include <algorithm>
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

using Eigen::Vector3d;
using test::TemporaryFolder;

const ReadOptions kStrict{true, true};

SparseModel scene(std::size_t images = 5, std::size_t points = 40) {
  test::Random random(test::testSeed(), 40);
  SparseModel model = test::makeScene(random, images, points, 1, {CameraModel::SimplePinhole, CameraModel::OpenCV});
  for (std::size_t i = 0; i < images; ++i) model.images[i].id = static_cast<std::uint32_t>(i + 1);
  return model;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; begin = end + 1, end = text.find('\n', begin))
    lines.push_back(text.substr(begin, end - begin));
  if (begin < text.size()) lines.push_back(text.substr(begin));
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t i = text.find(from); i != std::string::npos; i = text.find(from, i + to.size()))
    text.replace(i, from.size(), to);
  return text;
}

std::vector<std::string> wordsOf(const std::string& line) {
  std::vector<std::string> words;
  std::size_t begin = line.find_first_not_of(' ');
  while (begin != std::string::npos) {
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(' ', end);
  }
  return words;
}

std::string lineOf(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::string numberText(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// The folder's model must be readable, valid, refused in strict mode, and report exactly these mends (others none).
SparseModel expectMends(const std::string& path, const std::map<Mend, std::size_t>& mends) {
  SCOPED_TRACE(path);
  ReadReport report;
  SparseModel model = readModel(path, {}, &report);
  checkModel(model);
  for (std::size_t i = 0; i < kMendCount; ++i) {
    const auto expected = mends.find(static_cast<Mend>(i));
    EXPECT_EQ(report.counts[i], expected == mends.end() ? 0 : expected->second) << toString(static_cast<Mend>(i));
    EXPECT_EQ(report.firstPlaces[i].empty(), report.counts[i] == 0);
  }
  EXPECT_EQ(report.sentences().size(), mends.size() + report.notes.size());
  EXPECT_EQ(report.isEmpty(), mends.empty() && report.notes.empty());
  if (!mends.empty()) {
    EXPECT_THROW(readModel(path, kStrict), FileError);
  }
  return model;
}

// The model as text files, changed.
class TextMap {
 public:
  explicit TextMap(const SparseModel& model) { writeColmapText(folder.path(), model); }
  void change(const std::string& name, const std::function<std::string(std::string)>& change) const {
    folder.write(name, change(folder.read(name)));
  }
  // Changes the words of every line that is no comment.
  void changeLines(const std::string& name, const std::function<void(std::vector<std::string>&, std::size_t)>& change) const {
    std::vector<std::string> lines = linesOf(folder.read(name));
    std::size_t index = 0;
    for (std::string& line : lines) {
      if (line.rfind('#', 0) == 0) continue;
      std::vector<std::string> words = wordsOf(line);
      change(words, index++);
      line = lineOf(words);
    }
    folder.write(name, joined(lines));
  }
  TemporaryFolder folder;
};

std::size_t countTrackElements(const SparseModel& model) {
  std::size_t count = 0;
  for (const Point& point : model.points) count += point.track.size();
  return count;
}

void expectSameTracks(const SparseModel& a, const SparseModel& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const auto pairs = [](const Point& point) {
      std::vector<std::pair<std::size_t, std::size_t>> result;
      for (const TrackElement& e : point.track) result.emplace_back(e.image, e.observation);
      std::sort(result.begin(), result.end());
      return result;
    };
    EXPECT_EQ(pairs(a.points[i]), pairs(b.points[i])) << i;
  }
}

// Removes images (header and observations) by their index.
std::string withoutImages(const std::string& text, const std::vector<std::size_t>& removed) {
  std::vector<std::string> kept;
  std::size_t line = 0;
  for (const std::string& l : linesOf(text)) {
    const bool isComment = l.rfind('#', 0) == 0;
    if (!isComment && std::count(removed.begin(), removed.end(), line / 2) > 0) {
      ++line;
      continue;
    }
    if (!isComment) ++line;
    kept.push_back(l);
  }
  return joined(kept);
}

TEST(MendedFiles, WhatTheWritersWriteNeedsNoMend) {
  const TextMap map(scene());
  expectMends(map.folder.path(), {});
  EXPECT_NO_THROW(readModel(map.folder.path(), kStrict));
}

TEST(MendedFiles, TracksMayNameRemovedImages) {
  for (const std::vector<std::size_t>& removed : {std::vector<std::size_t>{2}, {0, 1, 4}}) {
    const SparseModel original = scene();
    const TextMap map(original);
    map.change("images.txt", [&](const std::string& text) { return withoutImages(text, removed); });
    const SparseModel model = expectMends(map.folder.path(), {{Mend::TrackOfMissingImage, 40 * removed.size()}});
    EXPECT_EQ(model.images.size(), 5 - removed.size());
    EXPECT_EQ(countTrackElements(model), 40 * (5 - removed.size()));
  }
}

TEST(MendedFiles, TracksMayHaveWrongObservationNumbers) {
  const SparseModel original = scene();
  const auto numbered = [&](const std::function<std::string(const std::string&)>& number) {
    const TextMap map(original);
    map.changeLines("points3D.txt", [&](std::vector<std::string>& words, std::size_t) {
      for (std::size_t i = 9; i < words.size(); i += 2) words[i] = number(words[i]);
    });
    ReadReport report;
    const SparseModel model = readModel(map.folder.path(), {}, &report);
    EXPECT_EQ(report.count(Mend::TrackWithWrongNumber) + report.count(Mend::TrackWithRepetition),
              report.count(Mend::ObservationNotInTrack));
    EXPECT_GT(report.count(Mend::ObservationNotInTrack), 100u);
    EXPECT_THROW(readModel(map.folder.path(), kStrict), FileError);
    expectSameTracks(model, original);
  };
  numbered([](const std::string&) { return std::string("0"); });
  numbered([](const std::string& number) { return std::to_string(std::stoi(number) + 1); });  // counted from one
  numbered([](const std::string&) { return std::string("4000000000"); });
}

TEST(MendedFiles, TracksMayBeEmptyOrRepeatThemselves) {
  const SparseModel original = scene();
  const TextMap empty(original), twice(original);
  empty.changeLines("points3D.txt", [](std::vector<std::string>& words, std::size_t) { words.resize(8); });
  expectSameTracks(expectMends(empty.folder.path(), {{Mend::ObservationNotInTrack, 200}}), original);
  twice.changeLines("points3D.txt", [](std::vector<std::string>& words, std::size_t) {
    words.push_back(words[8]);
    words.push_back(words[9]);
  });
  expectSameTracks(expectMends(twice.folder.path(), {{Mend::TrackWithRepetition, 40}}), original);
}

TEST(MendedFiles, ImagesMayLeaveTheirPointsToTheTracks) {
  const SparseModel original = scene();
  const TextMap map(original);
  map.changeLines("images.txt", [](std::vector<std::string>& words, std::size_t line) {
    if (line % 2 == 1)
      for (std::size_t i = 2; i < words.size(); i += 3) words[i] = "-1";
  });
  expectSameTracks(expectMends(map.folder.path(), {{Mend::ObservationWithoutId, 200}}), original);
}

TEST(MendedFiles, ObservationsMayNameRemovedPoints) {
  const TextMap map(scene());
  map.change("points3D.txt", [](const std::string& text) {
    std::vector<std::string> lines = linesOf(text);
    lines.resize(lines.size() - 10);
    return joined(lines);
  });
  EXPECT_EQ(expectMends(map.folder.path(), {{Mend::ObservationOfMissingPoint, 50}}).points.size(), 30u);
}

TEST(MendedFiles, ImagesMayNameRemovedCameras) {
  const TextMap map(scene());
  map.change("cameras.txt", [](const std::string& text) {
    std::vector<std::string> lines = linesOf(text);
    lines.pop_back();
    return joined(lines);
  });
  const SparseModel model = expectMends(map.folder.path(), {{Mend::ImageWithoutCamera, 2}, {Mend::TrackOfMissingImage, 80}});
  EXPECT_EQ(model.images.size(), 3u);
}

TEST(MendedFiles, PointsMayBeInfiniteInAnySystemsSpelling) {
  for (const char* word :
       {"nan", "-nan", "inf", "-inf", "NaN", "Infinity", "1.#INF", "-1.#IND", "1.#QNAN", "-nan(ind)", "1e999"}) {
    SCOPED_TRACE(word);
    const TextMap map(scene());
    map.changeLines("points3D.txt", [&](std::vector<std::string>& words, std::size_t line) {
      if (line == 7) words[2] = word;
    });
    const SparseModel model = expectMends(map.folder.path(), {{Mend::PointNotFinite, 1}});
    EXPECT_EQ(model.points.size(), 39u);
    EXPECT_EQ(countTrackElements(model), 195u);
  }
}

TEST(MendedFiles, NumbersThatNobodyNeedsMayBeNoNumbers) {
  const TextMap map(scene());
  map.changeLines("points3D.txt", [&](std::vector<std::string>& words, std::size_t line) {
    if (line == 3) words[7] = "nan";
    if (line == 4) words[4] = "-1";
    if (line == 5) words[5] = "300";
    if (line == 6) words[6] = "128.7";
    if (line == 8) words[6] = "nan";
  });
  const SparseModel model = expectMends(map.folder.path(), {{Mend::PointErrorNotFinite, 1}, {Mend::ColourOutOfRange, 4}});
  EXPECT_EQ(model.points[3].error, -1);
  EXPECT_EQ(model.points[4].colour[0], 0);
  EXPECT_EQ(model.points[5].colour[1], 255);
  EXPECT_EQ(model.points[6].colour[2], 128);
  EXPECT_EQ(model.points[8].colour[2], 0);
}

TEST(MendedFiles, ObservationsMayBeNowhere) {
  const TextMap map(scene());
  map.changeLines("images.txt", [&](std::vector<std::string>& words, std::size_t line) {
    if (line != 3) return;
    for (std::size_t i = 0; i < words.size(); i += 3)
      if (words[i + 2] != "-1") {
        words[i] = "nan";
        return;
      }
  });
  const SparseModel model = expectMends(map.folder.path(), {{Mend::ObservationNotFinite, 1}, {Mend::TrackWithWrongNumber, 1}});
  EXPECT_EQ(countTrackElements(model), 199u);
}

TEST(MendedFiles, IntegersMayHaveAFraction) {
  const TextMap map(scene());
  map.changeLines("cameras.txt", [](std::vector<std::string>& words, std::size_t) {
    words[2] += ".0";
    words[3] += ".000";
  });
  map.changeLines("points3D.txt", [](std::vector<std::string>& words, std::size_t) {
    for (const std::size_t i : {0, 4, 5, 6, 8, 9}) words[i] += ".0";
  });
  map.changeLines("images.txt", [](std::vector<std::string>& words, std::size_t line) {
    if (line == 1) words[2] = words[2] == "-1" ? "-1.0" : words[2] + ".0";
  });
  ReadReport report;
  const SparseModel model = readModel(map.folder.path(), {}, &report);
  EXPECT_GE(report.count(Mend::FractionForInteger), 4u + 240u);
  EXPECT_EQ(model.cameras[0].width, 1000u);
  expectSameTracks(model, scene());
  map.changeLines("points3D.txt", [](std::vector<std::string>& words, std::size_t) { words[0] += "5"; });
  EXPECT_THROW(readModel(map.folder.path()), FileError);
}

TEST(MendedFiles, PosesMayMakeNoSense) {
  for (const std::vector<std::pair<std::size_t, std::string>>& changes :
       {std::vector<std::pair<std::size_t, std::string>>{{1, "0"}, {2, "0"}, {3, "0"}, {4, "0"}}, {{3, "nan"}}, {{6, "inf"}}}) {
    const TextMap map(scene());
    map.changeLines("images.txt", [&](std::vector<std::string>& words, std::size_t line) {
      if (line == 4)
        for (const auto& [word, value] : changes) words[word] = value;
    });
    const SparseModel model =
        expectMends(map.folder.path(), {{Mend::ImageWithoutUsablePose, 1}, {Mend::TrackOfUnregisteredImage, 40}});
    EXPECT_FALSE(model.images[2].registered);
  }
}

TEST(MendedFiles, CamerasMayMakeNoSenseOrBeNewerThanTheLibrary) {
  for (const bool isUnknown : {false, true}) {
    const SparseModel original = scene();
    const TextMap map(original);
    map.changeLines("cameras.txt", [&](std::vector<std::string>& words, std::size_t line) {
      if (line == 1) words[isUnknown ? 1 : 4] = isUnknown ? "OPENCV_OF_TOMORROW" : "nan";
    });
    const Mend mend = isUnknown ? Mend::UnknownCameraModel : Mend::UnusableCamera;
    const SparseModel model = expectMends(map.folder.path(), {{mend, 1}});
    EXPECT_EQ(std::count_if(model.images.begin(), model.images.end(), [](const Image& i) { return i.registered; }), 3);
    EXPECT_GT(makeLocalizationProblem(model, 0).points2d3d.size(), 20u);
    // Those images are carried along. (In the other format an unknown model cannot be named.)
    const TemporaryFolder copy, other;
    writeColmapText(copy.path(), model);
    for (const char* file : {"cameras.txt", "images.txt", "points3D.txt"}) EXPECT_EQ(copy.read(file), map.folder.read(file));
    writeColmapBinary(other.path(), model);
    if (isUnknown)
      EXPECT_EQ(readModel(other.path(), kStrict).images.size(), 3u);
    else
      EXPECT_EQ(expectMends(other.path(), {{mend, 1}}).images.size(), original.images.size());
  }
}

// The binary files do not say how long the record of an unknown model is.
TEST(MendedFiles, UnknownCameraModelsInBinaryFilesLeaveTheOthersReadable) {
  test::Random random(test::testSeed(), 41);
  const SparseModel original = test::makeScene(
      random, 8, 40, 1, {CameraModel::Pinhole, CameraModel::FullOpenCV, CameraModel::SimpleRadial, CameraModel::FullOpenCV});
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), original);
  std::string bytes = folder.read("cameras.bin");
  const std::size_t second = 8 + 24 + 4 * 8, fourth = second + 24 + 12 * 8 + 24 + 4 * 8;
  ASSERT_EQ(bytes[second + 4], 6);
  ASSERT_EQ(bytes[fourth + 4], 6);
  for (const int number : {30, -2}) {
    bytes[second + 4] = bytes[fourth + 4] = static_cast<char>(number);
    if (number < 0)
      for (std::size_t i = 5; i < 8; ++i) bytes[second + i] = bytes[fourth + i] = static_cast<char>(0xff);
    folder.write("cameras.bin", bytes);
    const SparseModel model = expectMends(folder.path(), {{Mend::UnknownCameraModel, 2}});
    ASSERT_EQ(model.cameras.size(), 4u);
    EXPECT_EQ(model.cameras[2].parameters, original.cameras[2].parameters);
    EXPECT_EQ(model.cameras[3].parameters.size(), 12u);
    const TemporaryFolder copy;
    writeColmapBinary(copy.path(), model);
    for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"})
      EXPECT_TRUE(copy.read(file) == folder.read(file)) << file;
  }
}

TEST(MendedFiles, TextFilesMayBeCutInTheirLastLine) {
  const SparseModel original = scene();
  for (const char* name : {"cameras.txt", "images.txt", "points3D.txt"}) {
    const TextMap map(original);
    const std::string whole = map.folder.read(name);
    const std::size_t lastLine = whole.rfind('\n', whole.size() - 2) + 1;
    for (std::size_t length = lastLine + 1; length < whole.size(); length += 1 + (whole.size() - lastLine) / 40) {
      map.folder.write(name, whole.substr(0, length));
      ReadReport report;
      const SparseModel model = readModel(map.folder.path(), {}, &report);
      checkModel(model);
      EXPECT_GE(model.points.size(), 39u) << name << " " << length;
      EXPECT_GE(model.images.size(), 3u) << name << " " << length;
    }
  }
  // A line end after the cut says that the line is meant like that.
  const TextMap map(original);
  map.change("points3D.txt", [](const std::string& text) { return text.substr(0, text.size() - 3) + "\n"; });
  EXPECT_THROW(readModel(map.folder.path()), FileError);
}

TEST(MendedFiles, TextFilesMayStartWithByteOrderMarks) {
  const SparseModel original = scene();
  const TextMap map(original);
  for (const char* name : {"cameras.txt", "images.txt", "points3D.txt"})
    map.change(name, [](const std::string& text) { return "\xef\xbb\xbf" + text; });
  expectSameTracks(expectMends(map.folder.path(), {{Mend::ByteOrderMark, 3}}), original);

  const auto utf16 = [](const std::string& text, bool isLittleEndian) {
    std::string result = isLittleEndian ? "\xff\xfe" : "\xfe\xff";
    for (const char c : text) {
      result += isLittleEndian ? std::string{c, '\0'} : std::string{'\0', c};
    }
    return result;
  };
  for (const bool isLittleEndian : {true, false}) {
    const TextMap wide(original);
    wide.change("points3D.txt", [&](const std::string& text) { return utf16(replacedAll(text, "\n", "\r\n"), isLittleEndian); });
    expectSameTracks(expectMends(wide.folder.path(), {{Mend::ByteOrderMark, 1}}), original);
  }
  const TemporaryFolder folder;
  const std::string problem = folder.write("problem.txt", "\xef\xbb\xbfp3 1 2 3 4 5\n");
  EXPECT_TRUE(isProblemFile(problem));
  ReadReport report;
  EXPECT_EQ(readProblem(problem, {}, &report).adapter.getNumberCorrespondences2d3d(), 1u);
  EXPECT_EQ(report.count(Mend::ByteOrderMark), 1u);
  EXPECT_THROW(readProblem(problem, kStrict), FileError);
}

// ------------------------------------------------------------------------------------------------------------ NVM and Bundler

struct NvmStyle {
  bool hasMatrices = false;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  std::string nameSpace = "\"";
};

// The model as an NVM file; its cameras must be NvmRadial.
std::string nvmText(const SparseModel& model, const NvmStyle& style = {}) {
  std::string text =
      std::string(style.hasMatrices ? "NVM_V3_R9T" : "NVM_V3") + "\n\n" + std::to_string(model.images.size()) + "\n";
  for (const Image& image : model.images) {
    const Camera& camera = model.cameras[image.camera];
    text += replacedAll(image.name, " ", style.nameSpace) + " " + numberText(camera.parameters[0]);
    const Eigen::Matrix3d rotation = image.rotation.transpose();
    const Eigen::Quaterniond q(rotation);
    const Vector3d t = -(rotation * image.position);
    std::vector<double> numbers{q.w(), q.x(), q.y(), q.z(), image.position[0], image.position[1], image.position[2]};
    if (style.hasMatrices) {
      numbers.clear();
      for (int i = 0; i < 9; ++i) numbers.push_back(rotation(i / 3, i % 3));
      for (const double value : t) numbers.push_back(value);
    }
    numbers.push_back(camera.parameters[4]);
    numbers.push_back(0);
    for (const double value : numbers) text += " " + numberText(value);
    text += "\n";
  }
  text += "\n" + std::to_string(model.points.size()) + "\n";
  for (const Point& point : model.points) {
    for (const double value : point.position) text += numberText(value) + " ";
    text += "1 2 3 " + std::to_string(point.track.size());
    for (const TrackElement& e : point.track) {
      const Observation& o = model.images[e.image].observations[e.observation];
      text += " " + std::to_string(e.image) + " " + std::to_string(e.observation) + " " + numberText(o.x + style.origin[0]) +
              " " + numberText(o.y + style.origin[1]);
    }
    text += "\n";
  }
  return text + "\n0\n";
}

SparseModel nvmScene() {
  test::Random random(test::testSeed(), 42);
  SparseModel model = test::makeScene(random, 5, 40, 1, std::vector<CameraModel>(5, CameraModel::NvmRadial));
  for (std::size_t i = 0; i < 5; ++i) {
    model.cameras[i].parameters = {700 + 10.0 * static_cast<double>(i), 700 + 10.0 * static_cast<double>(i), 0, 0, 0.02};
    for (Observation& o : model.images[i].observations)
      if (o.point != Observation::kNoPoint) {
        const Image& image = model.images[i];
        const Vector3d x = image.rotation.transpose() * (model.points[o.point].position - image.position);
        const Vector3d pixel = project(model.cameras[i], x).value();
        o.x = pixel[0];
        o.y = pixel[1];
      }
  }
  return model;
}

TEST(MendedFiles, NvmMayHaveMatricesInsteadOfQuaternions) {
  const TemporaryFolder folder;
  const SparseModel original = nvmScene();
  const SparseModel model = expectMends(folder.write("model.nvm", nvmText(original, {true})), {});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT((model.images[i].rotation - original.images[i].rotation).norm(), 1e-14);
    EXPECT_LT((model.images[i].position - original.images[i].position).norm(), 1e-13);
    EXPECT_EQ(model.images[i].name, original.images[i].name);
  }
}

TEST(MendedFiles, NvmNamesMayHaveSpaces) {
  const TemporaryFolder folder;
  for (const bool hasMatrices : {false, true}) {
    const SparseModel model = expectMends(
        folder.write("model.nvm", nvmText(nvmScene(), {hasMatrices, Eigen::Vector2d::Zero(), " "})), {{Mend::NameWithSpaces, 5}});
    EXPECT_EQ(model.images[3].name, "photo 3.jpg");
  }
}

TEST(MendedFiles, NvmPositionsMayCountFromTheCornerOfTheImage) {
  const TemporaryFolder folder;
  const SparseModel original = nvmScene();
  for (const Eigen::Vector2d& origin : {Eigen::Vector2d(800, 600), Eigen::Vector2d(-320, 240)}) {
    const SparseModel model =
        expectMends(folder.write("model.nvm", nvmText(original, {false, origin})), {{Mend::OriginOfImagePositions, 5}});
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(model.cameras[i].parameters[2], origin[0], 1e-6);
      EXPECT_NEAR(model.cameras[i].parameters[3], origin[1], 1e-6);
    }
  }
}

TEST(MendedFiles, ImagesOfDifferentSizesHaveOriginsOfTheirOwn) {
  SparseModel portrait = nvmScene();
  for (std::size_t i = 0; i < 5; ++i)
    for (Observation& o : portrait.images[i].observations) {
      o.x += i % 2 ? 800 : 600;
      o.y += i % 2 ? 600 : 800;
    }
  const TemporaryFolder folder;
  const SparseModel model = expectMends(folder.write("model.nvm", nvmText(portrait)), {{Mend::OriginOfImagePositions, 5}});
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(model.cameras[i].parameters[2], i % 2 ? 800 : 600, 1e-6);
}

std::string bundlerText(const SparseModel& model) {
  std::string text =
      "# Bundle file v0.3\n" + std::to_string(model.images.size()) + " " + std::to_string(model.points.size()) + "\n";
  const Eigen::Matrix3d flip = Vector3d(1, -1, -1).asDiagonal();
  for (const Image& image : model.images) {
    const Eigen::Matrix3d rotation = flip * image.rotation.transpose();
    const Vector3d t = -(rotation * image.position);
    text += numberText(model.cameras[image.camera].parameters[0]) + " 0 0\n";
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) text += numberText(rotation(row, column)) + " ";
      text += "\n";
    }
    text += numberText(t[0]) + " " + numberText(t[1]) + " " + numberText(t[2]) + "\n";
  }
  for (const Point& point : model.points) {
    text +=
        numberText(point.position[0]) + " " + numberText(point.position[1]) + " " + numberText(point.position[2]) + "\n1 2 3\n";
    text += std::to_string(point.track.size());
    for (const TrackElement& e : point.track) {
      const Observation& o = model.images[e.image].observations[e.observation];
      text += " " + std::to_string(e.image) + " 0 " + numberText(o.x) + " " + numberText(-o.y);
    }
    text += "\n";
  }
  return text;
}

SparseModel bundlerScene() {
  SparseModel model = nvmScene();
  for (std::size_t i = 0; i < 5; ++i) {
    model.cameras[i].parameters[4] = 0;
    for (Observation& o : model.images[i].observations) {
      const Vector3d x =
          model.images[i].rotation.transpose() *
          (o.point == Observation::kNoPoint ? Vector3d(0, 0, 0) : model.points[o.point].position - model.images[i].position);
      if (o.point == Observation::kNoPoint) continue;
      o.x = model.cameras[i].parameters[0] * x[0] / x[2];
      o.y = model.cameras[i].parameters[0] * x[1] / x[2];
    }
  }
  return model;
}

TEST(MendedFiles, BundlerPointsMayBeInfinite) {
  SparseModel damaged = bundlerScene();
  const std::string text = replacedAll(bundlerText(damaged), numberText(damaged.points[9].position[0]), "1.#INF");
  const TemporaryFolder folder;
  const SparseModel model = expectMends(folder.write("bundle.out", text), {{Mend::PointNotFinite, 1}});
  EXPECT_EQ(model.points.size(), 39u);
  EXPECT_EQ(model.points[9].id, 10u);
  EXPECT_EQ(model.images[0].observations.size(), 40u);  // a feature without a point is left
}

TEST(MendedFiles, BundlerViewsMayLieInCamerasWithoutPose) {
  const TemporaryFolder folder;
  const SparseModel original = bundlerScene();
  // f = 0; a negative f; a matrix that is no rotation; a position that is nowhere
  const std::vector<std::pair<std::map<std::size_t, std::string>, std::map<Mend, std::size_t>>> cases{
      {{{0, "0 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}}},
      {{{0, "-700 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}, {Mend::UnusableCamera, 1}}},
      {{{1, "0 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}, {Mend::ImageWithoutUsablePose, 1}}},
      {{{4, "nan 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}, {Mend::ImageWithoutUsablePose, 1}}}};
  for (const auto& [changes, mends] : cases) {
    std::vector<std::string> lines = linesOf(bundlerText(original));
    for (const auto& [line, text] : changes) lines[2 + 5 * 2 + line] = text;  // of camera 2
    const SparseModel model = expectMends(folder.write("bundle.out", joined(lines)), mends);
    EXPECT_FALSE(model.images[2].registered);
    EXPECT_EQ(countTrackElements(model), 160u);
  }
}

// ------------------------------------------------------------------------------------------------------------ consistency

void expectRefused(const SparseModel& model, const std::string& reason) {
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  try {
    readModel(folder.path());
    ADD_FAILURE() << "was accepted";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("contradicts itself"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  }
  ReadReport report;
  EXPECT_NO_THROW(readModel(folder.path(), {false, false}, &report));
  EXPECT_TRUE(report.isEmpty());
  EXPECT_EQ(report.medianErrorPx, -1);
}

TEST(Consistency, MedianErrorIsReported) {
  const TextMap map(scene());
  ReadReport report;
  readModel(map.folder.path(), {}, &report);
  EXPECT_GE(report.medianErrorPx, 0);
  EXPECT_LT(report.medianErrorPx, 1e-9);
}

TEST(Consistency, MapsOfAnotherImageSizeAreRefused) {
  SparseModel model = scene();
  for (Camera& camera : model.cameras)
    for (std::size_t i = 0; i < (camera.model == CameraModel::OpenCV ? 4u : 3u); ++i) camera.parameters[i] *= 0.25;
  expectRefused(model, "median");
}

TEST(Consistency, MapsWithAnotherFocalLengthAreRefusedWithTheFactor) {
  test::Random random(test::testSeed(), 43);
  SparseModel model = test::makeScene(random, 5, 40, 1, {CameraModel::SimplePinhole});
  model.cameras[0].parameters[0] /= 1.6;
  expectRefused(model, "1.6 times");
}

TEST(Consistency, PointsOfAnotherMapAreRefused) {
  SparseModel model = scene();
  test::Random random(test::testSeed(), 44);
  for (Point& point : model.points) point.position = random.vector(-1.5, 1.5);
  expectRefused(model, "different maps");
}

TEST(Consistency, MirroredPosesAreRefused) {
  SparseModel model = scene();
  for (Image& image : model.images) image.rotation = image.rotation * Vector3d(1, -1, -1).asDiagonal();
  expectRefused(model, "cannot look");
}

TEST(Consistency, AShareOfWrongMatchesIsNoContradiction) {
  SparseModel model = scene();
  test::Random random(test::testSeed(), 45);
  for (std::size_t i = 0; i < model.points.size(); i += 3) model.points[i].position = random.vector(-100, 100);
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  EXPECT_NO_THROW(readModel(folder.path(), kStrict));
}

TEST(Consistency, PrincipalPointsOfColmapMapsAreMovedToo) {
  SparseModel model = scene();
  for (Image& image : model.images)
    for (Observation& o : image.observations) {
      o.x -= 500;
      o.y -= 400;
    }
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  const SparseModel moved = expectMends(folder.path(), {{Mend::OriginOfImagePositions, 2}});
  EXPECT_NEAR(moved.cameras[0].parameters[1], 10, 1e-6);
  EXPECT_NEAR(moved.cameras[0].parameters[2], -10, 1e-6);
}

// ------------------------------------------------------------------------------------------------------------ what is no map

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

// ------------------------------------------------------------------------------------------------------------ rigs and frames

// Two cameras on a rig, the second one turned and shifted; three frames of two images, and one of one.
SparseModel riggedScene() {
  test::Random random(test::testSeed(), 46);
  SparseModel model = test::makeScene(random, 7, 40, 1, {CameraModel::Pinhole, CameraModel::SimpleRadial});
  model.rigs = {
      {11, {{{0, model.cameras[0].id}, {}}, {{0, model.cameras[1].id}, {0.8, 0, 0.6, 0, 0.1, 0.2, 0.3}}, {{1, 77}, {}}}}};
  const auto pose = [](const Image& image) {
    const Eigen::Quaterniond q(Eigen::Matrix3d(image.rotation.transpose()));
    const Vector3d t = -(image.rotation.transpose() * image.position);
    return std::array<double, 7>{q.w(), q.x(), q.y(), q.z(), t[0], t[1], t[2]};
  };
  const Eigen::Matrix3d mount = Eigen::Quaterniond(0.8, 0, 0.6, 0).toRotationMatrix();
  for (std::size_t i = 0; i < 7; i += 2) {
    Frame frame{static_cast<std::uint32_t>(500 + i), 11, pose(model.images[i]), {{{0, model.cameras[0].id}, model.images[i].id}}};
    if (i + 1 < 7) {  // x_sensor = mount * x_rig + t
      Image& second = model.images[i + 1];
      second.rotation = model.images[i].rotation * mount.transpose();
      second.position = model.images[i].position - second.rotation * Vector3d(0.1, 0.2, 0.3);
      second.observations.clear();
      frame.data.push_back({{0, model.cameras[1].id}, second.id});
      frame.data.push_back({{1, 77}, 123456789012ULL});
    }
    model.frames.push_back(frame);
  }
  for (Point& point : model.points) {
    const auto isGone = [](const TrackElement& e) { return e.image % 2 == 1; };
    point.track.erase(std::remove_if(point.track.begin(), point.track.end(), isGone), point.track.end());
  }
  return model;
}

void expectSameRigs(const SparseModel& a, const SparseModel& b) {
  ASSERT_EQ(a.rigs.size(), b.rigs.size());
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.rigs.size(); ++i) {
    EXPECT_EQ(a.rigs[i].id, b.rigs[i].id);
    ASSERT_EQ(a.rigs[i].sensors.size(), b.rigs[i].sensors.size());
    for (std::size_t k = 0; k < a.rigs[i].sensors.size(); ++k) {
      EXPECT_EQ(a.rigs[i].sensors[k].sensor.type, b.rigs[i].sensors[k].sensor.type);
      EXPECT_EQ(a.rigs[i].sensors[k].sensor.id, b.rigs[i].sensors[k].sensor.id);
      EXPECT_EQ(a.rigs[i].sensors[k].sensorFromRig, b.rigs[i].sensors[k].sensorFromRig);
    }
  }
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].id, b.frames[i].id);
    EXPECT_EQ(a.frames[i].rigId, b.frames[i].rigId);
    EXPECT_EQ(a.frames[i].rigFromWorld, b.frames[i].rigFromWorld);
    ASSERT_EQ(a.frames[i].data.size(), b.frames[i].data.size());
    for (std::size_t k = 0; k < a.frames[i].data.size(); ++k) EXPECT_EQ(a.frames[i].data[k].id, b.frames[i].data[k].id);
  }
}

TEST(RigFiles, RigsAndFramesAreKept) {
  const SparseModel model = riggedScene();
  const TemporaryFolder text, binary;
  writeColmapText(text.path(), model);
  expectSameRigs(expectMends(text.path(), {}), model);
  writeColmapBinary(binary.path(), model);
  expectSameRigs(expectMends(binary.path(), {}), model);
}

// Byte by byte as COLMAP 3.12 writes them.
TEST(RigFiles, BinaryLayout) {
  const SparseModel model = riggedScene();
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), model);
  EXPECT_EQ(folder.read("rigs.bin").size(), 8u + 4 + 4 + 8 + (8 + 1 + 56) + (8 + 1));
  EXPECT_EQ(folder.read("frames.bin").size(), 8u + 4 * (4 + 4 + 56 + 4) + (3 * 3 + 1) * 16);
}

TEST(RigFiles, FramesLoseRemovedImages) {
  SparseModel model = riggedScene();
  const TextMap map(model);
  map.change("images.txt", [](const std::string& text) { return withoutImages(text, {1, 6}); });
  const SparseModel pruned = expectMends(map.folder.path(), {{Mend::TrackOfMissingImage, 40}, {Mend::FrameOfMissingImage, 2}});
  ASSERT_EQ(pruned.frames.size(), 3u);
  EXPECT_EQ(pruned.frames[0].data.size(), 2u);
  const TemporaryFolder copy;
  writeColmapBinary(copy.path(), pruned);
  expectSameRigs(expectMends(copy.path(), {}), pruned);
}

TEST(RigFiles, UnregisteredImagesAreNotWrittenInFrames) {
  SparseModel model = riggedScene();
  model.images[1].registered = false;
  const TemporaryFolder copy;
  writeColmapText(copy.path(), model);
  const SparseModel read = expectMends(copy.path(), {});
  EXPECT_EQ(read.images.size(), 6u);
  EXPECT_EQ(read.frames[0].data.size(), 2u);
}

TEST(RigFiles, ContradictionsAreTold) {
  SparseModel model = riggedScene();
  model.frames[2].rigFromWorld[4] += 0.01;
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  expectMends(folder.path(), {{Mend::FrameContradictsImage, 2}});
}

TEST(RigFiles, ImagesWithoutAFrameAreGivenOne) {
  SparseModel model = riggedScene();
  model.frames.pop_back();  // of the last image, camera 0
  const TemporaryFolder folder;
  writeColmapText(folder.path(), model);
  const SparseModel read = expectMends(folder.path(), {});
  ASSERT_EQ(read.frames.size(), 4u);
  EXPECT_EQ(read.rigs.size(), 1u);
  EXPECT_EQ(read.frames[3].rigId, 11u);
  EXPECT_EQ(read.frames[3].data.at(0).id, model.images[6].id);
}

TEST(RigFiles, FilesOfAnotherModelDoNotStayBehind) {
  const TemporaryFolder folder;
  writeColmapText(folder.path(), riggedScene());
  EXPECT_TRUE(std::filesystem::exists(folder.file("frames.txt")));
  writeColmapText(folder.path(), scene());
  EXPECT_FALSE(std::filesystem::exists(folder.file("frames.txt")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("rigs.txt")));
}

TEST(RigFiles, DamagedFilesLeaveTheMapReadable) {
  const SparseModel model = riggedScene();
  const TemporaryFolder folder;
  writeColmapBinary(folder.path(), model);
  const std::string frames = folder.read("frames.bin");
  for (std::size_t length = 0; length < frames.size(); length += 7) {
    folder.write("frames.bin", frames.substr(0, length));
    const SparseModel read = expectMends(folder.path(), {{Mend::RigOrFrameInvalid, 1}});
    EXPECT_TRUE(read.frames.empty());
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

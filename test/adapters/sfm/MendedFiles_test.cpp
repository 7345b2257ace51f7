// COLMAP's text and binary files as other programs and scripts leave them: read, mended and told; in strict mode refused.
#include "DamagedMaps.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"

namespace hybridgv {
namespace sfm {
namespace {

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

// As scripts leave them that write no names. What was read can be written again, in either form.
TEST(MendedFiles, ImagesMayHaveNoName) {
  const SparseModel original = scene();
  const Image& image = original.images[1];
  const TemporaryFolder folder, written;
  for (const std::string& name : {std::string(), std::string("two\nlines"), std::string("\n")}) {
    writeColmapBinary(folder.path(), original);
    std::string contents = folder.read("images.bin");
    const std::size_t at = contents.find(image.name + '\0');
    ASSERT_NE(at, std::string::npos);
    folder.write("images.bin", contents.replace(at, image.name.size(), name));
    const SparseModel model = expectMends(folder.path(), {{Mend::UnusableName, 1}});
    ASSERT_EQ(model.images.size(), original.images.size());
    EXPECT_EQ(model.images[1].name, "image_" + std::to_string(image.id));
    EXPECT_EQ(model.images[0].name, original.images[0].name);
    writeColmapText(written.path(), model);
    EXPECT_EQ(readModel(written.path()).images[1].name, model.images[1].name);
  }
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

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

// Maps on disk that a test can damage: text files whose lines and words are changed, and what the reader must then report.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ModelChecks.hpp"
#include "SfmScene.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {

using test::TemporaryFolder;

const ReadOptions kStrict{true, true};

inline SparseModel scene(std::size_t images = 5, std::size_t points = 40) {
  test::Random random(test::testSeed(), 40);
  SparseModel model = test::makeScene(random, images, points, 1, {CameraModel::SimplePinhole, CameraModel::OpenCV});
  for (std::size_t i = 0; i < images; ++i) model.images[i].id = static_cast<std::uint32_t>(i + 1);
  return model;
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; begin = end + 1, end = text.find('\n', begin))
    lines.push_back(text.substr(begin, end - begin));
  if (begin < text.size()) lines.push_back(text.substr(begin));
  return lines;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

inline std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t i = text.find(from); i != std::string::npos; i = text.find(from, i + to.size()))
    text.replace(i, from.size(), to);
  return text;
}

inline std::vector<std::string> wordsOf(const std::string& line) {
  std::vector<std::string> words;
  std::size_t begin = line.find_first_not_of(' ');
  while (begin != std::string::npos) {
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(' ', end);
  }
  return words;
}

inline std::string lineOf(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

inline std::string numberText(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// The folder's model must be readable, valid, refused in strict mode, and report exactly these mends (others none).
inline SparseModel expectMends(const std::string& path, const std::map<Mend, std::size_t>& mends) {
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

inline std::size_t countTrackElements(const SparseModel& model) {
  std::size_t count = 0;
  for (const Point& point : model.points) count += point.track.size();
  return count;
}

inline void expectSameTracks(const SparseModel& a, const SparseModel& b) {
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
inline std::string withoutImages(const std::string& text, const std::vector<std::size_t>& removed) {
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

}  // namespace sfm
}  // namespace hybridgv

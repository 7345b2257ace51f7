#include "TextScanner.hpp"

#include <algorithm>
#include <cmath>

#include "FileContents.hpp"
#include "Printable.hpp"
#include "doubleFromChars.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool isSpace(char c) { return isBlank(c) || c == '\n'; }

}  // namespace

TextScanner::TextScanner(std::string file, Layout layout) : file_(std::move(file)), contents_(readFile(file_)), layout_(layout) {}

void TextScanner::fail(const std::string& reason) const { throw FileError::atLine(file_, line_, reason); }

void TextScanner::failWord(const char* what, std::string_view found, const char* expected) const {
  fail(std::string(what) + ": '" + printable(found) + "' is " + expected);
}

std::string_view TextScanner::tryWord() {
  while (position_ < contents_.size() && isBlank(contents_[position_])) ++position_;
  const std::size_t begin = position_;
  while (position_ < contents_.size() && !isSpace(contents_[position_])) ++position_;
  return std::string_view(contents_).substr(begin, position_ - begin);
}

std::string_view TextScanner::word(const char* what) {
  if (layout_ == Layout::Free && atEnd()) fail(std::string("the file ends where ") + what + " is expected");
  const std::string_view result = tryWord();
  if (result.empty()) fail(std::string("the line ends where ") + what + " is expected");
  return result;
}

double TextScanner::number(const char* what) {
  const std::string_view text = word(what);
  const char* begin = text.data();
  const char* end = text.data() + text.size();
  if (*begin == '+') ++begin;
  double value = 0;
  const auto result = doubleFromChars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range) failWord(what, text, "out of range");
  if (result.ec != std::errc() || result.ptr != end) failWord(what, text, "not a number");
  if (!std::isfinite(value)) failWord(what, text, "not finite");
  return value;
}

std::size_t TextScanner::count(const char* what, std::size_t minBytes) {
  const auto value = integer<std::size_t>(what);
  const std::size_t room = (contents_.size() - position_) / minBytes + 1;  // the last record may lack its line end
  if (value > room) fail(std::string(what) + ": " + std::to_string(value) + " do not fit into the rest of the file");
  return value;
}

bool TextScanner::atEnd() {
  while (position_ < contents_.size() && isSpace(contents_[position_]))
    if (contents_[position_++] == '\n') ++line_;
  return position_ == contents_.size();
}

void TextScanner::skipComments() {
  while (!atEnd() && contents_[position_] == '#') restOfLine();
}

std::string_view TextScanner::restOfLine() {
  while (position_ < contents_.size() && isBlank(contents_[position_])) ++position_;
  std::size_t end = contents_.find('\n', position_);
  const bool last = end == std::string::npos;
  if (last) end = contents_.size();
  const std::size_t begin = position_;
  position_ = last ? end : end + 1;
  if (!last) ++line_;
  while (end > begin && isBlank(contents_[end - 1])) --end;
  return std::string_view(contents_).substr(begin, end - begin);
}

bool TextScanner::toNextRecord() {
  skipComments();
  return position_ != contents_.size();
}

bool TextScanner::lineEnds() {
  while (position_ < contents_.size() && isBlank(contents_[position_])) ++position_;
  return position_ == contents_.size() || contents_[position_] == '\n';
}

void TextScanner::endLine() {
  if (!lineEnds()) fail("'" + printable(tryWord()) + "' where the line should end");
  restOfLine();
}

void TextScanner::endLineOrComment() {
  if (!lineEnds() && contents_[position_] == '#') position_ = std::min(contents_.find('\n', position_), contents_.size());
  endLine();
}

}  // namespace sfm
}  // namespace hybridgv

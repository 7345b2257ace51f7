#include "TextScanner.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "FileContents.hpp"
#include "Printable.hpp"
#include "doubleFromChars.hpp"
#include "hybridgv/adapters/sfm/FileError.hpp"

namespace hybridgv {
namespace sfm {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool isSpace(char c) { return isBlank(c) || c == '\n'; }

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Digits that are too many ("1e999"), not a word for infinity.
bool isDigitOrSign(std::string_view text) { return text.find_first_not_of("0123456789+-.eE") == std::string_view::npos; }

void appendUtf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code < 0x80) {
    put(code);
    return;
  }
  const int extra = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr std::uint32_t kLead[] = {0, 0xc0, 0xe0, 0xf0};
  put(kLead[extra] | (code >> (6 * extra)));
  for (int i = extra - 1; i >= 0; --i) put(0x80 | ((code >> (6 * i)) & 0x3f));
}

std::string fromUtf16(std::string_view bytes, bool isLittleEndian) {
  const auto unit = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(bytes[i]), second = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(isLittleEndian ? first | second << 8 : second | first << 8);
  };
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    const bool isPair = code >= 0xd800 && code < 0xdc00 && i + 3 < bytes.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000;
    if (isPair) {
      code = 0x10000 + ((code - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
      i += 2;
    }
    appendUtf8(text, code);
  }
  return text;
}

}  // namespace

TextScanner::TextScanner(std::string file, Layout layout, Mending& mending)
    : file_(std::move(file)), contents_(readFile(file_)), layout_(layout), mending_(mending) {
  decode();
}

// Skips UTF-8's byte order mark, and converts UTF-16.
void TextScanner::decode() {
  const auto startsWith = [&](std::string_view mark) { return std::string_view(contents_).substr(0, mark.size()) == mark; };
  const bool isUtf8 = startsWith("\xef\xbb\xbf"), isLittle = startsWith("\xff\xfe"), isBig = startsWith("\xfe\xff");
  if (!isUtf8 && !isLittle && !isBig) return;
  mending_.note(Mend::ByteOrderMark, [&] { return error("the file starts with a byte order mark"); });
  if (isUtf8)
    position_ = 3;
  else
    contents_ = fromUtf16(std::string_view(contents_).substr(2), isLittle);
}

void TextScanner::fail(const std::string& reason) const { throw error(reason); }

std::string TextScanner::complaint(const char* what, std::string_view found, const char* expected) const {
  return std::string(what) + ": '" + printable(found) + "' is " + expected;
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

double TextScanner::toNumber(const char* what, std::string_view text) const {
  const char* begin = text.data();
  const char* end = text.data() + text.size();
  if (*begin == '+') ++begin;
  double value = 0;
  const auto result = doubleFromChars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end)
    return text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos ? 0 : kInfinity;
  if (result.ec == std::errc() && result.ptr == end) return value;
  // Older Windows compilers print 1.#INF, -1.#IND, 1.#QNAN.
  if (text.find(".#INF") != std::string_view::npos) return kInfinity;
  if (text.find(".#IND") != std::string_view::npos || text.find("NAN") != std::string_view::npos)
    return std::numeric_limits<double>::quiet_NaN();
  fail(complaint(what, text, "not a number"));
}

double TextScanner::anyNumber(const char* what) { return toNumber(what, word(what)); }

double TextScanner::number(const char* what) {
  const std::string_view text = word(what);
  const double value = toNumber(what, text);
  if (!std::isfinite(value)) fail(complaint(what, text, isDigitOrSign(text) ? "out of range" : "not finite"));
  return value;
}

std::uint8_t TextScanner::colour(const char* what) {
  const std::string_view text = word(what);
  std::uint8_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc() && result.ptr == text.data() + text.size()) return value;
  const double number = toNumber(what, text);
  const bool isWhole = number >= 0 && number <= 255 && number == std::floor(number);
  mending_.note(isWhole ? Mend::FractionForInteger : Mend::ColourOutOfRange,
                [&] { return error(complaint(what, text, "not a whole number in the valid range")); });
  return static_cast<std::uint8_t>(number > 0 ? std::min(std::floor(number), 255.0) : 0.0);
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

std::string_view TextScanner::peekLine() {
  if (layout_ == Layout::Free) atEnd();
  const std::size_t position = position_, line = line_;
  const std::string_view result = restOfLine();
  position_ = position;
  line_ = line;
  return result;
}

bool TextScanner::isInCutLine() const {
  return !contents_.empty() && contents_.back() != '\n' && contents_.find('\n', position_) == std::string::npos;
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

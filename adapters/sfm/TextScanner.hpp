// Takes a text file apart into words and numbers, and knows the line when something is wrong.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "Mending.hpp"
#include "doubleFromChars.hpp"

namespace hybridgv {
namespace sfm {

class TextScanner {
 public:
  // Lines: a word must stand on the current line. Free: line ends are blanks like others.
  enum class Layout { Lines, Free };

  // A byte order mark at the start is mended.
  TextScanner(std::string file, Layout layout, Mending& mending);

  // Every `what` names the thing expected, for the error message.
  std::string_view word(const char* what);
  double number(const char* what);     // finite
  double anyNumber(const char* what);  // NaN and infinite in any system's spelling too
  template <class Integer>
  Integer integer(const char* what) {
    return toInteger<Integer>(what, word(what));
  }
  template <class Integer>
  Integer toInteger(const char* what, std::string_view text) const;
  // A channel in 0 .. 255; mended if it is not.
  std::uint8_t colour(const char* what);
  // A number of records that follow and take at least `minBytes` each; checked against what is left of the file.
  std::size_t count(const char* what, std::size_t minBytes);

  // Layout::Free. True if nothing but blanks is left.
  bool atEnd();
  // Skips blanks and comments that start with '#'.
  void skipComments();
  // What is left of the current line, without blanks around it; goes to the next line.
  std::string_view restOfLine();
  // The same, but stays.
  std::string_view peekLine();
  // Goes forward to the end of `text`, which lies in the current line.
  void skipTo(std::string_view text) { position_ = static_cast<std::size_t>(text.data() - contents_.data()) + text.size(); }

  // Layout::Lines. Goes to the next line that is neither blank nor a comment; false at the end of the file.
  bool toNextRecord();
  // True if the current line has no further word.
  bool lineEnds();
  // Goes to the next line; fails if the current one has a further word.
  void endLine();
  // The same, but a comment that starts with '#' may follow.
  void endLineOrComment();
  // True if there is no further line, not even an empty one.
  bool atEndOfFile() const { return position_ == contents_.size(); }
  // True in a last line without a line end: the file may have been cut there.
  bool isInCutLine() const;
  void skipToEndOfFile() { position_ = contents_.size(); }

  bool isEmpty() const { return contents_.empty(); }
  std::size_t line() const { return line_; }
  const std::string& file() const { return file_; }
  Mending& mending() const { return mending_; }
  FileError error(const std::string& reason) const { return FileError::atLine(file_, line_, reason); }
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  void decode();
  std::string_view tryWord();  // empty at the end of the line or file
  std::string complaint(const char* what, std::string_view found, const char* expected) const;
  double toNumber(const char* what, std::string_view text) const;

  std::string file_, contents_;
  Layout layout_;
  Mending& mending_;
  std::size_t position_ = 0, line_ = 1;
};

template <class Integer>
Integer TextScanner::toInteger(const char* what, std::string_view text) const {
  static_assert(std::is_integral_v<Integer>);
  Integer value{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc() && result.ptr == end) return value;
  constexpr double kLargest = 9007199254740992.0;  // 2^53, up to which every integer is a double
  double fraction = 0;
  const auto other = doubleFromChars(text.data(), end, fraction);
  const double low = std::is_signed_v<Integer> ? -kLargest : 0;
  const double high = std::min(kLargest, static_cast<double>(std::numeric_limits<Integer>::max()));
  const bool isWhole = other.ec == std::errc() && other.ptr == end && fraction == std::floor(fraction);
  if (!isWhole || !(fraction >= low && fraction <= high) || result.ec == std::errc::result_out_of_range)
    fail(complaint(what, text,
                   result.ec == std::errc::result_out_of_range ? "out of range" : "not a whole number in the valid range"));
  mending_.note(Mend::FractionForInteger, [&] { return error(complaint(what, text, "not a whole number in the valid range")); });
  return static_cast<Integer>(fraction);
}

}  // namespace sfm
}  // namespace hybridgv

// Takes a text file apart into words and numbers, and knows the line when something is wrong.
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace hybridgv {
namespace sfm {

class TextScanner {
 public:
  // Lines: a word must stand on the current line. Free: line ends are blanks like others.
  enum class Layout { Lines, Free };

  TextScanner(std::string file, Layout layout);

  // Every `what` names the thing expected, for the error message.
  std::string_view word(const char* what);
  double number(const char* what);  // finite
  template <class Integer>
  Integer integer(const char* what) {
    return toInteger<Integer>(what, word(what));
  }
  template <class Integer>
  Integer toInteger(const char* what, std::string_view text) const;
  // A number of records that follow and take at least `minBytes` each; checked against what is left of the file.
  std::size_t count(const char* what, std::size_t minBytes);

  // Layout::Free. True if nothing but blanks is left.
  bool atEnd();
  // Skips blanks and comments that start with '#'.
  void skipComments();
  // What is left of the current line, without blanks around it; goes to the next line.
  std::string_view restOfLine();

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

  std::size_t line() const { return line_; }
  const std::string& file() const { return file_; }
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  std::string_view tryWord();  // empty at the end of the line or file
  [[noreturn]] void failWord(const char* what, std::string_view found, const char* expected) const;

  std::string file_, contents_;
  Layout layout_;
  std::size_t position_ = 0, line_ = 1;
};

template <class Integer>
Integer TextScanner::toInteger(const char* what, std::string_view text) const {
  static_assert(std::is_integral_v<Integer>);
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    failWord(what, text, error == std::errc::result_out_of_range ? "out of range" : "not a whole number in the valid range");
  return value;
}

}  // namespace sfm
}  // namespace hybridgv

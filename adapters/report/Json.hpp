// The little of JSON that the page needs, as text that may stand inside an HTML script element.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hybridgv {
namespace report {

// "..." in ASCII: everything that means something to HTML, controls and all that is not ASCII is written \uXXXX. Bytes that are not
// UTF-8 become U+FFFD.
std::string jsonString(std::string_view text);

// As few digits as tell it from all other numbers; null if it is not finite.
std::string jsonNumber(double value);

std::string base64(std::string_view bytes);

// The array's bytes (little endian on all machines that the library runs on), quoted.
template <class T>
std::string jsonArray(const std::vector<T>& values) {
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  return '"' + base64({bytes, values.size() * sizeof(T)}) + '"';
}

// {"a":1,"b":2} or [1,2], member by member.
class JsonList {
 public:
  explicit JsonList(bool isObject) : text_(isObject ? "{" : "["), end_(isObject ? '}' : ']') {}
  void add(std::string_view json) {
    if (text_.size() > 1) text_ += ',';
    text_ += json;
  }
  void add(std::string_view key, std::string_view json) {
    add(jsonString(key) + ':');
    text_ += json;
  }
  std::string text() const { return text_ + end_; }

 private:
  std::string text_;
  char end_;
};

}  // namespace report
}  // namespace hybridgv

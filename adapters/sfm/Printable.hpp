// Quoting file contents in messages.
#pragma once

#include <string>
#include <string_view>

namespace hybridgv {
namespace sfm {

// The text, shortened to 40 characters, with '?' for everything that is not printable ASCII.
inline std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result(text.substr(0, kLongest));
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return text.size() > kLongest ? result + "..." : result;
}

}  // namespace sfm
}  // namespace hybridgv

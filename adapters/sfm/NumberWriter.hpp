// Numbers as text that reads back as the same numbers.
#pragma once

#include <charconv>
#include <string>

namespace hybridgv {
namespace sfm {

// Appends a blank and the shortest decimal form that stands for exactly this value.
template <class Number>
void appendNumber(std::string& text, Number value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  if (!text.empty() && text.back() != '\n') text += ' ';
  text.append(digits, result.ptr);
}

template <class Numbers>
void appendNumbers(std::string& text, const Numbers& values) {
  for (const auto value : values) appendNumber(text, value);
}

}  // namespace sfm
}  // namespace hybridgv

#include "Json.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace hybridgv {
namespace report {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

int continuationBytes(unsigned char first) {
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  if (first >= 0xF0 && first < 0xF5) return 3;
  return -1;
}

// The character that starts at `position`, which moves behind it; behind one byte if that does not start a character.
char32_t nextCharacter(std::string_view text, std::size_t& position) {
  constexpr char32_t kSmallest[] = {0, 0x80, 0x800, 0x10000};
  const auto first = static_cast<unsigned char>(text[position++]);
  if (first < 0x80) return first;
  const int more = continuationBytes(first);
  if (more < 0 || position + static_cast<std::size_t>(more) > text.size()) return kReplacement;
  char32_t character = first & (0x3Fu >> more);
  for (int i = 0; i < more; ++i) {
    const auto byte = static_cast<unsigned char>(text[position + static_cast<std::size_t>(i)]);
    if ((byte & 0xC0u) != 0x80) return kReplacement;
    character = (character << 6u) | (byte & 0x3Fu);
  }
  const bool isSurrogate = character >= 0xD800 && character < 0xE000;
  if (character < kSmallest[more] || isSurrogate || character > 0x10FFFF) return kReplacement;
  position += static_cast<std::size_t>(more);
  return character;
}

void appendEscaped(std::string& text, unsigned unit) {
  char escaped[8];
  std::snprintf(escaped, sizeof escaped, "\\u%04X", unit & 0xFFFFu);
  text += escaped;
}

bool isPlain(char32_t c) {
  return c >= ' ' && c < 0x7F && c != '"' && c != '\\' && c != '<' && c != '>' && c != '&' && c != '\'';
}

}  // namespace

std::string jsonString(std::string_view text) {
  std::string result = "\"";
  for (std::size_t position = 0; position < text.size();) {
    const char32_t c = nextCharacter(text, position);
    if (isPlain(c)) {
      result += static_cast<char>(c);
    } else if (c < 0x10000) {
      appendEscaped(result, c);
    } else {
      appendEscaped(result, 0xD800 + ((c - 0x10000) >> 10u));
      appendEscaped(result, 0xDC00 + ((c - 0x10000) & 0x3FFu));
    }
  }
  return result + '"';
}

std::string jsonNumber(double value) {
  if (!std::isfinite(value)) return "null";
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, result.ptr};
}

std::string base64(std::string_view bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = (group << 8u) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      result += i + k <= bytes.size() ? kDigits[(group >> (18u - 6u * static_cast<unsigned>(k))) & 0x3Fu] : '=';
  }
  return result;
}

}  // namespace report
}  // namespace hybridgv

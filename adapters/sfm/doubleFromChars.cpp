#include "doubleFromChars.hpp"

#include <locale.h>
#include <stdlib.h>

#include <cerrno>
#include <cmath>
#include <string>
#if __has_include(<xlocale.h>)
#include <xlocale.h>
#endif

namespace hybridgv {
namespace sfm {
namespace {

double strtodInCLocale(const char* text, char** end) {
#if defined(_WIN32)
  static const _locale_t locale = _create_locale(LC_ALL, "C");
  return _strtod_l(text, end, locale);
#else
  static const locale_t locale = newlocale(LC_ALL_MASK, "C", static_cast<locale_t>(nullptr));
  return strtod_l(text, end, locale);
#endif
}

// strtod would skip blanks, and accept a plus sign.
bool beginsNumber(const std::string& number) {
  static const std::string kBeginnings = "0123456789.iInN";
  const std::size_t first = !number.empty() && number[0] == '-' ? 1 : 0;
  return first < number.size() && kBeginnings.find(number[first]) != std::string::npos;
}

// The decimal number that strtod takes for the beginning of a hexadecimal one is the 0 before its x; npos if there is none.
std::size_t endBeforeX(const std::string& number) {
  const std::size_t first = number[0] == '-' ? 1 : 0;
  const bool isHexadecimal =
      first + 1 < number.size() && number[first] == '0' && (number[first + 1] == 'x' || number[first + 1] == 'X');
  return isHexadecimal ? first + 1 : std::string::npos;
}

}  // namespace

std::from_chars_result doubleFromCharsByStrtod(const char* begin, const char* end, double& value) {
  std::string text(begin, end);
  if (!beginsNumber(text)) return {begin, std::errc::invalid_argument};
  if (const std::size_t length = endBeforeX(text); length != std::string::npos) text.resize(length);
  char* stop = nullptr;
  errno = 0;
  const double result = strtodInCLocale(text.c_str(), &stop);
  const char* after = begin + (stop - text.c_str());
  if (after == begin) return {begin, std::errc::invalid_argument};
  // ERANGE also tells of numbers that are not normalized, which are in range.
  if (errno == ERANGE && (result == 0 || std::isinf(result))) return {after, std::errc::result_out_of_range};
  value = result;
  return {after, std::errc()};
}

std::from_chars_result doubleFromChars(const char* begin, const char* end, double& value) {
#if defined(__cpp_lib_to_chars)
  return std::from_chars(begin, end, value);
#else
  return doubleFromCharsByStrtod(begin, end, value);
#endif
}

}  // namespace sfm
}  // namespace hybridgv

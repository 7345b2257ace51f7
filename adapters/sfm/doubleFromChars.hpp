// Numbers from text, whatever the program's locale.
#pragma once

#include <charconv>

namespace hybridgv {
namespace sfm {

// As std::from_chars, which libc++ before LLVM 20 does not have for double.
std::from_chars_result doubleFromChars(const char* begin, const char* end, double& value);

// The same by strtod in the C locale, for standard libraries that lack it.
std::from_chars_result doubleFromCharsByStrtod(const char* begin, const char* end, double& value);

}  // namespace sfm
}  // namespace hybridgv

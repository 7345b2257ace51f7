#include "hybridgv/detail/format.hpp"

#include <charconv>
#include <cmath>

namespace hybridgv {
namespace detail {

std::string format(double value) {
  if (std::isnan(value)) return "nan";  // its sign means nothing
  constexpr double kSmallestFixed = 1e-4, kLargestFixed = 1e15;
  const double size = std::abs(value);
  const bool isFixed = value == 0 || (size >= kSmallestFixed && size < kLargestFixed);
  char digits[32];
  const auto result =
      std::to_chars(digits, digits + sizeof digits, value, isFixed ? std::chars_format::fixed : std::chars_format::scientific);
  return {digits, result.ptr};
}

std::string format(const Eigen::Vector3d& value) {
  return "(" + format(value[0]) + ", " + format(value[1]) + ", " + format(value[2]) + ")";
}

std::string format(const Eigen::Matrix3d& value) {
  std::string text = "[";
  for (int row = 0; row < 3; ++row) {
    if (row > 0) text += "; ";
    text += format(value(row, 0)) + ", " + format(value(row, 1)) + ", " + format(value(row, 2));
  }
  return text + "]";
}

}  // namespace detail
}  // namespace hybridgv

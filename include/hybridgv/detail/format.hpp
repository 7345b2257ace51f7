/// \file
/// \brief Numbers in the library's messages.
#pragma once

#include <Eigen/Core>
#include <string>

#include "hybridgv/export.hpp"

namespace hybridgv {
namespace detail {

/// The shortest decimal number that reads back as this double: "0.1", "-1e-09", "1e+300", "inf", "nan". The program's locale has
/// no say in it.
HYBRIDGV_EXPORT std::string format(double value);
/// "(x, y, z)"
HYBRIDGV_EXPORT std::string format(const Eigen::Vector3d& value);
/// Row by row: "[a, b, c; d, e, f; g, h, i]"
HYBRIDGV_EXPORT std::string format(const Eigen::Matrix3d& value);
/// Without a decimal point.
inline std::string format(int value) { return std::to_string(value); }

}  // namespace detail
}  // namespace hybridgv

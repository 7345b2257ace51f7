// Camera models that COLMAP may have had added since: their records in cameras.bin do not say how long they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

namespace hybridgv {
namespace sfm {

// The number of parameters of every unknown model in the contents of cameras.bin: that with which the records fill the file
// exactly and every one has a plausible size. False if there is none.
bool findUnknownModelSizes(std::string_view contents, std::map<std::int32_t, std::size_t>& parameterCounts);

}  // namespace sfm
}  // namespace hybridgv

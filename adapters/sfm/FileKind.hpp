// What a file that is no map may be.
#pragma once

#include <string>
#include <string_view>

namespace hybridgv {
namespace sfm {

// "a picture (PNG)", "JSON", ..; by its first bytes. Empty if nothing is recognized.
std::string describeFile(std::string_view start);

// What can be read, for messages.
std::string readableFormats();

}  // namespace sfm
}  // namespace hybridgv

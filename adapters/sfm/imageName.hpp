// What an image may be called.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "Mending.hpp"

namespace hybridgv {
namespace sfm {

// Every format of a model can hold such a name.
inline bool isUsableName(std::string_view name) {
  return !name.empty() && name.find_first_of(std::string_view("\n\0", 2)) == std::string_view::npos;
}

// The name, or one from the image's id if it cannot be used.
template <class Scanner>
std::string usableName(const Scanner& in, Mending& mending, std::string name, std::uint32_t id) {
  if (isUsableName(name)) return name;
  const std::string replacement = "image_" + std::to_string(id);
  mending.note(Mend::UnusableName, [&] {
    return in.error((name.empty() ? "an image has no name" : "the name of an image has a line break or a zero byte") +
                    std::string(": image ") + std::to_string(id));
  });
  return replacement;
}

}  // namespace sfm
}  // namespace hybridgv

// What tables call a map.
#pragma once

#include <filesystem>
#include <string>

// "crane" for .../crane/, "kermit" for .../kermit/bundle.out: file names tend to be all the same.
inline std::string sceneName(const std::string& map) {
  const std::filesystem::path path = std::filesystem::absolute(map).lexically_normal() / "";
  const std::filesystem::path last = path.parent_path();
  return std::filesystem::is_directory(map) ? last.filename() : last.parent_path().filename();
}

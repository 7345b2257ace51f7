// Writes the default map as COLMAP text: generate_default_map FOLDER [SEED]
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>

#include "DefaultMap.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

int main(int argc, char** argv) {
  constexpr std::uint64_t kSeed = 2;  // of the committed map
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: generate_default_map FOLDER [SEED]\n";
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[1]);
    const std::uint64_t seed = argc == 3 ? std::strtoull(argv[2], nullptr, 10) : kSeed;
    hybridgv::sfm::writeColmapText(argv[1], makeDefaultMap(seed));
  } catch (const std::exception& error) {
    std::cerr << "generate_default_map: " << error.what() << '\n';
    return 1;
  }
}

// The main job: localizes query images of unknown focal length against a map, and shows what the 2D-2D matches add. It is the
// sub-command of the program hybridgv.
#include "Localize.hpp"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
  return program::runLocalize({argv + 1, argv + argc});
} catch (const std::exception& error) {
  std::fprintf(stderr, "localize: %s\n", error.what());
  return 1;
}

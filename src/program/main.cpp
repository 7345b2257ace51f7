// The program `hybridgv`.
#include <cstdio>
#include <exception>

#include "Commands.hpp"
#include "common/CommandLine.hpp"

int main(int argc, char** argv) {
  if (argc < 2) return program::printHelp();
  try {
    return program::run(argv[1], std::vector<std::string>(argv + 2, argv + argc));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hybridgv: %s\n", error.what());
    return program::kFailed;
  }
}

#include "Commands.hpp"

#include <hybridgv/instructionSet.hpp>
#include <hybridgv/types.hpp>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "Localize.hpp"
#include "common/CommandLine.hpp"
#if defined(HYBRIDGV_WITH_COLMAP)
#include "Registrator.hpp"
#endif

namespace program {
namespace {

constexpr const char* kHelp =
    "Localizes images of unknown focal length and distortion against a map, from 2D-2D and 2D-3D matches together.\n"
    "Usage: hybridgv COMMAND [OPTIONS]\n"
    "\n"
    "Commands:\n"
    "  image_registrator  registers images of a COLMAP database in a map; takes the options of COLMAP's command\n"
    "  localize           localizes images of a map, each left out of it, or problems in text files\n"
    "\n"
    "Options:\n"
    "  -h,--help     print this help message and exit; hybridgv COMMAND --help prints that of a command\n"
    "  --version     print the version and the instruction set of the kernels, and exit\n";

}  // namespace

int run(const std::string& command, std::vector<std::string> arguments) {
  if (command == "localize") return runLocalize(std::move(arguments));
#if defined(HYBRIDGV_WITH_COLMAP)
  if (command == "image_registrator") return runRegistrator(std::move(arguments));
#else
  if (command == "image_registrator") throw std::runtime_error("image_registrator: this program was built without SQLite");
#endif
  if (command == "--help" || command == "-h" || command == "help")
    std::fputs(kHelp, stdout);
  else if (command == "--version")
    std::printf("hybridgv %s\nkernels: %s\n", hybridgv::version(), hybridgv::instructionSet());
  else
    return std::fprintf(stderr, "hybridgv: there is no command %s; hybridgv --help lists them\n", quoted(command).c_str()),
           kWrongUsage;
  flushOutput();
  return 0;
}

int printHelp() {
  std::fputs(kHelp, stderr);
  return kWrongUsage;
}

}  // namespace program

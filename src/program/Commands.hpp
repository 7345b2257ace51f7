// The sub-commands of the program.
#pragma once

#include <string>
#include <vector>

namespace program {

// Runs a sub-command and returns the exit code. What goes wrong is thrown.
int run(const std::string& command, std::vector<std::string> arguments);

// For a call without a command: prints the help on standard error and returns the exit code.
int printHelp();

}  // namespace program

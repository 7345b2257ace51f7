// The sub-command image_registrator: COLMAP's command of this name, with the 2D-2D matches and with unknown distortion.
#pragma once

#include <string>
#include <vector>

namespace program {

// Returns the exit code. `arguments` are those behind the sub-command's name.
int runRegistrator(std::vector<std::string> arguments);

}  // namespace program

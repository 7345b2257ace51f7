// The sub-command localize: images of a map, each left out of it, or problems in text files; shows what the 2D-2D matches add.
//
//   localize                          the default map, each of its images in turn as the query
//   localize MAP [--query NAME ...]   a COLMAP folder (text or binary), a Bundler .out or an NVM file
//   localize PROBLEM.txt ...          problems in the text format of hybridgv/adapters/sfm/LocalizationProblem.hpp
#pragma once

#include <string>
#include <vector>

namespace program {

// Returns the exit code. `arguments` are those behind the sub-command's name.
int runLocalize(std::vector<std::string> arguments);

}  // namespace program

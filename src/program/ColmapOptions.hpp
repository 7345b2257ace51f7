// COLMAP's ways to give options that mean nothing here, and to keep them in project files.
#pragma once

#include <string>
#include <vector>

namespace program {

// Takes options of COLMAP that change nothing here, with their values, out of the arguments; returns their names.
std::vector<std::string> takeUnusedOptions(std::vector<std::string>& arguments);

// Replaces "--project_path FILE" by the options in that file, which come first so that those of the command line count. Lines are
// "key=value", and "[Mapper]" before those that are called Mapper.key here; '#' and ';' start comments. std::runtime_error if the
// file cannot be read.
void insertProjectFile(std::vector<std::string>& arguments);

}  // namespace program

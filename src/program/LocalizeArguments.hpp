// The command line of localize.
#pragma once

#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>
#include <hybridgv/sac/HybridRansacOptions.hpp>

#include <string>
#include <vector>

#include "PageFiles.hpp"

namespace program {

struct LocalizeArguments {
  std::vector<std::string> inputs;
  std::vector<std::string> queries;
  std::string solver = "all";
  std::string queryCamera = "radial";
  hybridgv::sfm::LocalizationProblemOptions matches;
  hybridgv::sfm::ReadOptions reading;
  hybridgv::sac::HybridRansacOptions ransac;
  std::string focalLength;  // "", "prior" or a number of pixels
  PageFiles page;
  double outlierShare = 0;
  bool json = false, readStandardInput = false, quiet = false;
};

// Fills `arguments`; returns the exit code if the program is to stop here (help, wrong usage), -1 otherwise.
int parseLocalize(std::vector<std::string> given, LocalizeArguments& arguments);

}  // namespace program

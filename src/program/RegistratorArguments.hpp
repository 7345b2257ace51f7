// The command line of image_registrator.
#pragma once

#include <hybridgv/adapters/colmap/DatabaseQueries.hpp>
#include <hybridgv/adapters/colmap/registerImages.hpp>

#include <string>
#include <vector>

#include "PageFiles.hpp"

namespace program {

struct RegistratorArguments {
  std::string database, input, output, imageList, results, json;
  PageFiles page;
  std::string outputType = "BIN";
  hybridgv::sfm::DatabaseQueryOptions queries;
  hybridgv::sfm::RegistrationOptions registration;
  bool requireAll = false, quiet = false;
};

// Returns the exit code if the program is to stop here, -1 otherwise. Says which options mean nothing here.
int parseRegistrator(std::vector<std::string> arguments, RegistratorArguments& parsed);

}  // namespace program

// The command line of image_registrator.
#pragma once

#include <hybridgv/adapters/colmap/DatabaseQueries.hpp>
#include <hybridgv/adapters/sfm/localizeQuery.hpp>

#include <string>
#include <vector>

namespace program {

struct RegistratorArguments {
  std::string database, input, output, imageList, results, json;
  std::string outputType = "BIN";
  hybridgv::sfm::DatabaseQueryOptions queries;
  hybridgv::sfm::QueryOptions localization;
  // Of the longer side of the image.
  double minFocalRatio = 0.1, maxFocalRatio = 10;
  double maxDistortion = 1;
  int threads = -1;  // -1: one for each core
  bool estimateFocalLength = true, estimateDistortion = true;
  bool requireAll = false, quiet = false;
};

// Returns the exit code if the program is to stop here, -1 otherwise. Says which options mean nothing here.
int parseRegistrator(std::vector<std::string> arguments, RegistratorArguments& parsed);

}  // namespace program

// A localized query image as one line of JSON, as src/doc/localization.schema.json says.
#pragma once

#include <hybridgv/adapters/sfm/localizeQuery.hpp>

#include <string>

namespace program {

// What was found, or why not.
std::string toJsonLine(const hybridgv::sfm::SparseModel& map, const hybridgv::sfm::QueryLocalization& localization);

// An image that could not be read.
std::string toJsonLine(const std::string& name, const std::string& reason);

}  // namespace program

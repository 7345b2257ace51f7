// What localize prints.
#pragma once

#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <optional>
#include <vector>

#include "common/PoseError.hpp"

namespace program {

struct Localization {
  hybridgv::sac::HybridRansacResult result;
  std::optional<PoseError> error;  // if the query has a reference and a pose was found
};

// A query, localized from all matches and from the 2D-3D ones alone.
struct Row {
  hybridgv::sfm::LocalizationProblem problem;
  Localization hybrid, pointsOnly;
};

// The table is 100 columns wide.
void printHeader();
void printRow(const Row& row);
void printJson(const Row& row);

// Collects what the closing line of the table says.
class Summary {
 public:
  void add(const Localization& localization);
  void print(const char* name) const;

 private:
  int queries_ = 0, successes_ = 0;
  std::vector<double> focal_, rotation_, position_, milliseconds_;
};

}  // namespace program

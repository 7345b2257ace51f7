// What localize has to localize.
#pragma once

#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>

#include <functional>
#include <memory>
#include <vector>

#include "LocalizeArguments.hpp"

namespace program {

// A query that is made when its turn comes.
struct Query {
  std::function<hybridgv::sfm::LocalizationProblem()> make;
  // Where it comes from; null: a file of its own.
  std::shared_ptr<const hybridgv::sfm::SparseModel> map = nullptr;
  std::size_t image = 0;
};

// std::invalid_argument for names that are nobody's.
std::vector<Query> collectQueries(const LocalizeArguments& arguments);

}  // namespace program

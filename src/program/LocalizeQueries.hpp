// What localize has to localize.
#pragma once

#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>

#include <functional>
#include <vector>

#include "LocalizeArguments.hpp"

namespace program {

// A query that is made when its turn comes.
using Query = std::function<hybridgv::sfm::LocalizationProblem()>;

// std::invalid_argument for names that are nobody's.
std::vector<Query> collectQueries(const LocalizeArguments& arguments);

}  // namespace program

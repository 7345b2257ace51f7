// What localizeQuery() has found, for Python.
#pragma once

#include <pybind11/pybind11.h>
#include <hybridgv/adapters/sfm/localizeQuery.hpp>

namespace hybridgv {
namespace python {

// All that hybridgv.QueryResult needs.
pybind11::dict dictOf(const sfm::SparseModel& map, const sfm::QueryImage& query, const sfm::QueryLocalization& localization);

}  // namespace python
}  // namespace hybridgv

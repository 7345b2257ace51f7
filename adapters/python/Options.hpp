// The options by the names that they have in Python.
#pragma once

#include <hybridgv/adapters/sfm/localizeQuery.hpp>

#include <string>

#include "Values.hpp"

namespace hybridgv {
namespace python {

// The defaults with what `options` says. ValueError names a key that does not exist, with a list of those that do, and a value of
// the wrong kind.
sfm::QueryOptions optionsOf(const py::dict& options);
// All of them.
py::dict dictOf(sfm::QueryOptions options);
// A message of the library with the names that the options have in Python.
std::string withPythonNames(std::string message);

}  // namespace python
}  // namespace hybridgv

// What the module consists of.
#pragma once

#include <pybind11/pybind11.h>

namespace hybridgv {
namespace python {

void addLocalize(pybind11::module_& module);
void addSolvers(pybind11::module_& module);

}  // namespace python
}  // namespace hybridgv

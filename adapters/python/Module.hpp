// What the module consists of.
#pragma once

#include <pybind11/pybind11.h>

namespace hybridgv {
namespace python {

void addLocalize(pybind11::module_& module);
void addSolvers(pybind11::module_& module);
void addMaps(pybind11::module_& module);
void addRegistration(pybind11::module_& module);  // only with SQLite
void addProgram(pybind11::module_& module);       // only with the program

}  // namespace python
}  // namespace hybridgv

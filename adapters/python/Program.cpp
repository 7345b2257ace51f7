// The sub-commands of the program hybridgv, for python3 -m hybridgv.
#include <pybind11/stl.h>

#include "Commands.hpp"
#include "Module.hpp"

namespace hybridgv {
namespace python {

void addProgram(pybind11::module_& module) {
  module.def("run_program", &program::run, pybind11::arg("command"), pybind11::arg("arguments"),
             pybind11::call_guard<pybind11::gil_scoped_release>());
}

}  // namespace python
}  // namespace hybridgv

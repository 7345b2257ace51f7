// hybridgv._core: what the Python package is built on.
#include <pybind11/pybind11.h>
#include <hybridgv/adapters/sfm/FileError.hpp>
#include <hybridgv/instructionSet.hpp>
#include <hybridgv/types.hpp>

#include <stdexcept>
#include <utility>

#include "Module.hpp"
#include "Options.hpp"

namespace {

namespace py = pybind11;
using hybridgv::sfm::FileError;

py::object orNone(std::size_t place) { return place == FileError::kNowhere ? py::object(py::none()) : py::int_(place); }

// The library's exceptions as Python's.
void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(std::move(pointer));
  } catch (const FileError& error) {
    const py::object kind = py::module_::import("hybridgv._errors").attr("FileError");
    const py::object value = kind(error.what(), error.file(), orNone(error.line()), orNone(error.byteOffset()));
    PyErr_SetObject(kind.ptr(), value.ptr());
  } catch (const std::invalid_argument& error) {
    PyErr_SetString(PyExc_ValueError, hybridgv::python::withPythonNames(error.what()).c_str());
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The library's functions on arrays; the package hybridgv is what programs use.";
  py::register_exception_translator(&translate);
  hybridgv::python::addLocalize(module);
  hybridgv::python::addSolvers(module);
  hybridgv::python::addMaps(module);
#if defined(HYBRIDGV_WITH_COLMAP)
  hybridgv::python::addRegistration(module);
#endif
#if defined(HYBRIDGV_WITH_PROGRAM)
  hybridgv::python::addProgram(module);
#endif
  module.def("version", &hybridgv::version);
  module.def("instruction_set", &hybridgv::instructionSet, "The instruction set of the kernels: baseline, avx2 or avx512.");
}

// Python's values in C++ and back: arrays, cameras, poses, results.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <hybridgv/adapters/sfm/QueryImage.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace hybridgv {
namespace python {

namespace py = pybind11;

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using IndexArray = py::array_t<long long, py::array::c_style | py::array::forcecast>;
using Vectors = std::vector<Eigen::Vector3d>;

// Numbers of `columns` columns, of any kind that numpy converts; an empty list is an array without rows. ValueError names the argument
// and both shapes.
DoubleArray rowsOf(const char* name, const py::object& values, py::ssize_t columns);
// The same of one dimension.
DoubleArray numbersOf(const char* name, const py::object& values);
// Integers of as many columns; of one dimension if columns is 0.
IndexArray indicesOf(const char* name, const py::object& values, py::ssize_t columns);
// ValueError unless there are `expected` of them, which is as many as there are of `other`.
void checkCount(const char* name, py::ssize_t count, const char* other, py::ssize_t expected);

// Three columns.
Vectors vectorsOf(const DoubleArray& rows);
std::vector<double> listOf(const DoubleArray& numbers);
Eigen::Vector3d vectorOf(const char* name, const py::object& values);
Eigen::Matrix3d matrixOf(const char* name, const py::object& values);

py::array_t<double> arrayOf(const Eigen::Vector3d& vector);
py::array_t<double> arrayOf(const Eigen::Matrix3d& matrix);
py::array_t<double> arrayOf(const std::vector<double>& numbers);
// `mask[i]` belongs to element `kept[i]` of `count`; the others are false.
py::array_t<bool> maskOf(const std::vector<char>& mask, const std::vector<std::size_t>& kept, std::size_t count);

// (model, width, height, parameters), which is what the Python side makes of every kind of camera.
sfm::Camera cameraOf(const py::tuple& camera);
// {"model", "width", "height", "params"}
py::dict dictOf(const sfm::Camera& camera);
// "unknown", "prior", "known"
sfm::CameraKnowledge knowledgeOf(const std::string& name);

// (rotation, position, focal length)
py::tuple tupleOf(const FocalPose& pose);
// Everything but masks and camera.
py::dict dictOf(const sac::HybridRansacResult& result);

}  // namespace python
}  // namespace hybridgv

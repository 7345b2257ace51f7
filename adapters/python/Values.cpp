#include "Values.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hybridgv {
namespace python {
namespace {

std::string shapeOf(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

DoubleArray arrayOfNumbers(const char* name, const py::object& values) {
  if (values.is_none()) throw std::invalid_argument(std::string(name) + " is missing");
  DoubleArray array = DoubleArray::ensure(values);
  if (!array) throw std::invalid_argument(std::string(name) + " is not an array of numbers");
  return array;
}

sfm::CameraModel modelOf(const std::string& name) {
  std::string names;
  for (int i = 0; i <= static_cast<int>(sfm::CameraModel::Equirectangular); ++i) {
    const auto model = static_cast<sfm::CameraModel>(i);
    if (name == toString(model)) return model;
    names += (i > 0 ? ", " : "") + std::string(toString(model));
  }
  throw std::invalid_argument("camera: there is no model '" + name + "', valid are " + names);
}

void addLens(const sac::HybridRansacResult& result, py::dict& dict) {
  dict["division_focal_length"] = result.pose.focalLength;
  dict["distortion"] = result.distortion;
  dict["distortion_std"] = result.distortionStandardDeviation;
  dict["focal_length"] = result.simpleRadialFocalLength;
  dict["focal_length_std"] = result.focalLengthStandardDeviation;
  dict["k1"] = result.simpleRadialK1;
  dict["k1_std"] = result.simpleRadialK1StandardDeviation;
}

void addSearch(const sac::HybridRansacResult& result, py::dict& dict) {
  py::dict iterations;
  for (const auto& [solver, count] : result.iterationsPerSolver) iterations[toString(solver)] = count;
  dict["solver"] = result.solver ? py::object(py::str(toString(*result.solver))) : py::none();
  dict["iterations"] = result.iterations;
  dict["iterations_per_solver"] = iterations;
  dict["local_optimizations"] = result.localOptimizations;
  dict["stop_reason"] = toString(result.stopReason);
  dict["seconds"] = result.seconds;
}

}  // namespace

DoubleArray rowsOf(const char* name, const py::object& values, py::ssize_t columns) {
  DoubleArray array = arrayOfNumbers(name, values);
  if (array.ndim() == 1 && array.size() == 0) return DoubleArray(std::vector<py::ssize_t>{0, columns});
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw std::invalid_argument(std::string(name) + " must have the shape (N, " + std::to_string(columns) + "), has " +
                                shapeOf(array));
  const double* data = array.data();
  for (py::ssize_t i = 0; i < array.size(); ++i)
    if (!std::isfinite(data[i]))
      throw std::invalid_argument(std::string(name) + "[" + std::to_string(i / columns) + "] is not finite");
  return array;
}

DoubleArray numbersOf(const char* name, const py::object& values) {
  DoubleArray array = arrayOfNumbers(name, values);
  if (array.ndim() != 1) throw std::invalid_argument(std::string(name) + " must have the shape (N,), has " + shapeOf(array));
  return array;
}

IndexArray indicesOf(const char* name, const py::object& values, py::ssize_t columns) {
  const py::array array = py::array::ensure(values);
  const bool isEmpty = array && array.size() == 0;
  if (!array || (!isEmpty && array.dtype().kind() != 'i' && array.dtype().kind() != 'u'))
    throw std::invalid_argument(std::string(name) + " is not an array of integers");
  if (isEmpty && columns > 0) return IndexArray(std::vector<py::ssize_t>{0, columns});
  if (array.ndim() != (columns == 0 ? 1 : 2) || (columns > 0 && array.shape(1) != columns))
    throw std::invalid_argument(std::string(name) + " must have the shape (N," +
                                (columns > 0 ? " " + std::to_string(columns) : "") + "), has " + shapeOf(array));
  return IndexArray::ensure(array);
}

void checkCount(const char* name, py::ssize_t count, const char* other, py::ssize_t expected) {
  if (count != expected)
    throw std::invalid_argument(std::string(name) + " has the length " + std::to_string(count) + ", " + other + " has " +
                                std::to_string(expected));
}

Vectors vectorsOf(const DoubleArray& rows) {
  Vectors vectors(static_cast<std::size_t>(rows.shape(0)));
  const double* values = rows.data();
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = Eigen::Map<const Eigen::Vector3d>(values + 3 * i);
  return vectors;
}

std::vector<double> listOf(const DoubleArray& numbers) { return {numbers.data(), numbers.data() + numbers.size()}; }

Eigen::Vector3d vectorOf(const char* name, const py::object& values) {
  const DoubleArray array = numbersOf(name, values);
  if (array.size() != 3) throw std::invalid_argument(std::string(name) + " must have the shape (3,), has " + shapeOf(array));
  return Eigen::Map<const Eigen::Vector3d>(array.data());
}

Eigen::Matrix3d matrixOf(const char* name, const py::object& values) {
  const DoubleArray array = rowsOf(name, values, 3);
  if (array.shape(0) != 3) throw std::invalid_argument(std::string(name) + " must have the shape (3, 3), has " + shapeOf(array));
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(array.data());
}

py::array_t<double> arrayOf(const Eigen::Vector3d& vector) { return py::array_t<double>(3, vector.data()); }

py::array_t<double> arrayOf(const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = matrix;
  return py::array_t<double>(std::vector<py::ssize_t>{3, 3}, rows.data());
}

py::array_t<double> arrayOf(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::array_t<bool> maskOf(const std::vector<char>& mask, const std::vector<std::size_t>& kept, std::size_t count) {
  py::array_t<bool> result(static_cast<py::ssize_t>(count));
  bool* values = result.mutable_data();
  std::fill(values, values + count, false);
  for (std::size_t i = 0; i < mask.size(); ++i) values[kept[i]] = mask[i] != 0;
  return result;
}

sfm::Camera cameraOf(const py::tuple& camera) {
  sfm::Camera result;
  result.model = modelOf(camera[0].cast<std::string>());
  result.width = camera[1].cast<std::uint64_t>();
  result.height = camera[2].cast<std::uint64_t>();
  result.parameters = listOf(numbersOf("camera: params", camera[3]));
  return result;
}

py::dict dictOf(const sfm::Camera& camera) {
  py::dict dict;
  dict["model"] = camera.model == sfm::CameraModel::Unknown ? camera.unknownModel : toString(camera.model);
  dict["width"] = camera.width;
  dict["height"] = camera.height;
  dict["params"] = arrayOf(camera.parameters);
  return dict;
}

sfm::CameraKnowledge knowledgeOf(const std::string& name) {
  if (name == "unknown") return sfm::CameraKnowledge::Unknown;
  if (name == "prior") return sfm::CameraKnowledge::Prior;
  if (name == "known") return sfm::CameraKnowledge::Known;
  throw std::invalid_argument("camera_knowledge must be 'unknown', 'prior' or 'known', is '" + name + "'");
}

py::tuple tupleOf(const FocalPose& pose) {
  return py::make_tuple(arrayOf(pose.rotation), arrayOf(pose.position), pose.focalLength);
}

py::dict dictOf(const sac::HybridRansacResult& result) {
  py::dict dict;
  dict["success"] = result.success;
  dict["failure_reason"] = result.success ? py::object(py::none()) : py::str(toString(result.failureReason));
  dict["has_pose"] = result.score > 0;
  dict["rotation"] = arrayOf(result.pose.rotation);
  dict["position"] = arrayOf(result.pose.position);
  addLens(result, dict);
  dict["covariance"] = py::array_t<double>(std::vector<py::ssize_t>{7, 7}, result.covariance.data());
  dict["score"] = result.score;
  dict["num_inliers_points"] = result.numberInliers2d3d;
  dict["num_inliers_rays"] = result.numberInliers2d2d;
  dict["noise_points"] = result.noise2d3d;
  dict["noise_rays"] = result.noise2d2d;
  dict["second_pose"] = result.secondPose ? py::object(tupleOf(*result.secondPose)) : py::object(py::none());
  dict["second_pose_support"] = result.secondPoseSupport;
  addSearch(result, dict);
  return dict;
}

}  // namespace python
}  // namespace hybridgv

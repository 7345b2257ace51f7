// The checks at every public entry. A wrong call is answered by std::invalid_argument that names the argument and its value.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hybridgv/types.hpp"

namespace hybridgv {

[[noreturn]] void throwInvalid(const std::string& argument, const std::string& reason);

// `indices` must have at least `needed` entries (the first `needed` are used), different and below `available`. Errors call them
// `name` followed by `part`.
void checkIndices(const char* name, const char* part, const std::vector<int>& indices, int needed, std::size_t available);

// Multi-indices {2D-2D, 2D-3D}, with what is needed and available of each kind.
void checkMultiIndices(const char* name, const std::vector<std::vector<int>>& indices, const std::array<int, 2>& needed,
                       const std::array<std::size_t, 2>& available);

// Throw unless the value is finite and what the name of the function says.
void checkPositive(const std::string& name, double value);
void checkNotNegative(const std::string& name, double value);
void checkFinite(const std::string& name, const Eigen::Vector3d& value);
void checkRotation(const std::string& name, const Eigen::Matrix3d& value);

// Whether R^T R is the identity up to 1e-6, which admits rotations that were written with seven digits, and det R > 0. False for
// numbers that are not finite.
bool isRotation(const Eigen::Matrix3d& matrix);

// Throws unless the pose is finite with a rotation matrix and a positive focal length.
void checkPose(const std::string& name, const FocalPose& pose);

}  // namespace hybridgv

// The checks at every public entry. A wrong call is answered by std::invalid_argument that names the argument and its value.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "solvers/MinimalSolver.hpp"

namespace hybridgv {

[[noreturn]] void throwInvalid(const std::string& argument, const std::string& reason);

// `indices` must have at least `needed` entries (the first `needed` are used), different and below `available`. Errors call them
// `name` followed by `part`.
void checkIndices(const char* name, const char* part, const std::vector<int>& indices, int needed, std::size_t available);

// Multi-indices {2D-2D, 2D-3D}.
void checkMultiIndices(const char* name, const std::vector<std::vector<int>>& indices, int rays, int points,
                       const hybrid_pose::HybridAdapterBase& adapter);

// Throws unless the pose is finite with a rotation matrix and a positive focal length.
void checkPose(const std::string& name, const FocalPose& pose);

// A correspondence of the adapter as plain data; throws unless it is finite, with a ray of non-zero length.
solvers::RayMatch readRay(const hybrid_pose::HybridAdapterBase& adapter, int index);
solvers::PointMatch readPoint(const hybrid_pose::HybridAdapterBase& adapter, int index);

}  // namespace hybridgv

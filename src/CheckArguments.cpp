#include "CheckArguments.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hybridgv {

void throwInvalid(const std::string& argument, const std::string& reason) {
  throw std::invalid_argument("hybridgv: " + argument + ": " + reason);
}

// Names are put together only where an error is reported: these functions run once per minimal sample.
static void checkAllDifferent(const char* name, const char* part, const std::vector<int>& indices, int needed) {
  const auto end = indices.begin() + needed;
  const auto refuse = [&](int index) {
    throwInvalid(std::string(name) + part, "index " + std::to_string(index) + " is repeated");
  };
  if (needed <= 8) {  // a minimal sample: no allocation
    for (auto i = indices.begin(); i != end; ++i)
      if (std::find(indices.begin(), i, *i) != i) refuse(*i);
    return;
  }
  std::vector<int> sorted(indices.begin(), end);
  std::sort(sorted.begin(), sorted.end());
  const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
  if (repeated != sorted.end()) refuse(*repeated);
}

void checkIndices(const char* name, const char* part, const std::vector<int>& indices, int needed, std::size_t available) {
  if (indices.size() < static_cast<std::size_t>(needed))
    throwInvalid(std::string(name) + part, "needs " + std::to_string(needed) + " indices, got " + std::to_string(indices.size()));
  for (int i = 0; i < needed; ++i) {
    const int index = indices[static_cast<std::size_t>(i)];
    if (index < 0 || static_cast<std::size_t>(index) >= available)
      throwInvalid(std::string(name) + part, "index " + std::to_string(index) + " is outside the " + std::to_string(available) +
                                                 " correspondences of the adapter");
  }
  checkAllDifferent(name, part, indices, needed);
}

void checkMultiIndices(const char* name, const std::vector<std::vector<int>>& indices, const std::array<int, 2>& needed,
                       const std::array<std::size_t, 2>& available) {
  if (indices.size() != 2) throwInvalid(name, "needs two lists {2D-2D, 2D-3D}, got " + std::to_string(indices.size()));
  checkIndices(name, "[0] (2D-2D)", indices[0], needed[0], available[0]);
  checkIndices(name, "[1] (2D-3D)", indices[1], needed[1], available[1]);
}

void checkPose(const std::string& name, const FocalPose& pose) {
  constexpr double kTolerance = 1e-6;  // admits rotations that were written with seven digits
  if (!pose.rotation.allFinite() || !pose.position.allFinite()) throwInvalid(name, "not finite");
  const double error = (pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kTolerance) || pose.rotation.determinant() < 0) throwInvalid(name, "its rotation is not a rotation matrix");
  if (!(pose.focalLength > 0) || !std::isfinite(pose.focalLength))
    throwInvalid(name, "its focal length must be positive and finite, is " + std::to_string(pose.focalLength));
}

}  // namespace hybridgv

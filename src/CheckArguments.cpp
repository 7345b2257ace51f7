#include "CheckArguments.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hybridgv/detail/format.hpp"

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

void checkPositive(const std::string& name, double value) {
  if (!(value > 0) || !std::isfinite(value)) throwInvalid(name, "must be positive and finite, is " + detail::format(value));
}

void checkNotNegative(const std::string& name, double value) {
  if (!(value >= 0) || !std::isfinite(value)) throwInvalid(name, "must be finite and not negative, is " + detail::format(value));
}

void checkFinite(const std::string& name, const Eigen::Vector3d& value) {
  if (!value.allFinite()) throwInvalid(name, "must be finite, is " + detail::format(value));
}

// What nearly all rotations pass, faster than the exact test, and nothing else: with columns a, b, c, a and b are orthonormal and c = a x b,
// each to a tenth of the tolerance.
static bool isClearlyRotation(const Eigen::Matrix3d& m, double tolerance) {
  const auto isNear = [=](double value, double expected) { return std::abs(value - expected) < tolerance / 10; };
  const double *a = m.data(), *b = a + 3, *c = b + 3;
  return isNear(a[0] * a[0] + a[1] * a[1] + a[2] * a[2], 1) && isNear(b[0] * b[0] + b[1] * b[1] + b[2] * b[2], 1) &&
         isNear(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], 0) && isNear(a[1] * b[2] - a[2] * b[1], c[0]) &&
         isNear(a[2] * b[0] - a[0] * b[2], c[1]) && isNear(a[0] * b[1] - a[1] * b[0], c[2]);
}

bool isRotation(const Eigen::Matrix3d& matrix) {
  constexpr double kTolerance = 1e-6;
  if (isClearlyRotation(matrix, kTolerance)) return true;
  if (!matrix.allFinite()) return false;  // Eigen's maximum may pass over a NaN
  const double error = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return error < kTolerance && matrix.determinant() > 0;
}

void checkRotation(const std::string& name, const Eigen::Matrix3d& value) {
  if (!isRotation(value)) throwInvalid(name, "must be a rotation matrix, is " + detail::format(value));
}

void checkPose(const std::string& name, const FocalPose& pose) {
  checkRotation(name + ".rotation", pose.rotation);
  checkFinite(name + ".position", pose.position);
  checkPositive(name + ".focalLength", pose.focalLength);
}

}  // namespace hybridgv

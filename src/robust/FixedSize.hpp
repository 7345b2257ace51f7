// Matrices over the estimated parameters with a size that the compiler knows.
#pragma once

#include <type_traits>

#include "correspondences/Intrinsics.hpp"

namespace hybridgv {
namespace robust {

// Calls function(std::integral_constant<int, N>()) with N = parameters.
template <class Function>
auto withFixedSize(int parameters, const Function& function) {
  using correspondences::kMostParameters;
  using correspondences::kPoseParameters;
  static_assert(kMostParameters == kPoseParameters + 2, "a case for every number of parameters");
  switch (parameters) {
    case kPoseParameters:
      return function(std::integral_constant<int, kPoseParameters>());
    case kPoseParameters + 1:
      return function(std::integral_constant<int, kPoseParameters + 1>());
    default:
      return function(std::integral_constant<int, kMostParameters>());
  }
}

}  // namespace robust
}  // namespace hybridgv

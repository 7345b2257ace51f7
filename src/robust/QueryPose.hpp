// What the robust estimation looks for: the query's pose with all that is known or estimated of its camera.
#pragma once

#include "hybridgv/types.hpp"

namespace hybridgv {
namespace robust {

// The solvers' FocalPose, and beside it the radial distortion c [1/px^2] of the division model: what is seen at (u, v) would be at
// (u, v) / (1 + c (u^2 + v^2)) in a pinhole image.
struct QueryPose : FocalPose {
  QueryPose() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a pinhole camera's pose is one of these.
  QueryPose(const FocalPose& pose) : FocalPose(pose) {}

  double distortion = 0;
};

}  // namespace robust
}  // namespace hybridgv

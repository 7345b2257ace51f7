// What is estimated of the query's camera beside its pose.
#pragma once

namespace hybridgv {
namespace correspondences {

// The pose has six parameters; each of these adds one. Today's functions estimate the focal length only.
struct Intrinsics {
  bool focalLength = true;
  bool radial = false;  // one parameter of radial distortion

  constexpr int parameters() const { return 6 + (focalLength ? 1 : 0) + (radial ? 1 : 0); }
};

}  // namespace correspondences
}  // namespace hybridgv

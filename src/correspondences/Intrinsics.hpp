// What is estimated of the query's camera beside its pose.
#pragma once

namespace hybridgv {
namespace correspondences {

// Rotation and position.
constexpr int kPoseParameters = 6;

// The pose's parameters are estimated always; each of these adds one, in this order. Today's public functions estimate the focal
// length only.
struct Intrinsics {
  bool focalLength = true;
  bool radial = false;  // one parameter of radial distortion

  constexpr int parameters() const { return kPoseParameters + (focalLength ? 1 : 0) + (radial ? 1 : 0); }
};

// What a FocalPose consists of.
constexpr int kFocalPoseParameters = Intrinsics{true, false}.parameters();
constexpr int kMostParameters = Intrinsics{true, true}.parameters();

}  // namespace correspondences
}  // namespace hybridgv

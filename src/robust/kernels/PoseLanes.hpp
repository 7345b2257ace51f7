// A pose in every lane: what all kernels begin with.
#pragma once

#include "math/Vec3.hpp"
#include "robust/kernels/Kernels.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;

constexpr int kWidth = LaneTraits<Doubles>::kWidth;
constexpr double kInfinity = __builtin_huge_val();

struct Pose {
  explicit Pose(const PlainPose& pose)
      : r1(broadcastVector<Doubles>(pose.r1)),
        r2(broadcastVector<Doubles>(pose.r2)),
        r3(broadcastVector<Doubles>(pose.r3)),
        position(broadcastVector<Doubles>(pose.position)),
        positionInQuery(toQuery(position)),
        f(broadcast<Doubles>(pose.focalLength)) {}
  Vec3<Doubles> toQuery(const Vec3<Doubles>& v) const { return {dot(r1, v), dot(r2, v), dot(r3, v)}; }
  Vec3<Doubles> toRig(const Vec3<Doubles>& v) const { return v.x * r1 + v.y * r2 + v.z * r3; }
  Vec3<Doubles> r1, r2, r3;       // columns of the rotation R
  Vec3<Doubles> position;         // p
  Vec3<Doubles> positionInQuery;  // R^T p
  Doubles f;
};

// That of a camera with radial distortion.
struct RadialPose : Pose {
  explicit RadialPose(const PlainPose& pose) : Pose(pose), distortion(broadcast<Doubles>(pose.distortion)) {}
  Doubles distortion;  // c
};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

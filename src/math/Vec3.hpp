// The 3-vector of formulas that are evaluated at many places: over a number, or over the lanes of a SIMD vector.
#pragma once

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

template <class T>
struct Vec3 {
  T x, y, z;
};

// The same vector in all lanes.
template <class V>
HYBRIDGV_INLINE Vec3<V> broadcastVector(const Real<V>* v) {
  return {broadcast<V>(v[0]), broadcast<V>(v[1]), broadcast<V>(v[2])};
}

template <class A, class B>
HYBRIDGV_INLINE auto operator+(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x + b.x)> {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
HYBRIDGV_INLINE auto operator-(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x - b.x)> {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
HYBRIDGV_INLINE auto operator*(const A& a, const Vec3<B>& b) -> Vec3<decltype(a * b.x)> {
  return {a * b.x, a * b.y, a * b.z};
}
template <class A, class B>
HYBRIDGV_INLINE auto dot(const Vec3<A>& a, const Vec3<B>& b) -> decltype(a.x * b.x) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
HYBRIDGV_INLINE auto cross(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x * b.x)> {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv

// 3-vectors over a double or over several doubles at once (SIMD lanes), for formulas that are evaluated at many places.
#pragma once

namespace hybridgv {
namespace math {

template <class T>
struct Vec3 {
  T x, y, z;
};

template <class A, class B>
auto operator+(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x + b.x)> {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
auto operator-(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x - b.x)> {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
auto operator*(const A& a, const Vec3<B>& b) -> Vec3<decltype(a * b.x)> {
  return {a * b.x, a * b.y, a * b.z};
}
template <class A, class B>
auto dot(const Vec3<A>& a, const Vec3<B>& b) -> decltype(a.x * b.x) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
auto cross(const Vec3<A>& a, const Vec3<B>& b) -> Vec3<decltype(a.x * b.x)> {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace math
}  // namespace hybridgv

// Image quantities for the inner loops of the solvers.
#pragma once

#include "math/Complex.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

// A quantity in the image plane, x + i y. Its coordinates are doubles, or Pairs, or (where a parameter of the problem is complex)
// complex numbers themselves; then every formula is continued analytically, without conjugation.
template <class T>
struct Planar {
  T x, y;
};
using ImagePoint = Planar<double>;

template <class A, class B>
HYBRIDGV_INLINE auto operator+(const Planar<A>& a, const Planar<B>& b) -> Planar<decltype(a.x + b.x)> {
  return {a.x + b.x, a.y + b.y};
}
template <class A, class B>
HYBRIDGV_INLINE auto operator-(const Planar<A>& a, const Planar<B>& b) -> Planar<decltype(a.x - b.x)> {
  return {a.x - b.x, a.y - b.y};
}
// Real (or analytically continued) factor.
template <class A, class B>
HYBRIDGV_INLINE auto operator*(const A& factor, const Planar<B>& b) -> Planar<decltype(factor * b.x)> {
  return {factor * b.x, factor * b.y};
}
// Real and imaginary part of conj(a) b: the scalar product and the signed area.
template <class A, class B>
HYBRIDGV_INLINE auto re(const Planar<A>& a, const Planar<B>& b) -> decltype(a.x * b.x) {
  return a.x * b.x + a.y * b.y;
}
template <class A, class B>
HYBRIDGV_INLINE auto im(const Planar<A>& a, const Planar<B>& b) -> decltype(a.x * b.y) {
  return a.x * b.y - a.y * b.x;
}
// Product of two image quantities as complex numbers.
HYBRIDGV_INLINE ImagePoint product(const ImagePoint& a, const ImagePoint& b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}
// i a
HYBRIDGV_INLINE ImagePoint timesI(const ImagePoint& a) { return {-a.y, a.x}; }

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv

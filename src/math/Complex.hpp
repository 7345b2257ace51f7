// Complex numbers for inner loops: without std::complex's treatment of infinities, which costs a branch in every product. V is a
// number, or a SIMD vector of numbers; then there is one complex number per lane.
#pragma once

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

template <class V>
struct Complex {
  V re, im;
};

template <class V>
HYBRIDGV_INLINE Complex<V> operator+(const Complex<V>& a, const Complex<V>& b) {
  return {a.re + b.re, a.im + b.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator-(const Complex<V>& a, const Complex<V>& b) {
  return {a.re - b.re, a.im - b.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator-(const Complex<V>& a) {
  return {-a.re, -a.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator*(const Complex<V>& a, const Complex<V>& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator+(const Complex<V>& a, const V& b) {
  return {a.re + b, a.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator+(const V& a, const Complex<V>& b) {
  return {a + b.re, b.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator-(const Complex<V>& a, const V& b) {
  return {a.re - b, a.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator-(const V& a, const Complex<V>& b) {
  return {a - b.re, -b.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator*(const V& a, const Complex<V>& b) {
  return {a * b.re, a * b.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator*(const Complex<V>& a, const V& b) {
  return {a.re * b, a.im * b};
}
// c + a b and c - a b, in two fused operations per part where the processor has them
template <class V>
HYBRIDGV_INLINE Complex<V> addProduct(const Complex<V>& c, const Complex<V>& a, const Complex<V>& b) {
  return {c.re + a.re * b.re - a.im * b.im, c.im + a.re * b.im + a.im * b.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> subtractProduct(const Complex<V>& c, const Complex<V>& a, const Complex<V>& b) {
  return {c.re - a.re * b.re + a.im * b.im, c.im - a.re * b.im - a.im * b.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> twice(const Complex<V>& a) {
  return {a.re + a.re, a.im + a.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> timesI(const Complex<V>& a) {
  return {-a.im, a.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> conjugate(const Complex<V>& a) {
  return {a.re, -a.im};
}
template <class V>
HYBRIDGV_INLINE V squaredNorm(const Complex<V>& a) {
  return a.re * a.re + a.im * a.im;
}
template <class V>
HYBRIDGV_INLINE Complex<V> reciprocal(const Complex<V>& a) {
  const V scale = 1 / squaredNorm(a);
  return {a.re * scale, -a.im * scale};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator/(const Complex<V>& a, const Complex<V>& b) {
  const V scale = 1 / squaredNorm(b);
  return {(a.re * b.re + a.im * b.im) * scale, (a.im * b.re - a.re * b.im) * scale};
}
template <class V>
HYBRIDGV_INLINE Complex<V> select(Mask<V> mask, const Complex<V>& yes, const Complex<V>& no) {
  return {mask ? yes.re : no.re, mask ? yes.im : no.im};
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv

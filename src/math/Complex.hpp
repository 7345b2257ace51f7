// Complex numbers and image quantities for the inner loops of the solvers.
#pragma once

#include "math/simd/Pair.hpp"

namespace hybridgv {
namespace math {

// Complex number without std::complex's treatment of infinities, which costs a branch in every product.
struct Complex {
  double re, im;
};
inline Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
inline Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
inline Complex operator*(Complex a, Complex b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
inline Complex operator+(Complex a, double b) { return {a.re + b, a.im}; }
inline Complex operator+(double a, Complex b) { return b + a; }
inline Complex operator-(Complex a, double b) { return {a.re - b, a.im}; }
inline Complex operator-(double a, Complex b) { return {a - b.re, -b.im}; }
inline Complex operator*(Complex a, double b) { return {a.re * b, a.im * b}; }
inline Complex operator*(double a, Complex b) { return b * a; }
inline Complex operator-(Complex a) { return {-a.re, -a.im}; }
inline double squaredNorm(Complex a) { return a.re * a.re + a.im * a.im; }
inline Complex operator/(Complex a, Complex b) {
  const double scale = 1 / squaredNorm(b);
  return {(a.re * b.re + a.im * b.im) * scale, (a.im * b.re - a.re * b.im) * scale};
}

// A quantity in the image plane, x + i y. Its coordinates are doubles, or Pairs, or (where a parameter of the problem is complex)
// complex numbers themselves; then every formula is continued analytically, without conjugation.
template <class T>
struct Planar {
  T x, y;
};
using ImagePoint = Planar<double>;

template <class A, class B>
auto operator+(const Planar<A>& a, const Planar<B>& b) -> Planar<decltype(a.x + b.x)> {
  return {a.x + b.x, a.y + b.y};
}
template <class A, class B>
auto operator-(const Planar<A>& a, const Planar<B>& b) -> Planar<decltype(a.x - b.x)> {
  return {a.x - b.x, a.y - b.y};
}
// Real (or analytically continued) factor.
template <class A, class B>
auto operator*(const A& factor, const Planar<B>& b) -> Planar<decltype(factor * b.x)> {
  return {factor * b.x, factor * b.y};
}
// Real and imaginary part of conj(a) b: the scalar product and the signed area.
template <class A, class B>
auto re(const Planar<A>& a, const Planar<B>& b) -> decltype(a.x * b.x) {
  return a.x * b.x + a.y * b.y;
}
template <class A, class B>
auto im(const Planar<A>& a, const Planar<B>& b) -> decltype(a.x * b.y) {
  return a.x * b.y - a.y * b.x;
}
// Product of two image quantities as complex numbers.
inline ImagePoint product(const ImagePoint& a, const ImagePoint& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
// i a
inline ImagePoint timesI(const ImagePoint& a) { return {-a.y, a.x}; }

}  // namespace math
}  // namespace hybridgv

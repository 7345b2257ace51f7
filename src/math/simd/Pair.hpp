// Two numbers in one register: the instruction set that every x86-64 processor has works on pairs.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <cmath>
#include <cstring>

namespace hybridgv {
namespace math {

// +, -, *, / and comparisons work lane by lane, also with a double; `condition ? a : b` chooses lane by lane.
using Pair = double __attribute__((vector_size(16)));

inline Pair load(const double* p) {
  Pair result;
  std::memcpy(&result, p, sizeof result);
  return result;
}
inline void store(double* p, Pair value) { std::memcpy(p, &value, sizeof value); }
inline Pair min(Pair a, Pair b) { return a < b ? a : b; }
inline Pair max(Pair a, Pair b) { return a > b ? a : b; }
inline Pair abs(Pair a) { return max(a, -a); }
inline Pair sqrt(Pair a) {
#ifdef __SSE2__
  return _mm_sqrt_pd(a);
#else
  return Pair{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}

// The same for one number, for templates.
inline double min(double a, double b) { return a < b ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }
inline double abs(double a) { return std::abs(a); }
inline double sqrt(double a) { return std::sqrt(a); }

}  // namespace math
}  // namespace hybridgv

// What is orthogonal to some 3x3 matrices: the linear part of epipolar geometry.
#pragma once

#include <cmath>

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace solvers {

// The nine entries of a 3x3 matrix, row by row, and a zero.
struct PaddedMatrix {
  static constexpr int kPairs = 5;
  math::Pair e[kPairs];

  double operator[](int i) const { return e[i / 2][i % 2]; }
};

// The product p q^T of two vectors, with |p| |q| = 1.
inline PaddedMatrix outerProduct(const double (&p)[3], const double (&q)[3]) {
  using math::Pair;
  return {{Pair{p[0] * q[0], p[0] * q[1]}, Pair{p[0] * q[2], p[1] * q[0]}, Pair{p[1] * q[1], p[1] * q[2]},
           Pair{p[2] * q[0], p[2] * q[1]}, Pair{p[2] * q[2], 0}}};
}

// Unit rows, which become Householder vectors w_k:  H_k = I - factor_k w_k w_k^T,  w_k zero before entry k.
template <int Rows>
class Reflections {
 public:
  explicit Reflections(PaddedMatrix (&rows)[Rows]) : row_(rows) {}

  bool reduce() { return reduceFrom<0>(); }
  // H_0 .. H_(Rows-1) a
  void apply(PaddedMatrix& a) const { applyFrom<Rows - 1>(a); }

 private:
  // A row is dependent on the others where what is left of it is below this.
  static constexpr double kDependent = 1e-12;

  // Inner product of the entries from pair `First` on.
  template <int First>
  static double dot(const PaddedMatrix& a, const PaddedMatrix& b) {
    math::Pair sum = a.e[First] * b.e[First];
    for (int i = First + 1; i < PaddedMatrix::kPairs; ++i) sum += a.e[i] * b.e[i];
    return sum[0] + sum[1];
  }

  template <int First>
  static void subtractMultiple(PaddedMatrix& a, double factor, const PaddedMatrix& b) {
    for (int i = First; i < PaddedMatrix::kPairs; ++i) a.e[i] -= factor * b.e[i];
  }

  // Reflects rows K .. so that row K vanishes behind entry K, and so on.
  template <int K>
  bool reduceFrom() {
    using math::Pair;
    constexpr int kFirst = K / 2, kLane = K % 2;
    PaddedMatrix& w = row_[K];
    if (kLane == 1) w.e[kFirst] = Pair{0, w.e[kFirst][1]};
    double inner[Rows];
    for (int l = K; l < Rows; ++l) inner[l] = dot<kFirst>(w, row_[l]);
    const double head = w.e[kFirst][kLane], length = std::sqrt(inner[K]), shift = std::copysign(length, head);
    if (!(length > kDependent)) return false;
    w.e[kFirst] += kLane == 0 ? Pair{shift, 0} : Pair{0, shift};
    factor_[K] = 1 / (length * (length + std::abs(head)));
    for (int l = K + 1; l < Rows; ++l)
      subtractMultiple<kFirst>(row_[l], factor_[K] * (inner[l] + shift * row_[l].e[kFirst][kLane]), w);
    if constexpr (K + 1 < Rows) return reduceFrom<K + 1>();
    return true;
  }

  template <int K>
  void applyFrom(PaddedMatrix& a) const {
    constexpr int kFirst = K / 2;
    subtractMultiple<kFirst>(a, factor_[K] * dot<kFirst>(row_[K], a), row_[K]);
    if constexpr (K > 0) applyFrom<K - 1>(a);
  }

  PaddedMatrix (&row_)[Rows];
  double factor_[Rows];
};

// Orthonormal basis of the matrices that are orthogonal to all rows, which must have length 1 and are overwritten; false unless they
// are independent.
template <int Rows>
bool nullSpace(PaddedMatrix (&rows)[Rows], PaddedMatrix* basis) {
  Reflections<Rows> reflections(rows);
  if (!reflections.reduce()) return false;
  // The rows are now those of a lower triangular matrix times the reflections; what it leaves are the last unit vectors.
  for (int n = 0; n < 9 - Rows; ++n) {
    for (math::Pair& pair : basis[n].e) pair = math::Pair{0, 0};
    basis[n].e[(Rows + n) / 2][(Rows + n) % 2] = 1;
    reflections.apply(basis[n]);
  }
  return true;
}

}  // namespace solvers
}  // namespace hybridgv

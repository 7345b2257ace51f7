#include "solvers/one_centre/EpipolarNullSpace.hpp"

#include <cmath>

namespace hybridgv {
namespace solvers {
namespace one_centre {
namespace {

using math::Pair;

// A constraint is dependent on the others where what is left of its unit row is below this.
constexpr double kDependent = 1e-12;

// Inner product of the entries from pair `First` on.
template <int First>
double dot(const PaddedMatrix& a, const PaddedMatrix& b) {
  Pair sum = a.e[First] * b.e[First];
  for (int i = First + 1; i < PaddedMatrix::kPairs; ++i) sum += a.e[i] * b.e[i];
  return sum[0] + sum[1];
}

template <int First>
void subtractMultiple(PaddedMatrix& a, double factor, const PaddedMatrix& b) {
  for (int i = First; i < PaddedMatrix::kPairs; ++i) a.e[i] -= factor * b.e[i];
}

// The six rows p_k (x) q_k, which become Householder vectors w_k:  H_k = I - factor_k w_k w_k^T,  w_k zero before entry k.
struct Reflections {
  PaddedMatrix row[kSix];
  double factor[kSix];

  // Reflects rows K .. 5 so that row K vanishes behind entry K, and so on.
  template <int K>
  bool reduceFrom() {
    constexpr int kFirst = K / 2, kLane = K % 2;
    PaddedMatrix& w = row[K];
    if (kLane == 1) w.e[kFirst] = Pair{0, w.e[kFirst][1]};
    double inner[kSix];
    for (int l = K; l < kSix; ++l) inner[l] = dot<kFirst>(w, row[l]);
    const double head = w.e[kFirst][kLane], length = std::sqrt(inner[K]), shift = std::copysign(length, head);
    if (!(length > kDependent)) return false;
    w.e[kFirst] += kLane == 0 ? Pair{shift, 0} : Pair{0, shift};
    factor[K] = 1 / (length * (length + std::abs(head)));
    for (int l = K + 1; l < kSix; ++l)
      subtractMultiple<kFirst>(row[l], factor[K] * (inner[l] + shift * row[l].e[kFirst][kLane]), w);
    if constexpr (K + 1 < kSix) return reduceFrom<K + 1>();
    return true;
  }

  // H_0 .. H_K a
  template <int K>
  void apply(PaddedMatrix& a) const {
    constexpr int kFirst = K / 2;
    subtractMultiple<kFirst>(a, factor[K] * dot<kFirst>(row[K], a), row[K]);
    if constexpr (K > 0) apply<K - 1>(a);
  }
};

}  // namespace

bool epipolarNullSpace(const SixCorrespondences& correspondences, PaddedMatrix* basis) {
  Reflections reflections;
  for (int k = 0; k < kSix; ++k) {
    const double u = correspondences.u[k], v = correspondences.v[k];
    const double scale = 1 / std::sqrt(u * u + v * v + 1);
    const double x = scale * correspondences.x[k], y = scale * correspondences.y[k], z = scale * correspondences.z[k];
    reflections.row[k] = {Pair{u * x, u * y}, Pair{u * z, v * x}, Pair{v * y, v * z}, Pair{x, y}, Pair{z, 0}};
  }
  if (!reflections.reduceFrom<0>()) return false;
  // The rows are now those of a lower triangular matrix times H_5 .. H_0; what it leaves are the last three unit vectors.
  basis[0] = {Pair{0, 0}, Pair{0, 0}, Pair{0, 0}, Pair{1, 0}, Pair{0, 0}};
  basis[1] = {Pair{0, 0}, Pair{0, 0}, Pair{0, 0}, Pair{0, 1}, Pair{0, 0}};
  basis[2] = {Pair{0, 0}, Pair{0, 0}, Pair{0, 0}, Pair{0, 0}, Pair{1, 0}};
  for (int n = 0; n < 3; ++n) reflections.apply<kSix - 1>(basis[n]);
  return true;
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv

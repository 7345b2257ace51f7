// What correspondences cost, and the weights that follow from it.
#pragma once

#include "math/simd/logarithm.hpp"
#include "robust/kernels/PoseLanes.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

HYBRIDGV_INLINE Doubles toTheEighth(Doubles q) {
  const Doubles q2 = q * q, q4 = q2 * q2;
  return q4 * q4;
}

// The sum of logs as the log of a product, which is taken before it can overflow: every factor is from 1 to 1e9 + 1.
class LogSum {
 public:
  HYBRIDGV_INLINE void add(Doubles factor) {
    product_ *= factor;
    if (++factors_ == 32) flush();
  }
  Doubles value() {
    flush();
    return sum_;
  }

 private:
  void flush() {
    sum_ += math::logarithm(product_);
    product_ = broadcast<Doubles>(1);
    factors_ = 0;
  }
  Doubles product_ = broadcast<Doubles>(1), sum_{};
  int factors_ = 0;
};

// x = narrowing (error / scale)^2; that of no valid correspondence is infinite.
HYBRIDGV_INLINE Doubles relativeSquare(const KindLoss& loss, DoubleMask valid, Doubles squaredError, Doubles narrowing) {
  return select<Doubles>(valid, narrowing * squaredError * (1 / (loss.scale * loss.scale)), broadcast<Doubles>(kInfinity));
}

// The derivative of rho(x) for one kind of loss; rho(infinity) has none.
HYBRIDGV_INLINE Doubles slope(const KindLoss& loss, Doubles x) {
  switch (loss.loss) {
    case Loss::Quadratic:
      break;
    case Loss::Truncated:
      return select<Doubles>(x < 1.0, broadcast<Doubles>(1), Doubles{});
    case Loss::Mixture:
      return 8 * loss.odds / ((1.0 + x) * (toTheEighth(1.0 + x) + loss.odds));
  }
  return broadcast<Doubles>(1);
}

// The cost of one kind's correspondences, and their weights.
class CostSum {
 public:
  explicit CostSum(const KindLoss& loss) : loss_(loss) {}

  // Adds what the correspondences cost, and returns the weights of their squared errors. Those that are not valid have weight 0.
  // `narrowing` may be null. Where it is infinite there is no cost either.
  HYBRIDGV_INLINE Doubles weigh(DoubleMask inRange, DoubleMask valid, Doubles squaredError, const double* narrowing = nullptr) {
    const Doubles factor = narrowing ? load<Doubles>(narrowing) : broadcast<Doubles>(1);
    const DoubleMask counts = factor < kInfinity;
    const Doubles x = relativeSquare(loss_, valid & counts, squaredError, factor);
    if (loss_.loss == Loss::Mixture && !narrowing)
      logs_.add(select<Doubles>(inRange, mixtureFactor(x), broadcast<Doubles>(1)));
    else
      rho_ += select<Doubles>(inRange & counts, narrowing ? rho(x) / factor : rho(x), Doubles{});
    return select<Doubles>(inRange & valid & counts, loss_.precision * slope(loss_, x), Doubles{});
  }
  double total() { return loss_.precision * loss_.scale * loss_.scale * sum(rho_ + logs_.value()); }

 private:
  HYBRIDGV_INLINE Doubles rho(Doubles x) const {
    switch (loss_.loss) {
      case Loss::Quadratic:
        break;
      case Loss::Truncated:
        return select<Doubles>(x < 1.0, x, broadcast<Doubles>(1));
      case Loss::Mixture:
        return math::logarithm(mixtureFactor(x));
    }
    return x;
  }
  HYBRIDGV_INLINE Doubles mixtureFactor(Doubles x) const {
    return (1.0 + loss_.odds) / (1.0 + loss_.odds / toTheEighth(1.0 + x));
  }

  KindLoss loss_;
  LogSum logs_;
  Doubles rho_{};
};

template <class Ray>
HYBRIDGV_INLINE DoubleMask isValid(const Ray& ray, Doubles squaredError, const KindLoss& loss) {
  const DoubleMask isFinite = (ray.variance > 0) & (squaredError < kInfinity);
  return loss.loss == Loss::Quadratic ? isFinite : isFinite & ray.inFront();
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv

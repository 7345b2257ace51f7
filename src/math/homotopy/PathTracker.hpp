// Tracks the solutions of a parametrized square system F(x, t) = 0 from t = 0 to t = 1, one path per SIMD lane.
//
// Every lane has its own position and step size; a lane that has finished takes the next path. A step is a predictor, a Newton
// step that also bounds the predictor's error, and a second Newton step that gives the tangent at the new point as well:
//
//   predictor   Pade approximant [2/1] of every component through the last two points and their tangents (a cubic polynomial
//               where the approximant has a pole nearby, a straight line at the start)
//   accepted    if both Newton steps are small: the second one tells that the first one converged
//   step size   proportional to the 4th root of the first Newton step, the order of the predictor's error
//
// A System gives
//   kUnknowns      N
//   kAbsolute      the first kAbsolute unknowns get Newton steps dx, measured relative to sqrt(1 + |x|^2); the others, which
//                  cannot vanish, get relative steps dx/x: multiplicative unknowns are better scaled so
//   Homotopy<Scalar>, Data<V>, dataAt(homotopy, t, data)
//                  how the coefficients of F depend on t, and their values at one t per lane
//   evaluate<derivative>(homotopy, t, data, x, rows)
//                  rows[N][N+1] = [dF/dx | F], or rows[N][N+2] = [dF/dx | F | dF/dt] if derivative is true, with derivatives with
//                  respect to log x for the multiplicative unknowns
#pragma once

#include "math/homotopy/Data.hpp"
#include "math/homotopy/LinearSystem.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

struct TrackingOptions {
  double tolerance;     // wanted size of the first Newton step
  double acceptFirst;   // largest first Newton step
  double acceptSecond;  // largest second Newton step
  double firstStep;     // in t
  double largestStep;
  double smallestStep;  // a rejected step that would go below ends the path
  int attempts;         // accepted and rejected steps of a path, at most
};

template <class Scalar, int N>
struct PathEnd {
  Point<Scalar, N> point;
  int attempts;
  bool reached;  // t = 1
};

// points[indices[0 .. count-1]], one per lane; lanes beyond get the first one.
template <class V, int N>
HYBRIDGV_INLINE void loadLanes(const Point<Real<V>, N>* points, const int* indices, int count, Complex<V> (&x)[N]) {
  alignas(V) Real<V> re[N][LaneTraits<V>::kWidth], im[N][LaneTraits<V>::kWidth];
  for (int lane = 0; lane < LaneTraits<V>::kWidth; ++lane) {
    const Point<Real<V>, N>& point = points[indices[lane < count ? lane : 0]];
    for (int k = 0; k < N; ++k) {
      re[k][lane] = point.re[k];
      im[k][lane] = point.im[k];
    }
  }
  for (int k = 0; k < N; ++k) {
    __builtin_memcpy(&x[k].re, re[k], sizeof(V));
    __builtin_memcpy(&x[k].im, im[k], sizeof(V));
  }
}
template <class V, int N>
HYBRIDGV_INLINE void storeLane(const Complex<V> (&x)[N], int lane, Point<Real<V>, N>& point) {
  for (int k = 0; k < N; ++k) {
    point.re[k] = x[k].re[lane];
    point.im[k] = x[k].im[lane];
  }
}

// Applies the step to x; returns the squared size of the step's largest component, relative as described above. NaN is kept.
template <class System, class V, int Columns>
HYBRIDGV_INLINE V newtonUpdate(const Complex<V> (&rows)[System::kUnknowns][Columns], Complex<V> (&x)[System::kUnknowns]) {
  constexpr int N = System::kUnknowns;
  V size = V{};
#pragma GCC unroll 8
  for (int k = 0; k < N; ++k) {
    const Complex<V>& step = rows[k][N];
    V relative = squaredNorm(step);
    if (k < System::kAbsolute) {
      relative /= squaredNorm(x[k]) + 1;
      x[k] = x[k] - step;
    } else {
      x[k] = subtractProduct(x[k], x[k], step);
    }
    size = relative < size ? size : relative;
  }
  return size;
}

// The tangent dx/dt from the solution of J y = F_t in the given column.
template <class System, class V, int Columns>
HYBRIDGV_INLINE void tangentFrom(const Complex<V> (&rows)[System::kUnknowns][Columns], const Complex<V> (&x)[System::kUnknowns],
                                 Complex<V> (&tangent)[System::kUnknowns]) {
  constexpr int N = System::kUnknowns;
#pragma GCC unroll 8
  for (int k = 0; k < N; ++k) {
    const Complex<V> y = rows[k][N + 1];
    tangent[k] = k < System::kAbsolute ? -y : -(x[k] * y);
  }
}

// One component of the predictor: points x0, x1 with tangents at a distance `past` in t from each other; the value at a further
// distance `step`. With s = (past+step)/past, P = past x0', D = x1-x0, A = D-P, B = past x1'-D, C = B-A:
//   Pade [2/1]  x0 + s ((1-s) B P + s A D) / (B - s C),      cubic  x0 + s (P + s (A + (s-1) C)).
template <class V>
HYBRIDGV_INLINE Complex<V> extrapolate(const Complex<V>& x0, const Complex<V>& tangent0, const Complex<V>& x1,
                                       const Complex<V>& tangent1, V past, V s, Mask<V> allowPade) {
  const Complex<V> P = past * tangent0, D = x1 - x0, A = D - P, B = past * tangent1 - D, C = B - A;
  const V t = s - 1;
  const Complex<V> denominator = B - s * C;
  const Complex<V> numerator = s * (A * D) - t * (B * P);
  const V norm = squaredNorm(denominator);
  const Complex<V> pade = (1 / norm) * (numerator * conjugate(denominator));
  const Complex<V> cubic = P + s * (A + t * C);
  return x0 + s * select((norm > Real<V>(0.01) * squaredNorm(B)) & allowPade, pade, cubic);
}

template <class System, class V, Pivoting pivoting>
class PathTracker {
 public:
  using Scalar = Real<V>;
  static constexpr int N = System::kUnknowns, W = LaneTraits<V>::kWidth;
  using Homotopy = typename System::template Homotopy<Scalar>;

  // The tangents dx/dt at starts[paths[i]], by Newton's linear system at t = 0.
  static void startTangents(const Homotopy& homotopy, const Point<Scalar, N>* starts, const int* paths, int count,
                            Point<Scalar, N>* tangents) {
    for (int first = 0; first < count; first += W) {
      Complex<V> x[N], tangent[N], rows[N][N + 2];
      typename System::template Data<V> data;
      loadLanes(starts, paths + first, count - first, x);
      System::dataAt(homotopy, V{}, data);
      System::template evaluate<true>(homotopy, V{}, data, x, rows);
      solveInPlace<Pivoting::Rows>(rows);
      tangentFrom<System>(rows, x, tangent);
      for (int lane = 0; lane < W && first + lane < count; ++lane) storeLane(tangent, lane, tangents[paths[first + lane]]);
    }
  }

  // Tracks the `count` paths that start at starts[paths[i]]; the end of path i goes to ends[paths[i]].
  static void track(const Homotopy& homotopy, const Point<Scalar, N>* starts, const Point<Scalar, N>* tangents, const int* paths,
                    int count, const TrackingOptions& options, PathEnd<Scalar, N>* ends) {
    PathTracker tracker(homotopy, starts, tangents, paths, count, options, ends);
    while (tracker.active_) tracker.attempt();
  }

 private:
  PathTracker(const Homotopy& homotopy, const Point<Scalar, N>* starts, const Point<Scalar, N>* tangents, const int* paths,
              int count, const TrackingOptions& options, PathEnd<Scalar, N>* ends)
      : homotopy_(homotopy), starts_(starts), tangents_(tangents), paths_(paths), count_(count), options_(options), ends_(ends) {
    if (count > 0)
      for (int lane = 0; lane < W; ++lane) load(lane);
  }

  // Gives the lane the next path; a lane that finds none repeats the first one, to no effect.
  void load(int lane) {
    const bool more = next_ < count_;
    path_[lane] = paths_[more ? next_ : 0];
    next_ += more;
    active_ = more ? active_ | 1u << lane : active_ & ~(1u << lane);
    const Point<Scalar, N>& start = starts_[path_[lane]];
    const Point<Scalar, N>& tangent = tangents_[path_[lane]];
    const Scalar step = static_cast<Scalar>(options_.firstStep);
    for (int k = 0; k < N; ++k) {  // the older point is made up: it lies on the start's tangent
      x1_[k].re[lane] = start.re[k];
      x1_[k].im[lane] = start.im[k];
      tangent1_[k].re[lane] = tangent.re[k];
      tangent1_[k].im[lane] = tangent.im[k];
      tangent0_[k].re[lane] = tangent.re[k];
      tangent0_[k].im[lane] = tangent.im[k];
      x0_[k].re[lane] = start.re[k] - step * tangent.re[k];
      x0_[k].im[lane] = start.im[k] - step * tangent.im[k];
    }
    t_[lane] = 0;
    step_[lane] = step;
    past_[lane] = step;
    curved_[lane] = 0;
    attempts_[lane] = 0;
  }

  void attempt() {
    const V remaining = 1 - t_;
    const Mask<V> last = step_ >= remaining;
    const V step = select(last, remaining, step_), t = select(last, broadcast<V>(1), t_ + step_);
    Complex<V> x[N], tangent[N], rows[N][N + 2];
    const V s = step / past_ + 1;
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k) x[k] = extrapolate(x0_[k], tangent0_[k], x1_[k], tangent1_[k], past_, s, curved_);
    typename System::template Data<V> data;
    System::dataAt(homotopy_, t, data);
    const V first = firstNewtonStep(t, data, x);
    System::template evaluate<true>(homotopy_, t, data, x, rows);
    solveInPlace<pivoting>(rows);
    tangentFrom<System>(rows, x, tangent);
    const V second = newtonUpdate<System>(rows, x);

    const Mask<V> accepted = (first < square(options_.acceptFirst)) & (second < square(options_.acceptSecond));
    const V change = squareRoot(squareRoot(squareRoot(square(options_.tolerance) / first)));
    const V growth = smaller(larger(change, broadcast<V>(Scalar(0.25))),
                             select(accepted, broadcast<V>(Scalar(2.5)), broadcast<V>(Scalar(0.7))));
    step_ = smaller(step * growth, broadcast<V>(static_cast<Scalar>(options_.largestStep)));
    attempts_ += 1;
    const Mask<V> failed = (~accepted & (step_ < static_cast<Scalar>(options_.smallestStep))) |
                           (attempts_ >= static_cast<Scalar>(options_.attempts));
    t_ = select(accepted, t, t_);
    past_ = select(accepted, step, past_);
    curved_ = curved_ | accepted;
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k) {
      x0_[k] = select(accepted, x1_[k], x0_[k]);
      tangent0_[k] = select(accepted, tangent1_[k], tangent0_[k]);
      x1_[k] = select(accepted, x[k], x1_[k]);
      tangent1_[k] = select(accepted, tangent[k], tangent1_[k]);
    }
    const unsigned reached = bits(accepted & last), finished = (reached | bits(failed)) & active_;
    if (finished) replace(finished, reached);
  }

  V firstNewtonStep(V t, const typename System::template Data<V>& data, Complex<V> (&x)[N]) {
    Complex<V> rows[N][N + 1];
    System::template evaluate<false>(homotopy_, t, data, x, rows);
    solveInPlace<pivoting>(rows);
    return newtonUpdate<System>(rows, x);
  }

  void replace(unsigned finished, unsigned reached) {
    for (int lane = 0; lane < W; ++lane) {
      if (!(finished >> lane & 1)) continue;
      PathEnd<Scalar, N>& end = ends_[path_[lane]];
      storeLane(x1_, lane, end.point);
      end.attempts = static_cast<int>(attempts_[lane]);
      end.reached = reached >> lane & 1;
      load(lane);
    }
  }

  static Scalar square(double x) { return static_cast<Scalar>(x * x); }

  const Homotopy& homotopy_;
  const Point<Scalar, N>* starts_;
  const Point<Scalar, N>* tangents_;
  const int* paths_;
  int count_;
  int next_ = 0;  // of paths_
  TrackingOptions options_;
  PathEnd<Scalar, N>* ends_;

  // The last two accepted points.
  Complex<V> x0_[N] = {}, tangent0_[N] = {}, x1_[N] = {}, tangent1_[N] = {};
  V t_ = V{};                   // where the newer one is
  V step_ = V{};                // the step to try
  V past_ = V{} + 1;            // distance between the two
  Mask<V> curved_ = Mask<V>{};  // whether the older one is real
  V attempts_ = V{};
  int path_[W];
  unsigned active_ = 0;
};

// Newton steps at t on points[indices[..]]: until they are smaller than `enough` (relative), at most maxSteps. The last step's
// size to lastStep[indices[..]].
template <class System, class V, Pivoting pivoting, class Homotopy>
void newtonSteps(const Homotopy& homotopy, Real<V> t, Point<Real<V>, System::kUnknowns>* points, const int* indices, int count,
                 int maxSteps, Real<V> enough, Real<V>* lastStep) {
  constexpr int N = System::kUnknowns, W = LaneTraits<V>::kWidth;
  for (int first = 0; first < count; first += W) {
    Complex<V> x[N], rows[N][N + 1];
    typename System::template Data<V> data;
    loadLanes(points, indices + first, count - first, x);
    System::dataAt(homotopy, broadcast<V>(t), data);
    V size = V{};
    Mask<V> converged = Mask<V>{};
    for (int step = 0; step < maxSteps && bits(~converged); ++step) {
      System::template evaluate<false>(homotopy, broadcast<V>(t), data, x, rows);
      solveInPlace<pivoting>(rows);
      size = newtonUpdate<System>(rows, x);
      converged = size < enough * enough;
    }
    size = squareRoot(size);
    for (int lane = 0; lane < W && first + lane < count; ++lane) {
      storeLane(x, lane, points[indices[first + lane]]);
      lastStep[indices[first + lane]] = size[lane];
    }
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv

// P3P for the instruction set of the including file.
#pragma once

#include "solvers/known_focal/P3pDepths.hpp"
#include "solvers/known_focal/P3pKernel.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace HYBRIDGV_INSTRUCTION_SET {

template <class V>
struct Solution {
  Vec3<V> depths, position;
  Columns<V> rotation;
};

// The solution from such depths; the lanes that have one.
template <class V>
HYBRIDGV_INLINE Mask<V> solutionFrom(const Vec3<V>& depths, Mask<V> asked, const P3pEquations<V>& equations,
                                     const TrianglePose<V>& pose, Solution<V>& solution) {
  solution.depths = depths;
  solveExactly(equations, solution.depths);
  const V l[3] = {solution.depths.x, solution.depths.y, solution.depths.z};
  asked = allOf<Mask<V>>(asked, allOf<Mask<V>>(l[0] > 0, l[1] > 0, l[2] > 0));
  if (!any(asked)) return asked;
  return allOf(asked, pose.set(asked, l, solution.rotation, solution.position));
}

template <class V>
HYBRIDGV_INLINE Mask<V> isSame(const Vec3<V>& a, const Vec3<V>& b) {
  constexpr double kSame = 1e-7;  // depths that differ by less, relative, are those of one solution
  return squareOf(a - b) < kSame * kSame * squareOf(b);
}

HYBRIDGV_INLINE Vec3<double> lane(const Vec3<double>& v, int) { return v; }
HYBRIDGV_INLINE Vec3<double> lane(const Vec3<Pair>& v, int i) { return {v.x[i], v.y[i], v.z[i]}; }
HYBRIDGV_INLINE Columns<double> lane(const Columns<double>& v, int) { return v; }
HYBRIDGV_INLINE Columns<double> lane(const Columns<Pair>& v, int i) { return {lane(v.x, i), lane(v.y, i), lane(v.z, i)}; }
HYBRIDGV_INLINE bool isSet(bool mask, int) { return mask; }
HYBRIDGV_INLINE bool isSet(PairMask mask, int i) { return mask[i] != 0; }

HYBRIDGV_INLINE void storeMask(DoubleMask mask, bool* to) {
  const unsigned set = bits(mask);
  for (int i = 0; i < LaneTraits<Doubles>::kWidth; ++i) to[i] = ((set >> i) & 1) != 0;
}

template <class V, int N>
HYBRIDGV_INLINE void storeVector(double (&to)[3][N], int at, const Vec3<V>& v) {
  store(&to[0][at], v.x);
  store(&to[1][at], v.y);
  store(&to[2][at], v.z);
}

template <class V, int N>
HYBRIDGV_INLINE void storePose(const Columns<V>& rotation, const Vec3<V>& position, int n, int at, P3pSolutions<N>& solutions) {
  storeVector(solutions.column[n][0], at, rotation.x);
  storeVector(solutions.column[n][1], at, rotation.y);
  storeVector(solutions.column[n][2], at, rotation.z);
  storeVector(solutions.position[n], at, position);
}

template <class V, int N>
HYBRIDGV_INLINE TrianglePose<V> readTriangle(const P3pSamples<N>& samples, int at) {
  Vec3<V> points[3];
  V u[3], v[3];
  for (int i = 0; i < 3; ++i) {
    points[i] = {load<V>(&samples.point[i][0][at]), load<V>(&samples.point[i][1][at]), load<V>(&samples.point[i][2][at])};
    u[i] = load<V>(&samples.u[i][at]);
    v[i] = load<V>(&samples.v[i][at]);
  }
  return {points, u, v};
}

static void solveMany(const P3pSamples<kP3pSamples>& samples, P3pSolutions<kP3pSamples>& solutions) {
  constexpr int kWidth = LaneTraits<Doubles>::kWidth;
  for (int at = 0; at < kP3pSamples; at += kWidth) {
    const TrianglePose<Doubles> pose = readTriangle<Doubles>(samples, at);
    const P3pEquations<Doubles> equations(pose);
    const P3pDepths<Doubles> depths(pose, equations);
    Solution<Doubles> found[kP3pSolutions];
    DoubleMask isFound[kP3pSolutions] = {};
    for (int n = 0; n < kP3pSolutions; ++n) {
      if (any(depths.exists(n))) {
        isFound[n] = solutionFrom(depths[n], depths.exists(n), equations, pose, found[n]);
        for (int i = 0; i < n; ++i)
          if (any(isFound[i])) isFound[n] &= negated<DoubleMask>(isFound[i] & isSame(found[i].depths, found[n].depths));
      }
      if (any(isFound[n])) storePose(found[n].rotation, found[n].position, n, at, solutions);
      storeMask(isFound[n], &solutions.found[n][at]);
    }
  }
}

// The solutions of one sample.
class OneSample {
 public:
  OneSample(const P3pSamples<1>& sample, P3pSolutions<1>& solutions)
      : pose_(readTriangle<double>(sample, 0)), equations_(pose_), solutions_(solutions) {}

  // In two lanes, as long as there are two.
  void solve() {
    const P3pDepths<double> all(pose_, equations_);
    Vec3<double> depths[kP3pSolutions];
    int count = 0;
    for (int n = 0; n < kP3pSolutions; ++n)
      if (all.exists(n)) depths[count++] = all[n];
    int n = 0;
    if (count > 1) {
      const TrianglePose<Pair> pose(pose_);
      const P3pEquations<Pair> equations(equations_);
      for (; n + 1 < count; n += 2) {
        const Vec3<double>&a = depths[n], &b = depths[n + 1];
        addSolutions<Pair>({Pair{a.x, b.x}, Pair{a.y, b.y}, Pair{a.z, b.z}}, equations, pose, 2);
      }
    }
    if (n < count) addSolutions<double>(depths[n], equations_, pose_, 1);
    for (int k = 0; k < kP3pSolutions; ++k) solutions_.found[k][0] = k < count_;
  }

 private:
  template <class V>
  void addSolutions(const Vec3<V>& depths, const P3pEquations<V>& equations, const TrianglePose<V>& pose, int lanes) {
    Solution<V> solution;
    const Mask<V> found = solutionFrom(depths, V{} == V{}, equations, pose, solution);
    for (int i = 0; i < lanes; ++i) {
      if (!isSet(found, i) || isKnown(lane(solution.depths, i))) continue;
      depths_[count_] = lane(solution.depths, i);
      storePose(lane(solution.rotation, i), lane(solution.position, i), count_, 0, solutions_);
      ++count_;
    }
  }
  bool isKnown(const Vec3<double>& depths) const {
    for (int i = 0; i < count_; ++i)
      if (isSame(depths_[i], depths)) return true;
    return false;
  }

  const TrianglePose<double> pose_;
  const P3pEquations<double> equations_;
  P3pSolutions<1>& solutions_;
  Vec3<double> depths_[kP3pSolutions];
  int count_ = 0;
};

static void solveOne(const P3pSamples<1>& sample, P3pSolutions<1>& solutions) { OneSample(sample, solutions).solve(); }

extern const P3pKernel kP3pKernel;
const P3pKernel kP3pKernel = {&solveOne, &solveMany};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

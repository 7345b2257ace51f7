// The kernel's functions for the instruction set of the including file.
#pragma once

#include "math/dixon/DixonMatrix.hpp"
#include "math/dixon/Elimination.hpp"
#include "math/simd/Lanes.hpp"
#include "solvers/h32f/Kernel.hpp"

namespace hybridgv {
namespace solvers {
namespace h32f {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;

constexpr int kWidth = LaneTraits<Doubles>::kWidth;

// The 8x8 matrix at e. In tau = tan(psi / 2) the equations are K + s A + 2 s B tau + (K - s A) tau^2 = 0, s = sqrt(1 - e^2).
HYBRIDGV_INLINE void dixonMatrixAt(const Forms& f, Doubles e, Doubles (&m)[8][8]) {
  const Doubles w = (1 - e) * (1 + e), s = squareRoot(w), e2 = e * e, ew = e * w;
  Quadratic<Doubles> p[3];
  for (int b = 0; b < 3; ++b) {
    Doubles plus[3], middle[3], minus[3];
    for (int j = 0; j < 3; ++j) {
      const Doubles a = s * (f.a[b][0][j] + e * f.a[b][1][j] + e2 * f.a[b][2][j]);
      const Doubles k = f.k[b][0][j] + ew * f.k[b][1][j] + e2 * f.k[b][2][j];
      middle[j] = 2 * s * (f.b[b][0][j] + e * f.b[b][1][j] + e2 * f.b[b][2][j]);
      plus[j] = k + a;
      minus[j] = k - a;
    }
    p[0][b] = {plus[0], plus[1], plus[2]};
    p[1][b] = {middle[0], middle[1], middle[2]};
    p[2][b] = {minus[0], minus[1], minus[2]};
  }
  dixonMatrix(p, m);
}

static void determinants(const Forms& forms, const double* e, int count, double* determinant) {
  for (int i = 0; i < count; i += kWidth) {
    Doubles m[8][8];
    dixonMatrixAt(forms, load<Doubles>(e + i), m);
    store(determinant + i, eliminate(m));
  }
}

static void bernsteinCoefficients(const SampleTables& tables, const double* samples, PieceCoefficients& pieces) {
  double sum[kHalf], difference[kHalf];
  for (int k = 0; k < kHalf; ++k) {
    sum[k] = samples[k] + samples[k + kHalf];
    difference[k] = samples[k] - samples[k + kHalf];
  }
  for (int i = 0; i <= kDegree; ++i)
    for (int j = 0; j < kPieces; j += kWidth) {
      Doubles even{}, odd{};
      for (int k = 0; k < kHalf; ++k) {
        even += sum[k] * load<Doubles>(&tables.even[i][k][j]);
        odd += difference[k] * load<Doubles>(&tables.odd[i][k][j]);
      }
      store(&pieces.b[0][i][j], even + odd);
      store(&pieces.b[1][i][j], even - odd);
    }
  for (int side = 0; side < 2; ++side)
    for (int j = 0; j < kPieces; j += kWidth) {
      Doubles low = load<Doubles>(&pieces.b[side][0][j]), high = low;
      for (int i = 1; i <= kDegree; ++i) {
        const Doubles b = load<Doubles>(&pieces.b[side][i][j]);
        low = smaller(b, low);
        high = larger(b, high);
      }
      store(&pieces.low[side][j], low);
      store(&pieces.high[side][j], high);
    }
}

// Newton's method, kept inside the bracket [0, 1] that shrinks around the only root.
static void simpleRoots(const PowerForms& forms, int count, double* roots) {
  for (int j = 0; j < count; j += kWidth) {
    Doubles t = load<Doubles>(roots + j), low{}, high = broadcast<Doubles>(1);
    Doubles atOne{};
    for (int i = 0; i <= kDegree; ++i) atOne += load<Doubles>(&forms.c[i][j]);
    for (int iteration = 0; iteration < 40; ++iteration) {
      Doubles value = load<Doubles>(&forms.c[kDegree][j]), slope{};
      for (int i = kDegree - 1; i >= 0; --i) {
        slope = slope * t + value;
        value = value * t + load<Doubles>(&forms.c[i][j]);
      }
      const DoubleMask above = value * atOne > 0;
      high = select<Doubles>(above, t, high);
      low = select<Doubles>(above, low, t);
      const Doubles next = t - value / slope;
      const Doubles inside = select<Doubles>((next >= low) & (next <= high), next, (low + high) / 2);
      const Doubles step = absolute(inside - t);
      t = inside;
      if (!any(step > 1e-5)) break;
    }
    store(roots + j, t);
  }
}

// Secant method on the determinant, for roots that are known to a few digits.
static void polishRoots(const Forms& forms, int count, double* roots) {
  constexpr double kFirstStep = 1e-7, kLongestStep = 1e-3, kShortestStep = 1e-15;
  for (int i = 0; i < count; i += kWidth) {
    Doubles m[8][8];
    Doubles last = load<Doubles>(roots + i);
    // towards 0, so that |e| < 1
    Doubles e = last * (1 - kFirstStep);
    dixonMatrixAt(forms, last, m);
    Doubles lastValue = eliminate(m);
    for (int iteration = 0; iteration < 8; ++iteration) {
      dixonMatrixAt(forms, e, m);
      const Doubles value = eliminate(m);
      Doubles step = value * (last - e) / (value - lastValue);
      // neither far away nor beyond +-1; where the values are equal there is nothing left to gain
      const Doubles limit = smaller(broadcast<Doubles>(kLongestStep), (1 - absolute(e)) / 2);
      step = select<Doubles>(value == lastValue, Doubles{}, smaller(larger(step, -limit), limit));
      last = e;
      lastValue = value;
      e += step;
      if (!any(absolute(step) > kShortestStep)) break;
    }
    store(roots + i, e);
  }
}

static void nullVectors(const Forms& forms, int count, Candidates& candidates) {
  for (int i = 0; i < count; i += kWidth) {
    const Doubles e = load<Doubles>(candidates.e + i);
    Doubles m[8][8], v[8];
    dixonMatrixAt(forms, e, m);
    eliminate(m);
    nullVector(m, v);
    // v = (1, tau) x (1, delta, delta^2, delta^3); take each ratio where it is most accurate.
    const DoubleMask large = absolute(v[0]) + absolute(v[4]) < absolute(v[3]) + absolute(v[7]);
    const Doubles c = select<Doubles>(large, v[3], v[0]), s = select<Doubles>(large, v[7], v[4]);
    const DoubleMask sine = absolute(c) < absolute(s);
    const Doubles above = select<Doubles>(large, select<Doubles>(sine, v[7], v[3]), select<Doubles>(sine, v[5], v[1]));
    const Doubles below = select<Doubles>(large, select<Doubles>(sine, v[6], v[2]), select<Doubles>(sine, v[4], v[0]));
    const Doubles norm = 1 / (c * c + s * s);
    store(candidates.cosPsi + i, (c * c - s * s) * norm);
    store(candidates.sinPsi + i, 2 * c * s * norm);
    store(candidates.d + i, e * above / below);
  }
}

// a + b e + c e^2 and the like: value and derivatives of one of A, B, K of a ray with respect to e and d.
struct Derivatives {
  Doubles value, byE, byD;
};

// e sum_b a_b(e) (d/e)^b without a division: e a_0(e) + d a_1(e) + d^2 (a_2(e) / e).
HYBRIDGV_INLINE Derivatives evaluate(const double (&a)[3][3][3], int j, Doubles e, Doubles d) {
  const Doubles a0 = a[0][0][j] + e * a[0][1][j];
  const Doubles a1 = a[1][0][j] + e * (a[1][1][j] + e * a[1][2][j]);
  const Doubles a2 = a[2][1][j] + e * a[2][2][j];
  return {e * a0 + d * (a1 + d * a2), a0 + e * a[0][1][j] + d * (a[1][1][j] + 2 * e * a[1][2][j] + d * a[2][2][j]),
          a1 + 2 * d * a2};
}
// The same for K, whose middle coefficient belongs to e w.
HYBRIDGV_INLINE Derivatives evaluateK(const double (&k)[3][3][3], int j, Doubles e, Doubles w, Doubles d) {
  const Doubles e2 = e * e, slope = 1 - 3 * e2;  // of e w
  const Doubles k0 = k[0][0][j] + e2 * k[0][2][j];
  const Doubles k1 = k[1][0][j] + e * w * k[1][1][j] + e2 * k[1][2][j];
  const Doubles k2 = w * k[2][1][j] + e * k[2][2][j];
  return {e * k0 + d * (k1 + d * k2),
          k0 + 2 * e2 * k[0][2][j] + d * (slope * k[1][1][j] + 2 * e * k[1][2][j] + d * (k[2][2][j] - 2 * e * k[2][1][j])),
          k1 + 2 * d * k2};
}

static void newton(const Forms& forms, int count, Candidates& candidates) {
  constexpr double kLongestStep = 0.3, kConverged = 1e-9;
  for (int i = 0; i < count; i += kWidth) {
    Doubles e = load<Doubles>(candidates.e + i), d = load<Doubles>(candidates.d + i);
    Doubles c = load<Doubles>(candidates.cosPsi + i), s = load<Doubles>(candidates.sinPsi + i);
    Doubles size = broadcast<Doubles>(1);
    for (int iteration = 0; iteration < 12; ++iteration) {
      const Doubles w = (1 - e) * (1 + e), root = squareRoot(w), rootByE = -e / root;
      Vec3<Doubles> value, byE, byD, byPsi;
      const auto ray = [&](int j, Doubles& f, Doubles& fe, Doubles& fd, Doubles& fpsi) {
        const Derivatives a = evaluate(forms.a, j, e, d), b = evaluate(forms.b, j, e, d), k = evaluateK(forms.k, j, e, w, d);
        const Doubles along = a.value * c + b.value * s;
        f = root * along + k.value;
        fe = root * (a.byE * c + b.byE * s) + rootByE * along + k.byE;
        fd = root * (a.byD * c + b.byD * s) + k.byD;
        fpsi = root * (b.value * c - a.value * s);
      };
      ray(0, value.x, byE.x, byD.x, byPsi.x);
      ray(1, value.y, byE.y, byD.y, byPsi.y);
      ray(2, value.z, byE.z, byD.z, byPsi.z);
      // Cramer's rule for value + byE de + byD dd + byPsi dpsi = 0.
      const Vec3<Doubles> n = cross(byD, byPsi), q = cross(value, byE);
      const Doubles scale = -boundedReciprocal(dot(byE, n), 1e-300);
      Doubles de = dot(value, n) * scale, dd = -dot(byPsi, q) * scale, dpsi = dot(byD, q) * scale;
      const Doubles depth = 1 + absolute(d);
      size = larger(larger(absolute(de), absolute(dpsi)), absolute(dd) / depth);
      const Doubles shorten = select<Doubles>(size > kLongestStep, kLongestStep / size, broadcast<Doubles>(1));
      de *= shorten;
      dd *= shorten;
      dpsi *= shorten;
      // |e| < 1: go at most halfway to the bound
      const Doubles below = (-1 - e) / 2, above = (1 - e) / 2;
      e += smaller(larger(de, below), above);
      d += dd;
      const Doubles turnedC = c - s * dpsi, turnedS = s + c * dpsi;
      const Doubles length = 1 / squareRoot(turnedC * turnedC + turnedS * turnedS);
      c = turnedC * length;
      s = turnedS * length;
      if (!any(size > kConverged)) break;
    }
    store(candidates.e + i, e);
    store(candidates.d + i, d);
    store(candidates.cosPsi + i, c);
    store(candidates.sinPsi + i, s);
    store(candidates.step + i, size);
  }
}

extern const Kernel kKernel;
const Kernel kKernel = {&determinants, &bernsteinCoefficients, &simpleRoots, &polishRoots, &nullVectors, &newton};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv

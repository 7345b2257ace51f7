// Real roots of a binary form p(c, s) = sum_i a_i c^(D-i) s^i on the half circle of directions (c : s).
//
// The form is given by its values alone. It is sampled at the D+1 directions psi_j = j pi / (D+1), which fix it. On each arc
// between neighbours v0, v1 its Bernstein coefficients b, where
//
//     p((1-x) v0 + x v1) = sum_i b_i C(D,i) (1-x)^(D-i) x^i,   0 <= x <= 1,
//
// are one constant matrix times the cyclically shifted samples. By Descartes' rule the number of sign variations of b bounds the
// roots of the arc: none, one simple root (refined by a bracketed Newton iteration), or several (the arc is halved).
//
// Where the form is small all along a piece of an arc, its coefficients are inaccurate relative to their size: such a piece that
// may contain a root is sampled anew, at directions of its own. What remains uncertain is at the level tau = 1e-12 max|p_j| of
// rounding errors. Double roots, whose sign change that can hide, are reported wherever the form comes within tau of zero: a root
// of multiplicity m is returned as one or more directions near it. Whoever needs more digits refines the result with the
// equations behind the form.
//
// No allocation; the work is bounded for any input. A form that is zero everywhere, or whose samples are NaN, has no roots here.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "math/roots/Bernstein.hpp"
#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace math {

// A direction (c : s) of unit length; (c, s) and (-c, -s) are the same.
struct Direction {
  double c, s;
};

// The constants of degree D. `even` and `odd` give the interior Bernstein coefficients from sums and differences of the samples
// p(-m) and p(1+m), which lie symmetrically about the arc from psi_0 to psi_1:
//     b_i = sum_m even_im (p(-m) + p(1+m)) + sum_m odd_im (p(-m) - p(1+m)),   b_(D-i): the same with the odd sum subtracted.
template <int D>
struct BinaryFormTables {
  static constexpr int kSamples = D + 1;
  static constexpr int kPairs = (kSamples + 1) / 2;
  static constexpr int kPadded = 2 * kPairs;
  static constexpr int kRows = D / 2;               // i = 1 .. D/2
  static constexpr int kEven = (kSamples + 1) / 2;  // for even D the last is the sample opposite to the arc, alone
  static constexpr int kOdd = kSamples / 2;

  double c[kPadded], s[kPadded];  // directions of the samples; the last is repeated as padding
  double even[kRows][kEven], odd[kRows][kOdd];
  double binomial[D + 1];

  BinaryFormTables();
  static const BinaryFormTables& get() {
    static const BinaryFormTables tables;
    return tables;
  }
};

// Writes the (D+1) x (D+1) matrix (row-major) that turns the samples at psi_first .. psi_(first+D) into the Bernstein
// coefficients of the arc from psi_0 to psi_1.
void bernsteinMatrix(int degree, int first, double* matrix);

// x^exponent to some percent, for x >= 0: the bits of a double are, up to scale and offset, a piecewise linear logarithm.
inline double roughPower(double x, double exponent) {
  constexpr double kBitsOfOne = 1023.0 * (1ull << 52);
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = static_cast<std::int64_t>(kBitsOfOne + exponent * (static_cast<double>(bits) - kBitsOfOne));
  double result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

template <int D>
BinaryFormTables<D>::BinaryFormTables() {
  const double pi = 3.14159265358979323846;
  for (int j = 0; j < kPadded; ++j) {
    const double psi = std::min(j, D) * (pi / kSamples);
    c[j] = std::cos(psi);
    s[j] = std::sin(psi);
  }
  // Samples 1-kOdd .. kOdd pair up; for even D, 1+kOdd is left.
  const int first = 1 - kOdd;
  double matrix[kSamples * kSamples];
  bernsteinMatrix(D, first, matrix);
  for (int i = 1; i <= kRows; ++i) {
    const double* row = matrix + i * kSamples;
    for (int m = 0; m < kOdd; ++m) {
      even[i - 1][m] = (row[-m - first] + row[1 + m - first]) / 2;
      odd[i - 1][m] = (row[-m - first] - row[1 + m - first]) / 2;
    }
    if (kEven > kOdd) even[i - 1][kOdd] = row[1 + kOdd - first];
  }
  binomial[0] = 1;
  for (int i = 1; i <= D; ++i) binomial[i] = binomial[i - 1] * (D + 1 - i) / i;
}

template <int D>
class BinaryFormRoots {
 public:
  using Tables = BinaryFormTables<D>;
  static constexpr int kSamples = Tables::kSamples;
  static constexpr int kPadded = Tables::kPadded;
  // Room that `roots` must have. A form has at most D roots; some more are possible because uncertain ones are reported.
  static constexpr int kMaxRoots = 3 * D;

  // Writes the roots, ordered along the half circle (which may start anywhere), and returns their number.
  // sample(c, s, p) evaluates p[j] = p(c[j], s[j]) for j < kPadded at unit directions; only the first kSamples values are used.
  template <class Sample>
  static int findSampled(const Sample& sample, Direction* roots);

  // The same for a form that is evaluated at one direction at a time: double form(double c, double s).
  template <class Form>
  static int find(const Form& form, Direction* roots) {
    return findSampled(
        [&](const double* c, const double* s, double* p) {
          for (int j = 0; j < kSamples; ++j) p[j] = form(c[j], s[j]);
        },
        roots);
  }

  // The roots on the arc from v0 to v1, two directions less than 180 degrees apart, in order along it.
  template <class Sample>
  static int findSampledBetween(const Sample& sample, const Direction& v0, const Direction& v1, Direction* roots) {
    return Search<Sample>(sample, roots).run(v0, v1);
  }

 private:
  // Uncertainty of the samples, relative to the largest.
  static constexpr double kTau = 1e-12;
  // A piece is sampled anew where the form is smaller than this share of the largest sample, at most kMaxLevel times over.
  static constexpr double kFaint = 1e-7;
  static constexpr int kMaxLevel = 3;
  static constexpr int kMaxSamplings = 3 * D;
  // 2^-14 of an arc is the shortest piece.
  static constexpr int kMaxDepth = 14;

  // Part of an arc: p((1-x) (c0,s0) + x (c1,s1)) has the Bernstein coefficients b.
  struct Piece {
    double b[D + 1];
    double c0, s0, c1, s1;
    int depth;
    // Bit i: the coefficients i and i+1 have different signs, zero counting as positive.
    unsigned signChanges() const;
    int smallest() const;
    bool isBelow(double bound) const;             // all |b_i| < bound
    void halve(Piece& left, Piece& right) const;  // right may be the piece itself
  };

  // Simple roots that wait for refinement: several together take hardly longer than one.
  class SimpleRoots {
   public:
    // A piece with one sign change, whose root is to be written to `root`.
    void add(const Piece& piece, unsigned signChanges, Direction* root);
    void refine();

   private:
    template <int Pairs>
    void refinePairs();

    static constexpr int kPairs = 4;
    int count_ = 0;
    Direction* roots_[2 * kPairs];
    double c0_[2 * kPairs], s0_[2 * kPairs], c1_[2 * kPairs], s1_[2 * kPairs];
    double start_[2 * kPairs];
    double coefficients_[D + 1][2 * kPairs];
  };

  template <class Sample>
  class Search {
   public:
    Search(const Sample& sample, Direction* roots) : sample_(sample), roots_(roots) {}
    int run();
    int run(const Direction& v0, const Direction& v1);

   private:
    void between(const Direction& v0, const Direction& v1, int level);
    template <int ArcCount>
    void arcs(const double* p, const double* c, const double* s, int level);
    void pieces(const Piece& arc, int level);
    void anew(const Piece& piece, int level);
    void add(double c, double s);

    const Sample& sample_;
    Direction* roots_;
    int count_ = 0;
    int samplings_ = 0;
    SimpleRoots simple_;
  };

  static double secondSmallest(const double* p);
  static void spread(const double* p, double smallToLarge, double* c, double* s);
  static void normalize(const double* c, const double* s, double* unitC, double* unitS, double* length);
  static void scale(double* p, const double* length);
};

// ---------------------------------------------------------------------------------------------------------------------------

template <int D>
template <class Sample>
int BinaryFormRoots<D>::findSampled(const Sample& sample, Direction* roots) {
  return Search<Sample>(sample, roots).run();
}

template <int D>
template <class Sample>
int BinaryFormRoots<D>::Search<Sample>::run() {
  const Tables& tables = Tables::get();
  double p[kPadded];
  sample_(tables.c, tables.s, p);
  double largest = 0;
  for (int j = 0; j < kSamples; ++j) largest = std::max(largest, std::abs(p[j]));
  const double ratio = secondSmallest(p) / largest;
  if (!(ratio < 1e-4)) {
    arcs<kSamples>(p, tables.c, tables.s, 0);
  } else {
    double c[kPadded], s[kPadded], unitC[kPadded], unitS[kPadded], length[kPadded];
    spread(p, ratio, c, s);
    normalize(c, s, unitC, unitS, length);
    sample_(unitC, unitS, p);
    scale(p, length);
    arcs<kSamples>(p, c, s, 0);
  }
  simple_.refine();
  return count_;
}

template <int D>
double BinaryFormRoots<D>::secondSmallest(const double* p) {
  double first = std::abs(p[0]), second = std::abs(p[1]);
  if (second < first) std::swap(first, second);
  for (int j = 2; j < kSamples; ++j) {
    const double value = std::abs(p[j]);
    second = std::min(second, std::max(first, value));
    first = std::min(first, value);
  }
  return second;
}

// Where samples differ by orders of magnitude, the roots crowd around one direction, and the small samples are inaccurate
// relative to their size. |p|^(2/D) ~ A + B cos 2psi + C sin 2psi finds that direction; (c, s) is drawn towards it by a linear
// map Rot(axis) diag(sqrt(k), 1/sqrt(k)) of the plane, in whose coordinates the samples are of similar size.
template <int D>
void BinaryFormRoots<D>::spread(const double* p, double smallToLarge, double* c, double* s) {
  const Tables& tables = Tables::get();
  double cos2 = 0, sin2 = 0;
  for (int j = 0; j < kSamples; ++j) {
    const double weight = roughPower(std::abs(p[j]), 2.0 / D);
    cos2 += weight * (tables.c[j] * tables.c[j] - tables.s[j] * tables.s[j]);
    sin2 += weight * (2 * tables.c[j] * tables.s[j]);
  }
  // half the angle of (cos2, sin2)
  const double length = std::sqrt(cos2 * cos2 + sin2 * sin2);
  const double axisC = std::sqrt(std::max(0.0, (length + cos2) / (2 * length)));
  const double axisS = std::copysign(std::sqrt(std::max(0.0, (length - cos2) / (2 * length))), sin2);
  const double rootK = std::sqrt(std::max(0.03, roughPower(smallToLarge, 1.0 / D)));
  for (int j = 0; j < kPadded; ++j) {
    const double x = tables.c[j] * rootK, y = tables.s[j] / rootK;
    c[j] = axisC * x - axisS * y;
    s[j] = axisS * x + axisC * y;
  }
}

template <int D>
void BinaryFormRoots<D>::normalize(const double* c, const double* s, double* unitC, double* unitS, double* length) {
  for (int j = 0; j < kPadded; ++j) {
    length[j] = std::sqrt(c[j] * c[j] + s[j] * s[j]);
    const double inverse = 1 / length[j];
    unitC[j] = c[j] * inverse;
    unitS[j] = s[j] * inverse;
  }
}

// p(length v) = length^D p(v)
template <int D>
void BinaryFormRoots<D>::scale(double* p, const double* length) {
  for (int j = 0; j < kSamples; ++j) {
    double power = length[j];
    for (int i = 1; i < D; ++i) power *= length[j];
    p[j] *= power;
  }
}

template <int D>
template <class Sample>
int BinaryFormRoots<D>::Search<Sample>::run(const Direction& v0, const Direction& v1) {
  between(v0, v1, 0);
  simple_.refine();
  return count_;
}

// Samples the form at D+1 directions v = alpha v0 + beta v1 of which the first few lie between v0 and v1, which may have any
// lengths: a linear map takes the arc from psi_0 to psi_kArcs to the one between them.
template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::between(const Direction& v0, const Direction& v1, int level) {
  const Tables& tables = Tables::get();
  constexpr int kArcs = kSamples / 2;
  const double cEnd = tables.c[kArcs], sEnd = tables.s[kArcs];
  double c[kPadded], s[kPadded], unitC[kPadded], unitS[kPadded], length[kPadded], p[kPadded];
  for (int j = 0; j < kPadded; ++j) {
    const double beta = tables.s[j] / sEnd, alpha = tables.c[j] - beta * cEnd;
    c[j] = alpha * v0.c + beta * v1.c;
    s[j] = alpha * v0.s + beta * v1.s;
  }
  normalize(c, s, unitC, unitS, length);
  ++samplings_;
  sample_(unitC, unitS, p);
  scale(p, length);
  arcs<kArcs>(p, c, s, level);
}

template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::anew(const Piece& piece, int level) {
  const int before = count_;
  between({piece.c0, piece.s0}, {piece.c1, piece.s1}, level + 1);
  if (count_ == before) {
    const int i = piece.smallest();
    add((D - i) * piece.c0 + i * piece.c1, (D - i) * piece.s0 + i * piece.s1);
  }
}

// The samples p_j at v_j = (c_j, s_j) = M (cos psi_j, sin psi_j), M any linear map; searches the first arcs.
template <int D>
template <class Sample>
template <int ArcCount>
void BinaryFormRoots<D>::Search<Sample>::arcs(const double* p, const double* c, const double* s, int level) {
  constexpr int kPairs = (ArcCount + 1) / 2, kEven = Tables::kEven, kOdd = Tables::kOdd;
  constexpr double kWrap = D % 2 ? -1 : 1;  // p(-v) / p(v)
  const Tables& tables = Tables::get();
  double largest = 0;
  for (int j = 0; j < kSamples; ++j) largest = std::max(largest, std::abs(p[j]));
  if (!(largest > 0)) return;
  double q[3 * kSamples + 1];  // q[kSamples + j] = p_j, also beyond the half circle; the largest is 1
  for (int j = 0; j < kSamples; ++j) {
    q[kSamples + j] = p[j] / largest;
    q[j] = q[2 * kSamples + j] = kWrap * q[kSamples + j];
  }
  q[3 * kSamples] = q[kSamples];

  // Row i: coefficient i of all arcs, arc j from sample j to j+1.
  Pair b[D + 1][kPairs], sum[kEven][kPairs], difference[kOdd][kPairs];
  for (int k = 0; k < kPairs; ++k) {
    const double* center = q + kSamples + 2 * k;
    b[0][k] = load<Pair>(center);
    b[D][k] = load<Pair>(center + 1);
    for (int m = 0; m < kOdd; ++m) {
      const Pair before = load<Pair>(center - m), after = load<Pair>(center + 1 + m);
      sum[m][k] = before + after;
      difference[m][k] = before - after;
    }
    if (kEven > kOdd) sum[kEven - 1][k] = load<Pair>(center + 1 + kOdd);
  }
  for (int i = 1; i <= Tables::kRows; ++i) {
    Pair symmetric[kPairs] = {}, antisymmetric[kPairs] = {};
    for (int m = 0; m < kEven; ++m)
      for (int k = 0; k < kPairs; ++k) symmetric[k] += tables.even[i - 1][m] * sum[m][k];
    for (int m = 0; m < kOdd; ++m)
      for (int k = 0; k < kPairs; ++k) antisymmetric[k] += tables.odd[i - 1][m] * difference[m][k];
    for (int k = 0; k < kPairs; ++k) {
      b[i][k] = symmetric[k] + antisymmetric[k];
      b[D - i][k] = symmetric[k] - antisymmetric[k];
    }
  }
  double low[2 * kPairs], high[2 * kPairs];
  for (int k = 0; k < kPairs; ++k) {
    Pair least = b[0][k], greatest = b[0][k];
    for (int i = 1; i <= D; ++i) {
      least = smaller(least, b[i][k]);
      greatest = larger(greatest, b[i][k]);
    }
    store(low + 2 * k, least);
    store(high + 2 * k, greatest);
  }

  for (int j = 0; j < ArcCount; ++j) {
    if (low[j] >= kTau || high[j] <= -kTau) continue;  // no root
    Piece arc;
    for (int i = 0; i <= D; ++i) arc.b[i] = b[i][j / 2][j % 2];
    const int next = j + 1 < kSamples ? j + 1 : 0;
    const double sign = next ? 1 : -1;
    arc.c0 = c[j];
    arc.s0 = s[j];
    arc.c1 = sign * c[next];
    arc.s1 = sign * s[next];
    arc.depth = 0;
    if (arc.signChanges() == 0 && !(level < kMaxLevel && arc.isBelow(kFaint))) {
      // Perhaps a double root that rounding has lifted off zero: lower the form by the uncertainty.
      const double shift = low[j] + high[j] > 0 ? kTau : -kTau;
      for (double& coefficient : arc.b) coefficient -= shift;
    }
    pieces(arc, level);
  }
}

template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::pieces(const Piece& arc, int level) {
  const bool maySample = level < kMaxLevel && samplings_ < kMaxSamplings;
  // Halving in order, depth first: the stack holds at most one piece of each depth.
  Piece stack[kMaxDepth + 2];
  stack[0] = arc;
  int size = 1;
  while (size > 0) {
    const Piece& piece = stack[--size];
    const unsigned changes = piece.signChanges();
    if (changes == 0) {
      const int i = piece.smallest();
      if (!(std::abs(piece.b[i]) < kTau)) continue;
      if (maySample && piece.isBelow(kFaint)) {
        anew(piece, level);
      } else if (piece.depth > 0) {
        add((D - i) * piece.c0 + i * piece.c1, (D - i) * piece.s0 + i * piece.s1);
      }
    } else if (maySample && piece.isBelow(kFaint)) {
      anew(piece, level);
    } else if ((changes & (changes - 1)) == 0) {
      if (count_ < kMaxRoots) simple_.add(piece, changes, roots_ + count_++);
    } else if (piece.depth == kMaxDepth) {
      add(piece.c0 + piece.c1, piece.s0 + piece.s1);
    } else {
      piece.halve(stack[size + 1], stack[size]);
      size += 2;
    }
  }
}

template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::add(double c, double s) {
  if (count_ == kMaxRoots) return;
  const double scale = 1 / std::sqrt(c * c + s * s);
  roots_[count_++] = {c * scale, s * scale};
}

// ---------------------------------------------------------------------------------------------------------------------------

template <int D>
unsigned BinaryFormRoots<D>::Piece::signChanges() const {
  unsigned negative = 0;
  for (int i = 0; i <= D; ++i) {
    const unsigned isNegative = b[i] < 0;
    negative |= isNegative << i;
  }
  return (negative ^ (negative >> 1)) & ((1u << D) - 1);
}

template <int D>
int BinaryFormRoots<D>::Piece::smallest() const {
  int best = 0;
  for (int i = 1; i <= D; ++i)
    if (std::abs(b[i]) < std::abs(b[best])) best = i;
  return best;
}

template <int D>
bool BinaryFormRoots<D>::Piece::isBelow(double bound) const {
  for (int i = 0; i <= D; ++i)
    if (!(std::abs(b[i]) < bound)) return false;
  return true;
}

template <int D>
void BinaryFormRoots<D>::Piece::halve(Piece& left, Piece& right) const {
  math::halve<D>(b, left.b, right.b);
  left.c0 = c0;
  left.s0 = s0;
  right.c1 = c1;
  right.s1 = s1;
  left.c1 = right.c0 = (left.c0 + right.c1) / 2;
  left.s1 = right.s0 = (left.s0 + right.s1) / 2;
  left.depth = right.depth = depth + 1;
}

// With x = t / (1 + t) the direction is v0 + t v1 and the form is the polynomial sum_i C(D,i) b_i t^i, times (1 + t)^-D. A root
// beyond t = 1 is sought from the other end.
template <int D>
void BinaryFormRoots<D>::SimpleRoots::add(const Piece& piece, unsigned signChanges, Direction* root) {
  const Tables& tables = Tables::get();
  if (count_ == 2 * kPairs) refine();
  const int lane = count_++;
  double a[D + 1], middle = 0;
  for (int i = 0; i <= D; ++i) middle += a[i] = tables.binomial[i] * piece.b[i];
  int i = 0;  // the control polygon crosses zero between i and i+1
  while (signChanges >> (i + 1)) ++i;
  const double x = (i + piece.b[i] / (piece.b[i] - piece.b[i + 1])) / D;
  const bool reversed = (middle < 0) == (piece.b[i] < 0);
  const double t = reversed ? (1 - x) / x : x / (1 - x);
  start_[lane] = t < 1 ? t : 1;
  roots_[lane] = root;
  c0_[lane] = reversed ? piece.c1 : piece.c0;
  s0_[lane] = reversed ? piece.s1 : piece.s0;
  c1_[lane] = reversed ? piece.c0 : piece.c1;
  s1_[lane] = reversed ? piece.s0 : piece.s1;
  // positive at t = 1
  const double sign = middle < 0 ? -1 : 1;
  for (int k = 0; k <= D; ++k) coefficients_[k][lane] = sign * a[reversed ? D - k : k];
}

template <int D>
void BinaryFormRoots<D>::SimpleRoots::refine() {
  if (count_ > 4)
    refinePairs<kPairs>();
  else if (count_ > 0)
    refinePairs<2>();
}

// Halley's method in the first lanes, each in a bracket of its own.
template <int D>
template <int Pairs>
void BinaryFormRoots<D>::SimpleRoots::refinePairs() {
  for (int lane = count_; lane < 2 * Pairs; ++lane) {
    start_[lane] = start_[0];
    for (int k = 0; k <= D; ++k) coefficients_[k][lane] = coefficients_[k][0];
  }
  Pair t[Pairs], low[Pairs], high[Pairs];
  for (int j = 0; j < Pairs; ++j) {
    t[j] = load<Pair>(&start_[2 * j]);
    low[j] = Pair{0, 0};
    high[j] = Pair{1, 1};
  }
  for (int iteration = 0; iteration < 60; ++iteration) {
    Pair value[Pairs], slope[Pairs], curvature[Pairs], step{0, 0};  // curvature: half the second derivative
    for (int j = 0; j < Pairs; ++j) {
      value[j] = load<Pair>(coefficients_[D] + 2 * j);
      slope[j] = curvature[j] = Pair{0, 0};
    }
    for (int k = D - 1; k >= 0; --k)
      for (int j = 0; j < Pairs; ++j) {
        curvature[j] = curvature[j] * t[j] + slope[j];
        slope[j] = slope[j] * t[j] + value[j];
        value[j] = value[j] * t[j] + load<Pair>(coefficients_[k] + 2 * j);
      }
    for (int j = 0; j < Pairs; ++j) {
      high[j] = value[j] > 0 ? t[j] : high[j];
      low[j] = value[j] > 0 ? low[j] : t[j];
      Pair next = t[j] - value[j] * slope[j] / (slope[j] * slope[j] - value[j] * curvature[j]);
      next = next >= low[j] ? next : (low[j] + high[j]) / 2;
      next = next <= high[j] ? next : (low[j] + high[j]) / 2;
      step = larger(step, absolute(next - t[j]));
      t[j] = next;
    }
    if (step[0] < 1e-4 && step[1] < 1e-4) break;
  }
  double root[2 * Pairs];
  for (int j = 0; j < Pairs; ++j) store(&root[2 * j], t[j]);
  for (int lane = 0; lane < count_; ++lane) {
    const double c = c0_[lane] + root[lane] * c1_[lane], s = s0_[lane] + root[lane] * s1_[lane];
    const double scale = 1 / std::sqrt(c * c + s * s);
    *roots_[lane] = {c * scale, s * scale};
  }
  count_ = 0;
}

}  // namespace math
}  // namespace hybridgv

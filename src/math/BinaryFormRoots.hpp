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

#include "math/Bernstein.hpp"

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
  static constexpr int kPadded = (kSamples + 1) / 2 * 2;  // room for loops over pairs
  static constexpr int kRows = D / 2;                     // i = 1 .. D/2
  static constexpr int kEven = (kSamples + 1) / 2;        // for even D the last is the sample opposite to the arc, alone
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

template <int D>
BinaryFormTables<D>::BinaryFormTables() {
  const double pi = 3.14159265358979323846;
  for (int j = 0; j < kPadded; ++j) {
    const double psi = std::min(j, D) * (pi / kSamples);
    c[j] = std::cos(psi), s[j] = std::sin(psi);
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

 private:
  // Part of an arc: p((1-x) (c0,s0) + x (c1,s1)) has the Bernstein coefficients b.
  struct Piece {
    double b[D + 1];
    double c0, s0, c1, s1;
    int depth;
  };
  template <class Sample>
  struct Search {
    const Sample& sample;
    Direction* roots;
    int count;
    int samplings;  // how often the form may still be sampled

    void add(double c, double s);
    void arcs(const double* p, const double* c, const double* s, int arcCount, int level);
    void arc(Piece& arc, double largest, int level);
    void anew(const Piece& piece, int level);
  };
  // Uncertainty of the samples, relative to the largest.
  static constexpr double kTau = 1e-12;
  // 2^-14 of an arc is the shortest piece.
  static constexpr int kMaxDepth = 14;
  // A piece is sampled anew where the form is smaller than this share of the largest sample.
  static constexpr double kFaint = 1e-7;
  static constexpr int kMaxLevel = 3;
  static constexpr int kMaxSamplings = 3 * D;

  static double secondSmallest(const double* p);
  static void spread(const double* p, double smallToLarge, double* c, double* s);
  static int variations(const double* b);
  static int smallest(const double* b);
  static double largest(const double* b);
  static void halve(const Piece& piece, Piece& left, Piece& right);
  static double simpleRoot(const double* b, bool& reversed);
};

// ---------------------------------------------------------------------------------------------------------------------------

template <int D>
template <class Sample>
int BinaryFormRoots<D>::findSampled(const Sample& sample, Direction* roots) {
  const Tables& tables = Tables::get();
  double p[kPadded];
  sample(tables.c, tables.s, p);
  Search<Sample> search{sample, roots, 0, kMaxSamplings};
  double largest = 0;
  for (int j = 0; j < kSamples; ++j) largest = std::max(largest, std::abs(p[j]));
  const double ratio = secondSmallest(p) / largest;
  if (!(ratio < 1e-4)) {
    search.arcs(p, tables.c, tables.s, kSamples, 0);
    return search.count;
  }
  double c[kPadded], s[kPadded], length[kPadded];
  spread(p, ratio, c, s);
  for (int j = 0; j < kPadded; ++j) {
    length[j] = std::sqrt(c[j] * c[j] + s[j] * s[j]);
    c[j] /= length[j], s[j] /= length[j];
  }
  sample(c, s, p);
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < D; ++i) p[j] *= length[j];
    c[j] *= length[j], s[j] *= length[j];
  }
  search.arcs(p, c, s, kSamples, 0);
  return search.count;
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
    const double weight = std::pow(std::abs(p[j]), 2.0 / D);
    cos2 += weight * (tables.c[j] * tables.c[j] - tables.s[j] * tables.s[j]);
    sin2 += weight * (2 * tables.c[j] * tables.s[j]);
  }
  const double axis = std::atan2(sin2, cos2) / 2, axisC = std::cos(axis), axisS = std::sin(axis);
  const double rootK = std::sqrt(std::max(0.03, std::pow(smallToLarge, 1.0 / D)));
  for (int j = 0; j < kPadded; ++j) {
    const double x = tables.c[j] * rootK, y = tables.s[j] / rootK;
    c[j] = axisC * x - axisS * y, s[j] = axisS * x + axisC * y;
  }
}

template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::add(double c, double s) {
  if (count == kMaxRoots) return;
  const double scale = 1 / std::sqrt(c * c + s * s);
  roots[count++] = {c * scale, s * scale};
}

// Samples the form at D+1 directions v = alpha v0 + beta v1 of which the first few lie on the piece from v0 to v1: a linear map
// takes the arc from psi_0 to psi_kArcs to the piece.
template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::anew(const Piece& piece, int level) {
  const Tables& tables = Tables::get();
  constexpr int kArcs = kSamples / 2;
  --samplings;
  const double cEnd = tables.c[kArcs], sEnd = tables.s[kArcs];
  double c[kPadded], s[kPadded], unitC[kPadded], unitS[kPadded], length[kPadded], p[kPadded];
  for (int j = 0; j < kPadded; ++j) {
    const double beta = tables.s[j] / sEnd, alpha = tables.c[j] - tables.s[j] * cEnd / sEnd;
    c[j] = alpha * piece.c0 + beta * piece.c1, s[j] = alpha * piece.s0 + beta * piece.s1;
    length[j] = std::sqrt(c[j] * c[j] + s[j] * s[j]);
    unitC[j] = c[j] / length[j], unitS[j] = s[j] / length[j];
  }
  sample(unitC, unitS, p);
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < D; ++i) p[j] *= length[j];
  const int before = count;
  arcs(p, c, s, kArcs, level + 1);
  if (count == before) {
    const int i = smallest(piece.b);
    add((D - i) * piece.c0 + i * piece.c1, (D - i) * piece.s0 + i * piece.s1);
  }
}

// The samples p_j at v_j = (c_j, s_j) = M (cos psi_j, sin psi_j), M any linear map; searches the first `arcCount` arcs.
template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::arcs(const double* p, const double* c, const double* s, int arcCount, int level) {
  const Tables& tables = Tables::get();
  constexpr double kWrap = D % 2 ? -1 : 1;  // p(-v) / p(v)
  double q[3 * kSamples];                   // q[kSamples + j] = p_j, also beyond the half circle
  double largest = 0;
  for (int j = 0; j < kSamples; ++j) {
    q[kSamples + j] = p[j];
    q[j] = q[2 * kSamples + j] = kWrap * p[j];
    largest = std::max(largest, std::abs(p[j]));
  }
  const double tau = kTau * largest;

  double b[D + 1][kPadded];  // column j: coefficients of the arc from sample j to j+1
  double low[kPadded], high[kPadded];
  const double* center = q + kSamples;
  for (int j = 0; j < kSamples; ++j) b[0][j] = center[j], b[D][j] = center[j + 1];
  double sum[Tables::kEven][kPadded], difference[Tables::kOdd][kPadded];
  for (int m = 0; m < Tables::kOdd; ++m)
    for (int j = 0; j < kSamples; ++j) {
      sum[m][j] = center[j - m] + center[j + 1 + m];
      difference[m][j] = center[j - m] - center[j + 1 + m];
    }
  if (Tables::kEven > Tables::kOdd)
    for (int j = 0; j < kSamples; ++j) sum[Tables::kEven - 1][j] = center[j + 1 + Tables::kOdd];
  for (int i = 1; i <= Tables::kRows; ++i) {
    double symmetric[kPadded] = {}, antisymmetric[kPadded] = {};
    for (int m = 0; m < Tables::kEven; ++m)
      for (int j = 0; j < kSamples; ++j) symmetric[j] += tables.even[i - 1][m] * sum[m][j];
    for (int m = 0; m < Tables::kOdd; ++m)
      for (int j = 0; j < kSamples; ++j) antisymmetric[j] += tables.odd[i - 1][m] * difference[m][j];
    for (int j = 0; j < kSamples; ++j) b[i][j] = symmetric[j] + antisymmetric[j], b[D - i][j] = symmetric[j] - antisymmetric[j];
  }
  for (int j = 0; j < kSamples; ++j) low[j] = high[j] = b[0][j];
  for (int i = 1; i <= D; ++i)
    for (int j = 0; j < kSamples; ++j) {
      low[j] = b[i][j] < low[j] ? b[i][j] : low[j];
      high[j] = b[i][j] > high[j] ? b[i][j] : high[j];
    }

  for (int j = 0; j < arcCount; ++j) {
    if (low[j] >= tau || high[j] <= -tau) continue;  // no root
    Piece arc;
    for (int i = 0; i <= D; ++i) arc.b[i] = b[i][j];
    const int next = j + 1 < kSamples ? j + 1 : 0;
    const double sign = next ? 1 : -1;
    arc.c0 = c[j], arc.s0 = s[j], arc.c1 = sign * c[next], arc.s1 = sign * s[next], arc.depth = 0;
    this->arc(arc, largest, level);
  }
}

template <int D>
template <class Sample>
void BinaryFormRoots<D>::Search<Sample>::arc(Piece& arc, double largestSample, int level) {
  const double tau = kTau * largestSample, faint = level < kMaxLevel ? kFaint * largestSample : 0;
  if (variations(arc.b) == 0 && largest(arc.b) >= faint) {
    // Perhaps a double root that rounding has lifted off zero: lower the form by the uncertainty.
    double sum = 0;
    for (double b : arc.b) sum += b;
    for (double& b : arc.b) b -= std::copysign(tau, sum);
  }
  // Halving in order, depth first: the stack holds at most one piece of each depth.
  Piece stack[kMaxDepth + 2];
  int size = 0;
  stack[size++] = arc;
  while (size > 0) {
    const Piece piece = stack[--size];
    const int changes = variations(piece.b);
    const int least = smallest(piece.b);
    if (changes == 0 && std::abs(piece.b[least]) >= tau) continue;
    if (largest(piece.b) < faint && samplings > 0) {
      anew(piece, level);
    } else if (changes == 1) {
      bool reversed = false;
      const double t = simpleRoot(piece.b, reversed);
      if (reversed)
        add(t * piece.c0 + piece.c1, t * piece.s0 + piece.s1);
      else
        add(piece.c0 + t * piece.c1, piece.s0 + t * piece.s1);
    } else if (changes == 0) {
      if (piece.depth > 0) add((D - least) * piece.c0 + least * piece.c1, (D - least) * piece.s0 + least * piece.s1);
    } else if (piece.depth == kMaxDepth) {
      add(piece.c0 + piece.c1, piece.s0 + piece.s1);
    } else {
      halve(piece, stack[size + 1], stack[size]);
      size += 2;
    }
  }
}

// Sign changes of the sequence, zeros left out.
template <int D>
int BinaryFormRoots<D>::variations(const double* b) {
  int count = 0;
  double last = b[0];
  for (int i = 1; i <= D; ++i) {
    if (b[i] == 0) continue;
    if (last != 0 && (b[i] < 0) != (last < 0)) ++count;
    last = b[i];
  }
  return count;
}

template <int D>
int BinaryFormRoots<D>::smallest(const double* b) {
  int best = 0;
  for (int i = 1; i <= D; ++i)
    if (std::abs(b[i]) < std::abs(b[best])) best = i;
  return best;
}

template <int D>
double BinaryFormRoots<D>::largest(const double* b) {
  double best = 0;
  for (int i = 0; i <= D; ++i) best = std::max(best, std::abs(b[i]));
  return best;
}

template <int D>
void BinaryFormRoots<D>::halve(const Piece& piece, Piece& left, Piece& right) {
  math::halve<D>(piece.b, left.b, right.b);
  left.c0 = piece.c0, left.s0 = piece.s0, right.c1 = piece.c1, right.s1 = piece.s1;
  left.c1 = right.c0 = (piece.c0 + piece.c1) / 2, left.s1 = right.s0 = (piece.s0 + piece.s1) / 2;
  left.depth = right.depth = piece.depth + 1;
}

// The only root of a piece, as t in [0, 1]: the direction is v0 + t v1, or t v0 + v1 if `reversed`. In t = x / (1-x) the form is
// the polynomial sum_i C(D,i) b_i t^i.
template <int D>
double BinaryFormRoots<D>::simpleRoot(const double* b, bool& reversed) {
  const Tables& tables = Tables::get();
  double a[D + 1];
  double middle = 0;
  for (int i = 0; i <= D; ++i) middle += a[i] = tables.binomial[i] * b[i];
  int first = 0;
  while (b[first] == 0) ++first;
  reversed = (middle > 0) == (b[first] > 0);
  if (reversed) std::reverse(a, a + D + 1);
  // start: where the control polygon crosses zero
  int i = first + 1;
  while (i < D && (b[i] > 0) == (b[first] > 0)) ++i;
  const double x = (i - b[i] / (b[i] - b[i - 1])) / D;
  double t = reversed ? (1 - x) / x : x / (1 - x);
  if (!(t <= 1)) t = 1;
  double low = 0, high = 1;
  const bool risingAtHigh = middle > 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    double value = a[D], slope = 0;
    for (int k = D - 1; k >= 0; --k) slope = slope * t + value, value = value * t + a[k];
    ((value > 0) == risingAtHigh ? high : low) = t;
    double next = t - value / slope;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const double step = std::abs(next - t);
    t = next;
    if (step < 1e-6) break;
  }
  return t;
}

}  // namespace math
}  // namespace hybridgv

#include "solvers/h32f/HiddenRoots.hpp"

#include <algorithm>
#include <cmath>

#include "math/BernsteinBand.hpp"

namespace hybridgv {
namespace solvers {
namespace hidden_variable {

namespace {

constexpr int kPadded = kSamples + 4;
// Samples of which this share is noise are those of R = 0.
constexpr double kNoNoise = 1e-4;
// More halvings, or more new samplings, mean that y is zero there up to rounding.
constexpr int kMaxDepth = 16;
constexpr int kMaxLevel = 2;
constexpr int kMaxResamplings = 24;

// y on the interval between e0 and e1 in Bernstein form.
struct Piece {
  double b[kDegree + 1];
  double e0, e1;
  double tolerance;
  int depth, level;  // halvings, new samplings
};

class Search {
 public:
  Search(const Forms& forms, const Kernel& kernel, double* e)
      : forms_(forms), kernel_(kernel), tables_(SampleTables::get()), e_(e) {}

  int run();

 private:
  void search(const Piece& whole);
  void addSimpleRoot(const Piece& piece);
  void addUncertain(double e);
  bool resample(Piece& piece);

  const Forms& forms_;
  const Kernel& kernel_;
  const SampleTables& tables_;
  double* e_;
  int count_ = 0, resamplings_ = 0;
  // Simple roots are refined together at the end.
  PowerForms simple_;
  double start_[kBatch], from_[kBatch], to_[kBatch];
  int simpleCount_ = 0;
};

int Search::run() {
  double samples[kPadded];
  kernel_.determinants(forms_, tables_.nodes, kSamples, samples);
  double largest = 0, noise = 0;
  for (int i = 0; i < kSamples; ++i) {
    samples[i] *= tables_.factors[i];
    largest = std::max(largest, std::abs(samples[i]));
  }
  for (int i = 0; i < kHalf; ++i) noise += tables_.noiseWeights[i] * (samples[i] - samples[i + kHalf]);
  if (!(std::abs(noise) < kNoNoise * largest)) return 0;
  const double tolerance = 1e-12 * largest + 30 * std::abs(noise);

  PieceCoefficients pieces;
  kernel_.bernsteinCoefficients(tables_, samples, pieces);
  for (int side = 0; side < 2; ++side)
    for (int j = 0; j < kPieces; ++j) {
      const auto& coefficients = side ? pieces.negative : pieces.positive;
      double low = coefficients[0][j], high = low;
      for (int i = 1; i <= kDegree; ++i) low = std::min(low, coefficients[i][j]), high = std::max(high, coefficients[i][j]);
      // Beyond the last sample the interpolant is extrapolated.
      const double band = j == kPieces - 1 ? 20 * tolerance : tolerance;
      if (low > band || high < -band) continue;
      Piece piece;
      for (int i = 0; i <= kDegree; ++i) piece.b[i] = coefficients[i][j];
      const double sign = side ? -1 : 1;
      piece.e0 = sign * tables_.breakpoints[j], piece.e1 = sign * tables_.breakpoints[j + 1];
      piece.tolerance = band, piece.depth = piece.level = 0;
      search(piece);
    }
  for (int i = simpleCount_; i % 8 != 0; ++i) {
    for (int k = 0; k <= kDegree; ++k) simple_.c[k][i] = simple_.c[k][i - 1];
    start_[i] = start_[i - 1];
  }
  kernel_.simpleRoots(simple_, simpleCount_, start_);
  for (int i = 0; i < simpleCount_; ++i) {
    const double t = start_[i];
    addUncertain((from_[i] + t * to_[i]) / (1 + t));
  }
  return count_;
}

void Search::search(const Piece& whole) {
  // Depth first: at most one piece of every depth waits.
  Piece stack[kMaxDepth * (kMaxLevel + 1) + 2];
  int size = 0;
  stack[size++] = whole;
  while (size > 0) {
    Piece piece = stack[--size];
    const math::SignChanges changes = math::signChanges<kDegree>(piece.b, piece.tolerance);
    if (changes.most == 0) continue;
    if (changes.least == 1 && changes.most == 1) {
      addSimpleRoot(piece);
      continue;
    }
    double largest = 0;
    for (double b : piece.b) largest = std::max(largest, std::abs(b));
    if (largest < 8 * piece.tolerance && resample(piece)) {
      stack[size++] = piece;
    } else if (largest < 8 * piece.tolerance || piece.depth == kMaxDepth) {
      addUncertain((piece.e0 + piece.e1) / 2);
    } else {
      Piece& right = stack[size];
      Piece& left = stack[size + 1];
      right = left = piece;
      math::halve<kDegree>(piece.b, left.b, right.b);
      left.e1 = right.e0 = (piece.e0 + piece.e1) / 2;
      ++left.depth, ++right.depth;
      size += 2;
    }
  }
}

// t = x / (1-x), or (1-x) / x for a root in the second half, turns the Bernstein form into sum_i C(D,i) b_i t^i, 0 <= t <= 1.
void Search::addSimpleRoot(const Piece& piece) {
  if (simpleCount_ == kBatch) return;
  double c[kDegree + 1], middle = 0;
  for (int i = 0; i <= kDegree; ++i) middle += c[i] = tables_.binomial[i] * piece.b[i];
  // where the control polygon crosses zero
  int i = 1;
  while (i < kDegree && (piece.b[i] > 0) == (piece.b[0] > 0)) ++i;
  const double x = (i - piece.b[i] / (piece.b[i] - piece.b[i - 1])) / kDegree;
  const bool secondHalf = (middle > 0) == (piece.b[0] > 0);
  const int n = simpleCount_++;
  for (int k = 0; k <= kDegree; ++k) simple_.c[k][n] = secondHalf ? c[kDegree - k] : c[k];
  start_[n] = std::min(1.0, secondHalf ? (1 - x) / x : x / (1 - x));
  from_[n] = secondHalf ? piece.e1 : piece.e0;
  to_[n] = secondHalf ? piece.e0 : piece.e1;
}

void Search::addUncertain(double e) {
  if (count_ < kBatch) e_[count_++] = e;
}

bool Search::resample(Piece& piece) {
  if (piece.level == kMaxLevel || resamplings_ == kMaxResamplings) return false;
  ++resamplings_;
  double e[2 * 8], y[2 * 8];
  for (int k = 0; k < 16; ++k) e[k] = piece.e0 + (piece.e1 - piece.e0) * tables_.chebyshev[std::min(k, kDegree)];
  kernel_.determinants(forms_, e, kDegree + 1, y);
  double largest = 0;
  for (int k = 0; k <= kDegree; ++k) {
    y[k] *= SampleTables::factor(e[k]);
    largest = std::max(largest, std::abs(y[k]));
  }
  for (int i = 0; i <= kDegree; ++i) {
    piece.b[i] = 0;
    for (int k = 0; k <= kDegree; ++k) piece.b[i] += tables_.fromChebyshev[i][k] * y[k];
  }
  piece.tolerance = 1e-13 * largest;
  piece.depth = 0;
  ++piece.level;
  return true;
}

}  // namespace

int hiddenRoots(const Forms& forms, const Kernel& kernel, double* e) { return Search(forms, kernel, e).run(); }

}  // namespace hidden_variable
}  // namespace solvers
}  // namespace hybridgv

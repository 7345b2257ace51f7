#include "solvers/h32f/HiddenRoots.hpp"

#include <algorithm>
#include <cmath>

#include "math/roots/Bernstein.hpp"

namespace hybridgv {
namespace solvers {
namespace h32f {

namespace {

constexpr int kPadded = kSamples + 4;
// Samples of which this share is noise are those of R = 0.
constexpr double kAllNoise = 1e-4;
// More halvings, or more new samplings, mean that y is zero there up to rounding.
constexpr int kMaxDepth = 16;
constexpr int kMaxLevel = 2;
constexpr int kMaxResamplings = 40;

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
  bool sample(double* y, double& tolerance) const;
  void searchPiece(const double (&coefficients)[kDegree + 1][kPieces], int j, double sign, double tolerance);
  void search(const Piece& whole);
  bool resample(Piece& piece);
  void addSimpleRoot(const Piece& piece);
  void refineSimpleRoots();
  void add(double e) {
    if (count_ < kBatch) e_[count_++] = e;
  }

  const Forms& forms_;
  const Kernel& kernel_;
  const SampleTables& tables_;
  double* e_;
  int count_ = 0, resamplings_ = 0;
  // Simple roots are refined together at the end. Root t means e = (from + t to) / (1 + t).
  PowerForms simple_;
  double start_[kBatch], from_[kBatch], to_[kBatch];
  int simpleCount_ = 0;
};

int Search::run() {
  double y[kPadded], tolerance;
  if (!sample(y, tolerance)) return 0;
  PieceCoefficients pieces;
  kernel_.bernsteinCoefficients(tables_, y, pieces);
  for (int j = 0; j < kPieces; ++j) {
    // Beyond the last sample the interpolant is extrapolated.
    const double band = j == kPieces - 1 ? 20 * tolerance : tolerance;
    for (int side = 0; side < 2; ++side)
      if (!(pieces.low[side][j] > band || pieces.high[side][j] < -band)) searchPiece(pieces.b[side], j, side ? -1 : 1, band);
  }
  refineSimpleRoots();
  return count_;
}

// The samples and the uncertainty of their interpolant. False if they are noise.
bool Search::sample(double* y, double& tolerance) const {
  kernel_.determinants(forms_, tables_.nodes, kSamples, y);
  double largest = 0, leading = 0;
  for (int i = 0; i < kSamples; ++i) {
    y[i] *= tables_.factors[i];
    largest = std::max(largest, std::abs(y[i]));
  }
  for (int i = 0; i < kHalf; ++i) leading += tables_.noiseWeights[i] * (y[i] - y[i + kHalf]);
  const double noise = std::abs(leading);
  tolerance = 1e-12 * largest + 30 * noise;
  return noise < kAllNoise * largest;
}

void Search::searchPiece(const double (&coefficients)[kDegree + 1][kPieces], int j, double sign, double tolerance) {
  Piece piece;
  for (int i = 0; i <= kDegree; ++i) piece.b[i] = coefficients[i][j];
  piece.e0 = sign * tables_.breakpoints[j];
  piece.e1 = sign * tables_.breakpoints[j + 1];
  piece.tolerance = tolerance;
  piece.depth = piece.level = 0;
  search(piece);
}

void Search::refineSimpleRoots() {
  if (simpleCount_ == 0) return;
  for (int i = simpleCount_; i % 8 != 0; ++i) {
    for (auto& coefficient : simple_.c) coefficient[i] = coefficient[i - 1];
    start_[i] = start_[i - 1];
  }
  kernel_.simpleRoots(simple_, simpleCount_, start_);
  for (int i = 0; i < simpleCount_; ++i) add((from_[i] + start_[i] * to_[i]) / (1 + start_[i]));
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
      add((piece.e0 + piece.e1) / 2);
    } else {
      Piece& right = stack[size];
      Piece& left = stack[size + 1];
      right = left = piece;
      math::halve<kDegree>(piece.b, left.b, right.b);
      left.e1 = right.e0 = (piece.e0 + piece.e1) / 2;
      ++left.depth;
      ++right.depth;
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

bool Search::resample(Piece& piece) {
  if (piece.level == kMaxLevel || resamplings_ == kMaxResamplings) return false;
  ++resamplings_;
  double e[2 * 8], y[2 * 8];
  for (int k = 0; k < 16; ++k) e[k] = piece.e0 + (piece.e1 - piece.e0) * tables_.chebyshev[std::min(k, kDegree)];
  kernel_.determinants(forms_, e, kDegree + 1, y);
  double largest = 0, tail[2] = {};
  for (int k = 0; k <= kDegree; ++k) {
    y[k] *= SampleTables::factor(e[k]);
    largest = std::max(largest, std::abs(y[k]));
    for (int i : {0, 1}) tail[i] += tables_.tail[i][k] * y[k];
  }
  for (int i = 0; i <= kDegree; ++i) {
    piece.b[i] = 0;
    for (int k = 0; k <= kDegree; ++k) piece.b[i] += tables_.fromChebyshev[i][k] * y[k];
  }
  // Where y has many roots it is no polynomial of this degree on the piece; the last coefficients show how far it is from one.
  piece.tolerance = 1e-13 * largest + std::abs(tail[0]) + std::abs(tail[1]);
  piece.depth = 0;
  ++piece.level;
  return true;
}

}  // namespace

int hiddenRoots(const Forms& forms, const Kernel& kernel, double* e) { return Search(forms, kernel, e).run(); }

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv

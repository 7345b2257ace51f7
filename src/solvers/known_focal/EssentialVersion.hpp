// The ten cubics of EssentialForm and their elimination, for the instruction set of the including file.
#pragma once

#include "math/simd/Lanes.hpp"
#include "solvers/known_focal/EssentialKernel.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;

constexpr int kVariables = 4, kQuadratics = 10, kCubics = 20, kEquations = 10, kEliminated = 10, kForwardOnly = 4;

// Four numbers: a row of E and one more, or the coefficients of the four variables. No function returns it: how, depends on the
// instruction set.
using Four = double __attribute__((vector_size(32)));
HYBRIDGV_INLINE void load(const double* from, Four& to) { __builtin_memcpy(&to, from, sizeof to); }

// xx xy xz xw yy yz yw zz zw ww
constexpr int kQuadratic[kVariables][kVariables] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};
// Of such a monomial times x, y, z, w, in the order  xxx xxy xyy yyy  xxz xxw xyz xyw yyz yyw  xzz xzw xww yzz yzw yww zzz zzw zww www.
constexpr int kCubic[kQuadratics][kVariables] = {{0, 1, 4, 5},     {1, 2, 6, 7},    {4, 6, 10, 11}, {5, 7, 11, 12},
                                                 {2, 3, 8, 9},     {6, 8, 13, 14},  {7, 9, 14, 15}, {10, 13, 16, 17},
                                                 {11, 14, 17, 18}, {12, 15, 18, 19}};

// The other way round: the products of a quadratic monomial and a variable that make a cubic one, at most three.
struct Products {
  int count, quadratic[3], variable[3];
};
struct ProductTable {
  Products of[kCubics] = {};

  constexpr ProductTable() {
    for (int m = 0; m < kQuadratics; ++m)
      for (int n = 0; n < kVariables; ++n) {
        Products& products = of[kCubic[m][n]];
        products.quadratic[products.count] = m;
        products.variable[products.count++] = n;
      }
  }
};
constexpr ProductTable kProducts;

// The entry (i, j) of E as a linear form.
struct Entries {
  const EssentialBasis& basis;

  // Of one variable, in row i; the last lane does not count.
  HYBRIDGV_INLINE void row(int i, int variable, Four& to) const { load(basis[variable] + 3 * i, to); }
  HYBRIDGV_INLINE double at(int i, int j, int variable) const { return basis[variable][3 * i + j]; }
  HYBRIDGV_INLINE void ofVariables(int i, int j, Four& to) const {
    to = Four{at(i, j, 0), at(i, j, 1), at(i, j, 2), at(i, j, 3)};
  }
};

struct Quadratic {
  double q[kQuadratics];

  HYBRIDGV_INLINE void add(double factor, const Quadratic& other) {
    for (int m = 0; m < kQuadratics; ++m) q[m] += factor * other.q[m];
  }
  // The products of the variable a with all four.
  HYBRIDGV_INLINE void add(int a, const Four& products) {
    for (int b = 0; b < kVariables; ++b) q[kQuadratic[a][b]] += products[b];
  }
};

// (E E^T)_ij
HYBRIDGV_INLINE Quadratic rowProduct(const Entries& E, int i, int j) {
  Four first, second, third;
  E.ofVariables(j, 0, first);
  E.ofVariables(j, 1, second);
  E.ofVariables(j, 2, third);
  Quadratic result{};
  for (int a = 0; a < kVariables; ++a) result.add(a, E.at(i, 0, a) * first + E.at(i, 1, a) * second + E.at(i, 2, a) * third);
  return result;
}

// E_1j E_2k - E_1k E_2j
HYBRIDGV_INLINE Quadratic minorOf(const Entries& E, int j, int k) {
  Four first, second;
  E.ofVariables(2, k, first);
  E.ofVariables(2, j, second);
  Quadratic result{};
  for (int a = 0; a < kVariables; ++a) result.add(a, E.at(1, j, a) * first - E.at(1, k, a) * second);
  return result;
}

// Ten equations, a row each, over the twenty monomials.
class Cubics {
 public:
  HYBRIDGV_INLINE explicit Cubics(const Entries& E) {
    Quadratic products[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) products[i][j] = products[j][i] = rowProduct(E, i, j);
    Quadratic trace = products[0][0];
    trace.add(1, products[1][1]);
    trace.add(1, products[2][2]);
    for (int i = 0; i < 3; ++i) products[i][i].add(-0.5, trace);
    for (int i = 0; i < 3; ++i) addRowsOf(products[i], E, i);
    addDeterminant(E);
  }

  // Gauss elimination with row pivots: the first four columns forward only, then the next six completely, in the last six rows. Returns
  // the least pivot.
  HYBRIDGV_INLINE double eliminate() {
    leastPivot_ = 1;
    eliminateFrom<0>();
    return leastPivot_;
  }

  HYBRIDGV_INLINE double at(int r, int column) const { return row_[r][column / 4][column % 4]; }

 private:
  static constexpr int kFours = kCubics / 4;

  // The coefficients of the cubic monomials in sum_k Q_k E_kj, a lane per j, the index of each known to the compiler.
  template <int C>
  HYBRIDGV_INLINE static void sumProductsFrom(const Quadratic (&Q)[3], const Entries& E, Four (&sums)[kCubics]) {
    constexpr Products products = kProducts.of[C];
    Four sum{};
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < products.count; ++l) {
        Four row;
        E.row(k, products.variable[l], row);
        sum += Q[k].q[products.quadratic[l]] * row;
      }
    sums[C] = sum;
    if constexpr (C + 1 < kCubics) sumProductsFrom<C + 1>(Q, E, sums);
  }

  // The three equations sum_k Q_k E_kj.
  HYBRIDGV_INLINE void addRowsOf(const Quadratic (&Q)[3], const Entries& E, int i) {
    Four sums[kCubics];
    sumProductsFrom<0>(Q, E, sums);
    for (int j = 0; j < 3; ++j)
      for (int p = 0; p < kFours; ++p)
        row_[3 * i + j][p] = Four{sums[4 * p][j], sums[4 * p + 1][j], sums[4 * p + 2][j], sums[4 * p + 3][j]};
  }

  HYBRIDGV_INLINE void addDeterminant(const Entries& E) {
    double sums[kCubics] = {};
    for (int j = 0; j < 3; ++j) {
      const Quadratic minor = minorOf(E, (j + 1) % 3, (j + 2) % 3);
      for (int m = 0; m < kQuadratics; ++m)
        for (int n = 0; n < kVariables; ++n) sums[kCubic[m][n]] += minor.q[m] * E.at(0, j, n);
    }
    for (int p = 0; p < kFours; ++p) load(sums + 4 * p, row_[kEquations - 1][p]);
  }

  template <int Column>
  HYBRIDGV_INLINE void eliminateFrom() {
    int pivot = Column;
    for (int r = Column + 1; r < kEquations; ++r)
      if (absolute(at(r, Column)) > absolute(at(pivot, Column))) pivot = r;
    const double value = at(pivot, Column);
    leastPivot_ = smaller(absolute(value), leastPivot_);
    if (!(leastPivot_ > 0)) {
      leastPivot_ = 0;
      return;
    }
    // The part of the row that is still needed.
    constexpr int kFirst = Column / 4;
    const double inverse = 1 / value;
    Four normalized[kFours];
    for (int p = kFirst; p < kFours; ++p) {
      normalized[p] = inverse * row_[pivot][p];
      row_[pivot][p] = row_[Column][p];
      row_[Column][p] = normalized[p];
    }
    for (int r = Column < kForwardOnly ? Column + 1 : kForwardOnly; r < kEquations; ++r) {
      if (r == Column) continue;
      const double factor = at(r, Column);
      for (int p = kFirst; p < kFours; ++p) row_[r][p] -= factor * normalized[p];
    }
    if constexpr (Column + 1 < kEliminated) eliminateFrom<Column + 1>();
  }

  Four row_[kEquations][kFours];
  double leastPivot_;
};

static void reduce(const EssentialBasis& basis, ReducedCubics& result) {
  Cubics cubics(Entries{basis});
  result.leastPivot = cubics.eliminate();
  for (int r = 0; r < ReducedCubics::kRows; ++r)
    for (int k = 0; k < ReducedCubics::kColumns; ++k) result.row[r][k] = cubics.at(kForwardOnly + r, kEliminated + k);
}

extern const EssentialKernel kEssentialKernel;
const EssentialKernel kEssentialKernel = {&reduce};

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

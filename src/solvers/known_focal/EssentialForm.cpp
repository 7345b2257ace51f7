#include "solvers/known_focal/EssentialForm.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace {

using math::Pair;

constexpr int kVariables = 4, kQuadratics = 10, kCubics = 20, kEquations = 10, kEliminated = 10, kForwardOnly = 4;

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

// The entry (i, j) of E as a linear form: e[i][variable][j], padded, and ofVariables[i][j][variable].
struct Entries {
  Pair e[3][kVariables][2], ofVariables[3][3][kVariables / 2];

  explicit Entries(const PaddedMatrix* basis) {
    for (int i = 0; i < 3; ++i)
      for (int n = 0; n < kVariables; ++n) {
        e[i][n][0] = Pair{basis[n][3 * i], basis[n][3 * i + 1]};
        e[i][n][1] = Pair{basis[n][3 * i + 2], 0};
      }
    for (int i = 0; i < 9; ++i)
      for (int n = 0; n < kVariables; n += 2) ofVariables[i / 3][i % 3][n / 2] = Pair{basis[n][i], basis[n + 1][i]};
  }
  double at(int i, int n, int j) const { return e[i][n][j / 2][j % 2]; }
};

struct Quadratic {
  double q[kQuadratics] = {};

  void add(double factor, const Quadratic& other) {
    for (int m = 0; m < kQuadratics; ++m) q[m] += factor * other.q[m];
  }
};

// (E E^T)_ij
Quadratic rowProduct(const Entries& E, int i, int j) {
  Quadratic result;
  for (int a = 0; a < kVariables; ++a) {
    Pair sums[2] = {{0, 0}, {0, 0}};  // for the four variables b
    for (int k = 0; k < 3; ++k) {
      const double factor = E.at(i, a, k);
      sums[0] += factor * E.ofVariables[j][k][0];
      sums[1] += factor * E.ofVariables[j][k][1];
    }
    for (int b = 0; b < kVariables; ++b) result.q[kQuadratic[a][b]] += sums[b / 2][b % 2];
  }
  return result;
}

// E_1j E_2k - E_1k E_2j
Quadratic minorOf(const Entries& E, int j, int k) {
  Quadratic result;
  for (int a = 0; a < kVariables; ++a)
    for (int b = 0; b < kVariables; ++b)
      result.q[kQuadratic[a][b]] += E.at(1, a, j) * E.at(2, b, k) - E.at(1, a, k) * E.at(2, b, j);
  return result;
}

// Ten equations, a row each, over the twenty monomials.
class Cubics {
 public:
  explicit Cubics(const Entries& E) {
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
  double eliminate() {
    leastPivot_ = 1;
    eliminateFrom<0>();
    return leastPivot_;
  }

  double at(int r, int column) const { return row_[r][column / 2][column % 2]; }

 private:
  static constexpr int kPairs = kCubics / 2;

  // The coefficients of the cubic monomials in sum_k Q_k E_kj, the index of each known to the compiler.
  template <int... C>
  static void sumProducts(const Quadratic (&Q)[3], const Entries& E, Pair (&sums)[kCubics][2], std::integer_sequence<int, C...>) {
    (sumProductsOf<C>(Q, E, sums[C]), ...);
  }
  template <int C>
  static void sumProductsOf(const Quadratic (&Q)[3], const Entries& E, Pair (&sum)[2]) {
    constexpr Products products = kProducts.of[C];
    sum[0] = sum[1] = Pair{0, 0};
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < products.count; ++l) {
        const double factor = Q[k].q[products.quadratic[l]];
        sum[0] += factor * E.e[k][products.variable[l]][0];
        sum[1] += factor * E.e[k][products.variable[l]][1];
      }
  }

  // The three equations sum_k Q_k E_kj.
  void addRowsOf(const Quadratic (&Q)[3], const Entries& E, int i) {
    Pair sums[kCubics][2];
    sumProducts(Q, E, sums, std::make_integer_sequence<int, kCubics>());
    for (int j = 0; j < 3; ++j)
      for (int p = 0; p < kPairs; ++p) row_[3 * i + j][p] = Pair{sums[2 * p][j / 2][j % 2], sums[2 * p + 1][j / 2][j % 2]};
  }

  void addDeterminant(const Entries& E) {
    double sums[kCubics] = {};
    for (int j = 0; j < 3; ++j) {
      const Quadratic minor = minorOf(E, (j + 1) % 3, (j + 2) % 3);
      for (int m = 0; m < kQuadratics; ++m)
        for (int n = 0; n < kVariables; ++n) sums[kCubic[m][n]] += minor.q[m] * E.at(0, n, j);
    }
    for (int p = 0; p < kPairs; ++p) row_[kEquations - 1][p] = Pair{sums[2 * p], sums[2 * p + 1]};
  }

  template <int Column>
  void eliminateFrom() {
    int pivot = Column;
    for (int r = Column + 1; r < kEquations; ++r)
      if (std::abs(at(r, Column)) > std::abs(at(pivot, Column))) pivot = r;
    const double value = at(pivot, Column);
    leastPivot_ = std::min(leastPivot_, std::abs(value));
    if (!(leastPivot_ > 0)) {
      leastPivot_ = 0;
      return;
    }
    // The part of the row that is still needed.
    constexpr int kFirst = Column / 2;
    const double inverse = 1 / value;
    Pair normalized[kPairs];
    for (int p = kFirst; p < kPairs; ++p) {
      normalized[p] = inverse * row_[pivot][p];
      row_[pivot][p] = row_[Column][p];
    }
    for (int r = Column < kForwardOnly ? Column + 1 : kForwardOnly; r < kEquations; ++r) {
      if (r == Column) continue;
      const double factor = at(r, Column);
      for (int p = kFirst; p < kPairs; ++p) row_[r][p] -= factor * normalized[p];
    }
    std::copy(normalized + kFirst, normalized + kPairs, row_[Column] + kFirst);
    if constexpr (Column + 1 < kEliminated) eliminateFrom<Column + 1>();
  }

  Pair row_[kEquations][kPairs];
  double leastPivot_;
};

}  // namespace

bool EssentialForm::set(const PaddedMatrix* basis) {
  Cubics cubics{Entries(basis)};
  leastPivot_ = cubics.eliminate();
  if (!(leastPivot_ > 0)) return false;
  for (int i = 0; i < 3; ++i) {
    // The two rows, with the coefficients of the last ten monomials.
    const auto A = [&](int k) { return cubics.at(kForwardOnly + 2 * i, kEliminated + k); };
    const auto B = [&](int k) { return cubics.at(kForwardOnly + 2 * i + 1, kEliminated + k); };
    Equation& equation = equations_[i];
    for (int k = 0; k < 4; ++k) {
      equation.a[k] = (k > 0 ? A(k - 1) : 0) - (k < 3 ? B(k) : 0);
      equation.b[k] = (k > 0 ? A(k + 2) : 0) - (k < 3 ? B(k + 3) : 0);
    }
    for (int k = 0; k < 5; ++k) equation.c[k] = (k > 0 ? A(k + 5) : 0) - (k < 4 ? B(k + 6) : 0);
  }
  return true;
}

template <class T>
EssentialForm::Row<T> EssentialForm::row(int i, const T& z, const T& w) const {
  const Equation& e = equations_[i];
  const T zz = z * z, zw = z * w, ww = w * w;
  return {z * (zz * e.a[0] + zw * e.a[1] + ww * e.a[2]) + ww * w * e.a[3],
          z * (zz * e.b[0] + zw * e.b[1] + ww * e.b[2]) + ww * w * e.b[3],
          zz * (zz * e.c[0] + zw * e.c[1] + ww * e.c[2]) + ww * (zw * e.c[3] + ww * e.c[4])};
}

math::Pair EssentialForm::value(const math::Pair& z, const math::Pair& w) const {
  const Row<Pair> p = row(0, z, w), q = row(1, z, w), r = row(2, z, w);
  return p.a * (q.b * r.c - q.c * r.b) + p.b * (q.c * r.a - q.a * r.c) + p.c * (q.a * r.b - q.b * r.a);
}

// Of the three rows, which are dependent at a root, every two have the solution as their cross product.
void EssentialForm::coordinates(double z, double w, double (&result)[4]) const {
  const Row<double> rows[3] = {row(0, z, w), row(1, z, w), row(2, z, w)};
  double sum[3] = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const Row<double>&p = rows[i], &q = rows[(i + 1) % 3];
    const double n[3] = {p.b * q.c - p.c * q.b, p.c * q.a - p.a * q.c, p.a * q.b - p.b * q.a};
    const double sign = n[0] * sum[0] + n[1] * sum[1] + n[2] * sum[2] < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) sum[k] += sign * n[k];
  }
  result[0] = sum[0];
  result[1] = sum[1];
  result[2] = sum[2] * z;
  result[3] = sum[2] * w;
}

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv

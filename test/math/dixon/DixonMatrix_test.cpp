#include "math/dixon/DixonMatrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "Random.hpp"

namespace hybridgv {
namespace test {
namespace {

using math::dixonMatrix;
using math::Quadratic;

// Three polynomials sum c_ab tau^a delta^b of degree 2 in both.
struct Polynomials {
  Quadratic<double> c[3];

  explicit Polynomials(Random& random) {
    for (auto& row : c)
      for (auto& v : row) v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  }
  Eigen::Vector3d operator()(double tau, double delta) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) sum += std::pow(tau, a) * std::pow(delta, b) * Eigen::Vector3d(c[a][b].x, c[a][b].y, c[a][b].z);
    return sum;
  }
  Eigen::Matrix<double, 8, 8> matrix() const {
    double m[8][8];
    dixonMatrix(c, m);
    return Eigen::Map<Eigen::Matrix<double, 8, 8, Eigen::RowMajor>>(&m[0][0]);
  }
};

Eigen::Matrix<double, 8, 1> columnMonomials(double tau, double delta) {
  Eigen::Matrix<double, 8, 1> v;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 4; ++b) v[4 * a + b] = std::pow(tau, a) * std::pow(delta, b);
  return v;
}

// With the sign of the rows as they are stored.
Eigen::Matrix<double, 8, 1> rowMonomials(double sigma, double epsilon) {
  Eigen::Matrix<double, 8, 1> v;
  for (int s = 0; s < 4; ++s)
    for (int p = 0; p < 2; ++p) v[2 * s + p] = (s < 2 ? 1 : -1) * std::pow(sigma, s) * std::pow(epsilon, p);
  return v;
}

TEST(DixonMatrix, IsTheMatrixOfTheDefiningQuotient) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(testSeed(), i);
    const Polynomials f(random);
    const Eigen::Matrix<double, 8, 8> m = f.matrix();
    const double tau = random.uniform(-2, 2), delta = random.uniform(-2, 2), sigma = tau + random.uniform(0.5, 2),
                 epsilon = delta - random.uniform(0.5, 2);
    Eigen::Matrix3d rows;
    rows << f(tau, delta), f(sigma, delta), f(sigma, epsilon);
    const double expected = -rows.determinant() / ((tau - sigma) * (delta - epsilon));
    const double value = rowMonomials(sigma, epsilon).dot(m * columnMonomials(tau, delta));
    const double scale = rowMonomials(sigma, epsilon).cwiseAbs().dot(m.cwiseAbs() * columnMonomials(tau, delta).cwiseAbs());
    EXPECT_NEAR(value, expected, 1e-13 * scale) << "instance " << i;
  }
}

TEST(DixonMatrix, HasTheCommonRootAsItsNullVector) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(testSeed(), i);
    Polynomials f(random);
    const double tau = random.uniform(-2, 2), delta = random.uniform(-2, 2);
    const Eigen::Vector3d value = f(tau, delta);
    f.c[0][0].x -= value[0];
    f.c[0][0].y -= value[1];
    f.c[0][0].z -= value[2];
    const Eigen::Matrix<double, 8, 8> m = f.matrix();
    const Eigen::Matrix<double, 8, 1> v = columnMonomials(tau, delta);
    EXPECT_LT((m * v).norm(), 1e-13 * m.norm() * v.norm()) << "instance " << i;
  }
}

TEST(DixonMatrix, IsRegularWithoutACommonRoot) {
  Random random(testSeed());
  const Eigen::Matrix<double, 8, 8> m = Polynomials(random).matrix();
  EXPECT_GT(std::abs(m.determinant()), 1e-12 * m.rowwise().norm().prod());
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

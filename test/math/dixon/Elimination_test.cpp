#include "math/dixon/Elimination.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "Random.hpp"

namespace hybridgv {
namespace test {
namespace {

using math::Doubles;

constexpr int kLanes = math::LaneTraits<Doubles>::kWidth;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

Matrix8 randomMatrix(Random& random) {
  Matrix8 m;
  for (int i = 0; i < 64; ++i) m(i / 8, i % 8) = random.uniform(-1, 1);
  return m;
}

void setLane(const Matrix8& matrix, int lane, Doubles (&m)[8][8]) {
  for (int r = 0; r < 8; ++r)
    for (int c = 0; c < 8; ++c) m[r][c][lane] = matrix(r, c);
}

TEST(Elimination, GivesTheDeterminantOfEveryLane) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(testSeed(), i);
    Doubles m[8][8];
    double expected[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      Matrix8 matrix = randomMatrix(random);
      matrix(0, 0) = 0;  // so that rows must be exchanged
      expected[lane] = matrix.determinant();
      setLane(matrix, lane, m);
    }
    const Doubles determinant = math::eliminate(m);
    for (int lane = 0; lane < kLanes; ++lane) EXPECT_NEAR(determinant[lane], expected[lane], 1e-12) << "instance " << i;
  }
}

TEST(Elimination, FindsTheNullVectorOfASingularMatrix) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(testSeed(), i);
    Doubles m[8][8];
    Matrix8 matrices[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      matrices[lane] = randomMatrix(random);
      const Eigen::Matrix<double, 6, 1> weights = Eigen::Matrix<double, 6, 1>::LinSpaced(-1, 1);
      matrices[lane].col(lane) = matrices[lane].rightCols<6>() * weights;
      setLane(matrices[lane], lane, m);
    }
    math::eliminate(m);
    Doubles v[8];
    math::nullVector(m, v);
    for (int lane = 0; lane < kLanes; ++lane) {
      Eigen::Matrix<double, 8, 1> vector;
      for (int k = 0; k < 8; ++k) vector[k] = v[k][lane];
      EXPECT_LT((matrices[lane] * vector).norm(), 1e-11 * vector.norm()) << "instance " << i;
    }
  }
}

TEST(Elimination, OfAMatrixWithAZeroColumnIsFinite) {
  Doubles m[8][8];
  Random random(testSeed());
  for (int lane = 0; lane < kLanes; ++lane) {
    Matrix8 matrix = randomMatrix(random);
    matrix.col(lane).setZero();
    setLane(matrix, lane, m);
  }
  const Doubles determinant = math::eliminate(m);
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_EQ(determinant[lane], 0);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

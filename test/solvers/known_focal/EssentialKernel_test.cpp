#include "solvers/known_focal/EssentialKernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "Random.hpp"
#include "SimdLevels.hpp"

namespace hybridgv {
namespace {

using namespace solvers::known_focal;
using test::supportedLevels;

Eigen::Matrix3d randomMatrix(test::Random& random) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 9; ++i) result(i / 3, i % 3) = random.uniform(-1, 1);
  return result;
}

Eigen::Matrix3d randomEssential(test::Random& random) {
  const Eigen::Vector3d t = random.vector(-1, 1).normalized(), axis = random.vector(-1, 1).normalized();
  Eigen::Matrix3d cross;
  cross << 0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0;
  return cross * Eigen::AngleAxisd(random.uniform(-3, 3), axis).toRotationMatrix();
}

// A basis in which x B0 + y B1 + z B2 + w B3 is essential at the given coordinates; what stands behind the matrices is no number.
struct Problem {
  explicit Problem(test::Random& random) {
    const Eigen::Matrix3d essential = randomEssential(random);
    Eigen::Matrix3d matrices[4];
    Eigen::Matrix3d rest = essential;
    for (int n = 0; n < 4; ++n) {
      coordinates[n] = random.uniform(0.3, 1) * (random.uniform(-1, 1) < 0 ? -1 : 1);
      matrices[n] = n < 3 ? randomMatrix(random) : Eigen::Matrix3d(rest / coordinates[3]);
      rest -= coordinates[n] * matrices[n];
      for (int i = 0; i < 9; ++i) basis[n][i] = matrices[n](i / 3, i % 3);
      basis[n][9] = NAN;
    }
  }

  double coordinates[4];
  EssentialBasis basis;
};

TEST(EssentialKernel, EssentialMatricesSatisfyTheReducedCubicsAtEveryLevel) {
  test::Random random(test::testSeed(), 261);
  for (int repeat = 0; repeat < 300; ++repeat) {
    const Problem problem(random);
    const double x = problem.coordinates[0], y = problem.coordinates[1], z = problem.coordinates[2], w = problem.coordinates[3];
    const double first[] = {x * x * z, x * x * w, x * y * z, x * y * w, y * y * z, y * y * w};
    const double others[] = {x * z * z, x * z * w, x * w * w, y * z * z, y * z * w,
                             y * w * w, z * z * z, z * z * w, z * w * w, w * w * w};
    for (const math::SimdLevel level : supportedLevels()) {
      ReducedCubics cubics;
      essentialKernel(level).reduce(problem.basis, cubics);
      ASSERT_TRUE(cubics.leastPivot > 0 && cubics.leastPivot <= 1) << cubics.leastPivot;
      for (int r = 0; r < ReducedCubics::kRows; ++r) {
        double sum = first[r], size = std::abs(first[r]);
        for (int k = 0; k < ReducedCubics::kColumns; ++k) {
          sum += cubics.row[r][k] * others[k];
          size += std::abs(cubics.row[r][k] * others[k]);
        }
        EXPECT_LT(std::abs(sum), 1e-12 / cubics.leastPivot * (1 + size)) << "equation " << r;
      }
    }
  }
}

TEST(EssentialKernel, EquationsThatVanishHaveNoPivotAtAnyLevel) {
  const EssentialBasis zero = {};
  for (const math::SimdLevel level : supportedLevels()) {
    ReducedCubics cubics;
    essentialKernel(level).reduce(zero, cubics);
    EXPECT_EQ(cubics.leastPivot, 0);
  }
}

}  // namespace
}  // namespace hybridgv

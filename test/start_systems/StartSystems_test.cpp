// The tables of start systems and the equations behind them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>

#include "FocalPoseNear.hpp"
#include "start_systems/H51fFamily.hpp"
#include "start_systems/H70fFamily.hpp"

namespace hybridgv {
namespace test {
namespace {

using namespace math;
using Number = std::complex<double>;

// The equations of a family at numbers: [J | F | F_t].
template <class Family>
struct Equations {
  using System = typename Family::PathProblem::System;
  static constexpr int N = System::kUnknowns;
  using Unknowns = std::array<Number, N>;

  Complex<Doubles> rows[N][N + 2];

  Equations(const typename System::template Homotopy<double>& homotopy, double t, const Unknowns& point) {
    Complex<Doubles> x[N];
    for (std::size_t k = 0; k < N; ++k) x[k] = {broadcast<Doubles>(point[k].real()), broadcast<Doubles>(point[k].imag())};
    typename System::template Data<Doubles> data;
    System::dataAt(homotopy, broadcast<Doubles>(t), data);
    System::template evaluate<true>(homotopy, broadcast<Doubles>(t), data, x, rows);
  }
  Number entry(int j, int k) const { return {rows[j][k].re[0], rows[j][k].im[0]}; }
  Number value(int j) const { return entry(j, N); }
  // With respect to an unknown, or to t for k = N.
  Number derivative(int j, int k) const { return entry(j, k < N ? k : N + 1); }
};

template <class Family>
class PathSystem : public testing::Test {};
using Families = testing::Types<H51fFamily, H70fFamily>;
TYPED_TEST_SUITE(PathSystem, Families, );

TYPED_TEST(PathSystem, VanishesAtTheTruth) {
  using FamilyEquations = Equations<TypeParam>;
  for (const auto sharing : TypeParam::kAll)
    for (std::uint64_t i = 0; i < 50; ++i) {
      Random random(testSeed(), i);
      const KnownSystem<TypeParam> system = TypeParam::randomRealSystem(sharing, random);
      typename FamilyEquations::Unknowns point;
      for (std::size_t k = 0; k < point.size(); ++k) point[k] = {system.solutions[0].re[k], system.solutions[0].im[k]};
      const FamilyEquations equations(TypeParam::straightHomotopy(system.parameters, system.parameters), 0, point);
      for (int j = 0; j < FamilyEquations::N; ++j) EXPECT_LT(std::abs(equations.value(j)), 1e-11);
    }
}

TYPED_TEST(PathSystem, HasTheDerivativesOfItsValues) {
  using FamilyEquations = Equations<TypeParam>;
  constexpr int N = FamilyEquations::N;
  constexpr double kStep = 1e-6;
  for (std::uint64_t i = 0; i < 20; ++i) {
    Random random(testSeed() + 1, i);
    const auto sharing = TypeParam::kAll[0];
    const auto randomParameters = [&] {
      return perturbed<TypeParam>(sharing, TypeParam::randomRealSystem(sharing, random).parameters, 0.3, random);
    };
    const typename TypeParam::Parameters start = randomParameters();
    const auto homotopy = TypeParam::straightHomotopy(start, randomParameters());
    const double t = random.uniform();
    typename FamilyEquations::Unknowns point;
    for (Number& x : point) x = {random.normal(), random.normal()};
    const FamilyEquations equations(homotopy, t, point);
    for (int k = 0; k <= N; ++k) {  // the last one: t
      typename FamilyEquations::Unknowns up = point, down = point;
      const double dt = k == N ? kStep : 0;
      if (k < FamilyEquations::System::kAbsolute) {
        up[static_cast<std::size_t>(k)] += kStep;
        down[static_cast<std::size_t>(k)] -= kStep;
      } else if (k < N) {
        up[static_cast<std::size_t>(k)] *= 1 + kStep;
        down[static_cast<std::size_t>(k)] *= 1 - kStep;
      }
      const FamilyEquations above(homotopy, t + dt, up), below(homotopy, t - dt, down);
      for (int j = 0; j < N; ++j) {
        const Number expected = (above.value(j) - below.value(j)) / (2 * kStep);
        EXPECT_LT(std::abs(equations.derivative(j, k) - expected), 1e-7 * (1 + std::abs(expected)))
            << "equation " << j << ", unknown " << k;
      }
    }
  }
}

solvers::complex_rays::Frame turned(solvers::complex_rays::Frame frame, Random& random) {
  frame.turn = random.rotation();
  frame.phase = std::polar(1.0, random.uniform(0, 6));
  return frame;
}

TEST(H51fReduction, PoseAndSolutionAreInverse) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random random(testSeed() + 2, i);
    const MinimalProblem problem = makeMinimalProblem(random, {1, 1, 1, 1, 1}, 1);
    solvers::h51f::Frame frame;
    ASSERT_TRUE(solvers::h51f::normalize(solvers::h51f::Sharing::AtMostTwo, problem.rays.data(), problem.points[0], &frame));
    frame = turned(frame, random);
    const FocalPose pose =
        solvers::h51f::poseOf(solvers::h51f::solutionOf(problem.truth, frame, problem.points[0]), frame, problem.points[0]);
    EXPECT_TRUE(isFocalPoseNear(pose, problem.truth, 1e-12, 1e-10));
  }
}

TEST(H70fReduction, PoseAndSolutionAreInverse) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random random(testSeed() + 2, i);
    const MinimalProblem problem = makeMinimalProblem(random, {1, 1, 1, 1, 1, 1, 1}, 0);
    solvers::h70f::Frame frame;
    ASSERT_TRUE(solvers::h70f::normalize(solvers::h70f::Sharing::AtMostTwo, problem.rays.data(), &frame));
    frame = turned(frame, random);
    const FocalPose pose = solvers::h70f::poseOf(solvers::h70f::solutionOf(problem.truth, frame), frame);
    EXPECT_TRUE(isFocalPoseNear(pose, problem.truth, 1e-12, 1e-10));
  }
}

// The table's solutions, refined to double precision.
template <class Family>
KnownSystem<Family> tableSystem(typename Family::Sharing sharing, double* largestStep) {
  using System = typename Family::PathProblem::System;
  const typename Family::StartSystem& table = *Family::caseOf(sharing).start;
  KnownSystem<Family> system{sharing, table.parameters, Solutions<System>(static_cast<std::size_t>(table.paths))};
  std::vector<int> all;
  for (int i = 0; i < table.paths; ++i) {
    all.push_back(i);
    for (int k = 0; k < System::kUnknowns; ++k) {
      system.solutions[static_cast<std::size_t>(i)].re[k] = static_cast<double>(table.solutions[i].re[k]);
      system.solutions[static_cast<std::size_t>(i)].im[k] = static_cast<double>(table.solutions[i].im[k]);
    }
  }
  std::vector<double> steps(all.size());
  const auto refine = [&](int count) {
    newtonSteps<System, Doubles, Pivoting::Rows>(Family::straightHomotopy(table.parameters, table.parameters), 0.0,
                                                 system.solutions.data(), all.data(), table.paths, count, 0.0, steps.data());
  };
  refine(1);
  *largestStep = *std::max_element(steps.begin(), steps.end());
  refine(2);
  return system;
}

// Exactly: otherwise a few paths end where the query is at the shared centre.
template <class Family>
void expectSharedCentres(typename Family::Sharing sharing, const typename Family::Parameters& parameters) {
  typename Family::Parameters restored = parameters;
  Family::restoreSharedCentres(sharing, &restored);
  for (int j = 0; j < Family::PathProblem::System::kRays; ++j)
    for (int k = 0; k < 3; ++k) {
      EXPECT_DOUBLE_EQ(parameters.moment[j][k].re, restored.moment[j][k].re);
      EXPECT_DOUBLE_EQ(parameters.moment[j][k].im, restored.moment[j][k].im);
    }
}

// Another seed's monodromy finds as many solutions, and moved to the table's parameters they are the table's.
template <class Family>
void expectComplete(typename Family::Sharing sharing) {
  double largestStep = 1;
  const KnownSystem<Family> table = tableSystem<Family>(sharing, &largestStep);
  expectSharedCentres<Family>(sharing, table.parameters);
  EXPECT_LT(largestStep, 1e-5) << "a solution in the table is not one";
  EXPECT_EQ(static_cast<int>(table.solutions.size()), Family::caseOf(sharing).solutions);

  Random random(testSeed(), 3);
  KnownSystem<Family> system = solveByMonodromy<Family>(sharing, 6, random);
  EXPECT_EQ(static_cast<int>(system.solutions.size()), Family::caseOf(sharing).solutions);
  ASSERT_TRUE(moveTo(table.parameters, &system));
  for (const auto& expected : system.solutions) {
    int equal = 0;
    for (const auto& solution : table.solutions) equal += coincide(solution, expected);
    EXPECT_EQ(equal, 1);
  }
}

template <class Family>
std::string nameOf(const testing::TestParamInfo<typename Family::Sharing>& info) {
  return Family::caseOf(info.param).name;
}

class H51fStartSystems : public testing::TestWithParam<solvers::h51f::Sharing> {};
INSTANTIATE_TEST_SUITE_P(, H51fStartSystems, testing::ValuesIn(H51fFamily::kAll), nameOf<H51fFamily>);
TEST_P(H51fStartSystems, AreCompleteByAnIndependentMonodromy) { expectComplete<H51fFamily>(GetParam()); }

class H70fStartSystems : public testing::TestWithParam<solvers::h70f::Sharing> {};
INSTANTIATE_TEST_SUITE_P(, H70fStartSystems, testing::ValuesIn(H70fFamily::kAll), nameOf<H70fFamily>);
TEST_P(H70fStartSystems, AreCompleteByAnIndependentMonodromy) { expectComplete<H70fFamily>(GetParam()); }

}  // namespace
}  // namespace test
}  // namespace hybridgv

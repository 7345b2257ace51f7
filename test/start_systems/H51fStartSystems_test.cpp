// The tables of start systems and the equations behind them.
#include <gtest/gtest.h>

#include <complex>

#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "solvers/h51f/StartSystems.hpp"
#include "start_systems/H51fMonodromy.hpp"
#include "start_systems/Monodromy.hpp"

namespace hybridgv {
namespace test {
namespace {

using namespace math;
using solvers::h51f::KnownSolution;
using solvers::h51f::KnownSystem;
using solvers::h51f::Sharing;
using solvers::h51f::HYBRIDGV_INSTRUCTION_SET::H51fSystem;
using Number = std::complex<double>;
constexpr int N = solvers::h51f::kUnknowns;

using Rows = Complex<Doubles>[N][N + 2];

// [J | F | F_t] at a point given by complex numbers.
void evaluateAt(const solvers::h51f::Homotopy<double>& homotopy, double t, const Number (&point)[N], Rows& rows) {
  Complex<Doubles> x[N];
  for (int k = 0; k < N; ++k) x[k] = {broadcast<Doubles>(point[k].real()), broadcast<Doubles>(point[k].imag())};
  H51fSystem::Data<Doubles> data;
  H51fSystem::dataAt(homotopy, broadcast<Doubles>(t), data);
  H51fSystem::evaluate<true>(homotopy, broadcast<Doubles>(t), data, x, rows);
}
Number entry(const Rows& rows, int j, int k) { return {rows[j][k].re[0], rows[j][k].im[0]}; }

TEST(H51fSystem, VanishesAtTheTruth) {
  for (const Sharing sharing : {Sharing::AtMostTwo, Sharing::Three, Sharing::Four})
    for (std::uint64_t i = 0; i < 50; ++i) {
      Random random(testSeed(), i);
      const KnownSystem system = solvers::h51f::randomRealSystem(sharing, random);
      Number point[N];
      for (int k = 0; k < N; ++k) point[k] = {system.solutions[0].re[k], system.solutions[0].im[k]};
      Rows rows;
      evaluateAt(solvers::h51f::straightHomotopy(system.parameters, system.parameters), 0, point, rows);
      for (int j = 0; j < N; ++j) EXPECT_LT(std::abs(entry(rows, j, N)), 1e-11);
    }
}

TEST(H51fSystem, HasTheDerivativesOfItsValues) {
  constexpr double kStep = 1e-6;
  for (std::uint64_t i = 0; i < 20; ++i) {
    Random random(testSeed() + 1, i);
    const auto randomParameters = [&] {
      return perturbed(Sharing::AtMostTwo, solvers::h51f::randomRealSystem(Sharing::AtMostTwo, random).parameters, 0.3, random);
    };
    const solvers::h51f::Parameters start = randomParameters();
    const solvers::h51f::Homotopy<double> homotopy = solvers::h51f::straightHomotopy(start, randomParameters());
    const double t = random.uniform();
    Number point[N];
    for (Number& x : point) x = {random.normal(), random.normal()};
    Rows rows;
    evaluateAt(homotopy, t, point, rows);
    for (int k = 0; k <= N; ++k) {  // the last one: t
      Number up[N], down[N];
      for (int l = 0; l < N; ++l) up[l] = down[l] = point[l];
      const double dt = k == N ? kStep : 0;
      if (k < H51fSystem::kAbsolute) {
        up[k] += kStep;
        down[k] -= kStep;
      } else if (k < N) {
        up[k] *= 1 + kStep;
        down[k] *= 1 - kStep;
      }
      Rows rowsUp, rowsDown;
      evaluateAt(homotopy, t + dt, up, rowsUp);
      evaluateAt(homotopy, t - dt, down, rowsDown);
      for (int j = 0; j < N; ++j) {
        const Number derivative = entry(rows, j, k < N ? k : N + 1);
        const Number expected = (entry(rowsUp, j, N) - entry(rowsDown, j, N)) / (2 * kStep);
        EXPECT_LT(std::abs(derivative - expected), 1e-7 * (1 + std::abs(expected))) << "equation " << j << ", unknown " << k;
      }
    }
  }
}

TEST(H51fSystem, PoseAndSolutionAreInverse) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random random(testSeed() + 2, i);
    const MinimalProblem problem = makeMinimalProblem(random, {1, 1, 1, 1, 1}, 1);
    solvers::h51f::Frame frame;
    ASSERT_TRUE(solvers::h51f::normalize(Sharing::AtMostTwo, problem.rays.data(), problem.points[0], &frame));
    frame.turn = random.rotation();
    frame.phase = std::polar(1.0, random.uniform(0, 6));
    const FocalPose pose =
        solvers::h51f::poseOf(solvers::h51f::solutionOf(problem.truth, frame, problem.points[0]), frame, problem.points[0]);
    EXPECT_TRUE(isFocalPoseNear(pose, problem.truth, 1e-12, 1e-10));
  }
}

// The table's solutions, refined to double precision.
KnownSystem tableSystem(Sharing sharing, double* largestStep) {
  const solvers::h51f::StartSystem& table = *solvers::h51f::caseOf(sharing).start;
  KnownSystem system{sharing, table.parameters, std::vector<KnownSolution>(static_cast<std::size_t>(table.paths))};
  std::vector<int> all;
  for (int i = 0; i < table.paths; ++i) {
    all.push_back(i);
    for (int k = 0; k < N; ++k) {
      system.solutions[static_cast<std::size_t>(i)].re[k] = static_cast<double>(table.solutions[i].re[k]);
      system.solutions[static_cast<std::size_t>(i)].im[k] = static_cast<double>(table.solutions[i].im[k]);
    }
  }
  std::vector<double> steps(all.size());
  newtonSteps<H51fSystem, Doubles, Pivoting::Rows>(solvers::h51f::straightHomotopy(table.parameters, table.parameters), 0.0,
                                                   system.solutions.data(), all.data(), table.paths, 1, 0.0, steps.data());
  *largestStep = *std::max_element(steps.begin(), steps.end());
  newtonSteps<H51fSystem, Doubles, Pivoting::Rows>(solvers::h51f::straightHomotopy(table.parameters, table.parameters), 0.0,
                                                   system.solutions.data(), all.data(), table.paths, 2, 0.0, steps.data());
  return system;
}

// Exactly: otherwise a few paths end where the query is at the shared centre.
void expectSharedCentre(Sharing sharing, const solvers::h51f::Parameters& parameters) {
  solvers::h51f::Parameters restored = parameters;
  restoreSharedCentre(sharing, &restored);
  for (int j = 0; j < solvers::h51f::kRays; ++j)
    for (int k = 0; k < 3; ++k) {
      EXPECT_DOUBLE_EQ(parameters.moment[j][k].re, restored.moment[j][k].re);
      EXPECT_DOUBLE_EQ(parameters.moment[j][k].im, restored.moment[j][k].im);
    }
}

class StartSystems : public testing::TestWithParam<Sharing> {};
INSTANTIATE_TEST_SUITE_P(, StartSystems, testing::Values(Sharing::AtMostTwo, Sharing::Three, Sharing::Four),
                         [](const auto& info) { return std::string(solvers::h51f::caseOf(info.param).name); });

// Another seed's monodromy finds as many solutions, and moved to the table's parameters they are the table's.
TEST_P(StartSystems, AreCompleteByAnIndependentMonodromy) {
  double largestStep = 1;
  const KnownSystem table = tableSystem(GetParam(), &largestStep);
  expectSharedCentre(GetParam(), table.parameters);
  EXPECT_LT(largestStep, 1e-5) << "a solution in the table is not one";
  EXPECT_EQ(static_cast<int>(table.solutions.size()), solvers::h51f::caseOf(GetParam()).solutions);

  Random random(testSeed(), 3);
  KnownSystem system = solvers::h51f::solveByMonodromy(GetParam(), 6, random);
  EXPECT_EQ(static_cast<int>(system.solutions.size()), solvers::h51f::caseOf(GetParam()).solutions);
  ASSERT_TRUE(solvers::h51f::moveTo(table.parameters, &system));
  for (const KnownSolution& expected : system.solutions) {
    int equal = 0;
    for (const KnownSolution& solution : table.solutions) equal += coincide(solution, expected);
    EXPECT_EQ(equal, 1);
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

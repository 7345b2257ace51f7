// The parts of H32f and their versions for the instruction sets.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "solvers/h32f/HiddenRoots.hpp"
#include "solvers/h32f/Kernel.hpp"
#include "solvers/h32f/SampleTables.hpp"

namespace hybridgv {
namespace test {
namespace {

using math::SimdLevel;
using solvers::h32f::kDegree;
using solvers::h32f::kernel;
using solvers::h32f::kHalf;
using solvers::h32f::kPieces;
using solvers::h32f::kSamples;
using solvers::h32f::PieceCoefficients;
using solvers::h32f::SampleTables;

TEST(H32fKernel, EveryInstructionSetFindsTheSameSolutions) {
  for (const SimdLevel level : {SimdLevel::Avx2, SimdLevel::Avx512}) {
    if (level > math::supportedSimdLevel()) continue;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      Random random(testSeed(), i);
      const MinimalProblem problem = makeMinimalProblem(random, i % 2 ? std::vector<int>{1, 1, 1} : std::vector<int>{3}, 2);
      const auto solve = [&](SimdLevel version) {
        FocalPoses poses(26);
        const int count = solvers::h32f::solve(problem.rays.data(), problem.points.data(), kernel(version), poses.data());
        poses.resize(static_cast<std::size_t>(count));
        return poses;
      };
      const FocalPoses expected = solve(SimdLevel::Baseline), poses = solve(level);
      ASSERT_EQ(poses.size(), expected.size()) << math::toString(level) << ", problem " << i;
      for (const FocalPose& pose : expected) EXPECT_TRUE(hasFocalPoseNear(poses, pose, 1e-6)) << "problem " << i;
    }
  }
}

// A function of the space that the samples fix, with zeros anywhere.
double rationalFunction(double e, const std::vector<double>& zeros) {
  double value = 1 / std::pow(e * e + 0.64, 13);
  for (double zero : zeros) value *= e - zero;
  return value;
}

TEST(H32fKernel, PiecesAreTheSampledFunction) {
  const SampleTables& tables = SampleTables::get();
  for (std::uint64_t i = 0; i < 20; ++i) {
    Random random(testSeed(), i);
    std::vector<double> zeros(26);
    for (double& zero : zeros) zero = random.uniform(-1.5, 1.5);
    double samples[kSamples + 4], largest = 0;
    for (int k = 0; k < kSamples; ++k) {
      samples[k] = rationalFunction(tables.nodes[k], zeros);
      largest = std::max(largest, std::abs(samples[k]));
    }
    PieceCoefficients pieces;
    kernel(SimdLevel::Baseline).bernsteinCoefficients(tables, samples, pieces);
    for (int j = 0; j < kPieces; ++j) {
      const double x = random.uniform(), e = tables.breakpoints[j] + x * (tables.breakpoints[j + 1] - tables.breakpoints[j]);
      double positive = 0, negative = 0;
      for (int k = 0; k <= kDegree; ++k) {
        const double basis = tables.binomial[k] * std::pow(x, k) * std::pow(1 - x, kDegree - k);
        positive += basis * pieces.b[0][k][j];
        negative += basis * pieces.b[1][k][j];
      }
      const double tolerance = (j == kPieces - 1 ? 1e-12 : 1e-13) * largest;
      EXPECT_NEAR(positive, rationalFunction(e, zeros), tolerance) << "piece " << j;
      EXPECT_NEAR(negative, rationalFunction(-e, zeros), tolerance) << "piece " << j;
    }
  }
}

TEST(SampleTables, NodesLieWhereTheResultantDoesNotVanish) {
  const SampleTables& tables = SampleTables::get();
  EXPECT_NEAR(tables.nodes[0], 0.0356, 1e-4);
  EXPECT_NEAR(tables.nodes[1], 0.1070, 1e-4);
  EXPECT_NEAR(tables.nodes[2], 0.1795, 1e-4);
  EXPECT_NEAR(tables.nodes[kHalf - 1], 0.9665, 1e-4);
  for (int k = 0; k < kHalf; ++k) EXPECT_EQ(tables.nodes[k + kHalf], -tables.nodes[k]);
  for (int j = 0; j < kPieces; ++j) EXPECT_LT(tables.breakpoints[j], tables.breakpoints[j + 1]);
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

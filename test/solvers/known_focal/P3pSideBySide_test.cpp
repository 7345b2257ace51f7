// P3P for several samples at once: the solutions of one at a time, whatever stands beside it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "FocalPoseNear.hpp"
#include "MinimalProblem.hpp"
#include "SimdLevels.hpp"
#include "solvers/MinimalProblems.hpp"
#include "solvers/known_focal/P3pKernel.hpp"

namespace hybridgv {
namespace test {
namespace {

using solvers::PointMatch;
using solvers::known_focal::kP3pSamples;
using solvers::known_focal::p3pKernel;
using solvers::known_focal::P3pSamples;
using solvers::known_focal::P3pSolutions;
using Sample = std::vector<PointMatch>;
using Solutions = std::vector<std::vector<double>>;  // rotation by columns, position

template <int N>
void set(const Sample& sample, int at, P3pSamples<N>& samples) {
  for (int i = 0; i < 3; ++i) {
    const PointMatch& point = sample[static_cast<std::size_t>(i)];
    samples.u[i][at] = point.u;
    samples.v[i][at] = point.v;
    for (int k = 0; k < 3; ++k) samples.point[i][k][at] = point.point[k];
  }
}

template <int N>
Solutions get(const P3pSolutions<N>& from, int at) {
  Solutions result;
  for (int n = 0; n < 4; ++n) {
    if (!from.found[n][at]) continue;
    result.emplace_back();
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) result.back().push_back(from.column[n][column][row][at]);
    for (int row = 0; row < 3; ++row) result.back().push_back(from.position[n][row][at]);
  }
  return result;
}

Solutions one(const Sample& sample, math::SimdLevel level) {
  P3pSamples<1> samples;
  P3pSolutions<1> solutions;
  set(sample, 0, samples);
  p3pKernel(level).solveOne(samples, solutions);
  return get(solutions, 0);
}

std::vector<Solutions> many(const std::vector<Sample>& from, math::SimdLevel level) {
  P3pSamples<kP3pSamples> samples;
  P3pSolutions<kP3pSamples> solutions;
  for (int i = 0; i < kP3pSamples; ++i) set(from[static_cast<std::size_t>(i)], i, samples);
  p3pKernel(level).solveMany(samples, solutions);
  std::vector<Solutions> result;
  for (int i = 0; i < kP3pSamples; ++i) result.push_back(get(solutions, i));
  return result;
}

Sample sampleOf(const MinimalProblem& problem) {
  Sample sample = problem.points;
  for (PointMatch& point : sample) {
    point.u /= problem.truth.focalLength;
    point.v /= problem.truth.focalLength;
  }
  return sample;
}

Sample rightSample(std::uint64_t i) {
  Random random(testSeed() + 43, i);
  return sampleOf(makeMinimalProblem(random, {}, 3));
}

Sample wrongSample(std::uint64_t i) {
  Random random(testSeed() + 44, i);
  Sample sample = rightSample(i);
  for (PointMatch& point : sample) point.u = random.uniform(-0.5, 0.5);
  return sample;
}

// What takes ways of its own: no triangle, a thin one, lengths and coordinates that are huge or tiny, points that are seen at one place.
std::vector<Sample> strangeSamples() {
  std::vector<Sample> samples(8, rightSample(0));
  samples[1][2].point = (samples[1][0].point + samples[1][1].point) / 2;
  samples[2][2].point = samples[2][1].point;
  samples[3][2].point = samples[3][1].point + 1e-7 * (samples[3][2].point - samples[3][1].point);
  for (PointMatch& point : samples[4]) point.point *= 1e140;
  for (PointMatch& point : samples[5]) point.point *= 1e-140;
  for (PointMatch& point : samples[6]) point.u *= 1e152;
  for (PointMatch& point : samples[7]) point.u = point.v = 0.1;
  return samples;
}

TEST(P3pSideBySide, FindsWhatIsFoundOneByOne) {
  for (const math::SimdLevel level : supportedLevels())
    for (const auto& make : {rightSample, wrongSample}) {
      int different = 0, all = 0;
      for (std::uint64_t i = 0; i < 4000; i += kP3pSamples) {
        std::vector<Sample> samples;
        for (std::uint64_t k = 0; k < kP3pSamples; ++k) samples.push_back(make(i + k));
        const std::vector<Solutions> together = many(samples, level);
        for (std::size_t k = 0; k < samples.size(); ++k) {
          const Solutions alone = one(samples[k], level);
          ++all;
          if (alone.size() != together[k].size()) {
            ++different;  // nearly double solutions
            continue;
          }
          for (std::size_t n = 0; n < alone.size(); ++n)
            for (std::size_t j = 0; j < alone[n].size(); ++j)
              different += !(std::abs(alone[n][j] - together[k][n][j]) < 1e-5 * std::max(1., std::abs(alone[n][j])));
        }
      }
      EXPECT_LE(different, all / 1000) << toString(level);
    }
}

// To the last bit: the same seed gives the same result for any number of threads, which gather samples in another way.
TEST(P3pSideBySide, ASampleIsSolvedAlikeWhateverStandsBesideIt) {
  const std::vector<Sample> strange = strangeSamples();
  for (const math::SimdLevel level : supportedLevels())
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Sample sample = i % 2 == 0 ? rightSample(i) : wrongSample(i);
      const Solutions expected = many(std::vector<Sample>(kP3pSamples, sample), level)[0];
      std::vector<Sample> samples = strange;
      const std::size_t place = i % kP3pSamples;
      samples[place] = sample;
      EXPECT_EQ(many(samples, level)[place], expected) << toString(level) << ", " << i;
    }
}

TEST(P3pSideBySide, StrangeSamplesGiveFinitePosesThatAreRotationsOrNone) {
  const std::vector<Sample> strange = strangeSamples();
  for (const math::SimdLevel level : supportedLevels()) {
    const std::vector<Solutions> together = many(strange, level);
    for (std::size_t k = 0; k < strange.size(); ++k) {
      EXPECT_EQ(together[k].size(), one(strange[k], level).size()) << toString(level) << ", " << k;
      for (const std::vector<double>& pose : together[k]) {
        const Eigen::Map<const Eigen::Matrix3d> rotation(pose.data());
        EXPECT_LT((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm(), 1e-12);
        for (const double x : pose) EXPECT_TRUE(std::isfinite(x));
      }
    }
    for (const std::size_t none : {1u, 2u, 7u}) EXPECT_TRUE(together[none].empty()) << none;
    for (const std::size_t some : {0u, 4u, 5u}) EXPECT_FALSE(together[some].empty()) << some;
  }
}

TEST(P3pSideBySide, TheTableSolvesAPartOfThemToo) {
  for (int count = 1; count <= solvers::kSideBySide; ++count) {
    std::vector<PointMatch> points;
    std::vector<double> focalLengths;
    std::vector<MinimalProblem> problems;
    for (int i = 0; i < count; ++i) {
      Random random(testSeed() + 45, static_cast<std::uint64_t>(i));
      problems.push_back(makeMinimalProblem(random, {}, 3));
      points.insert(points.end(), problems.back().points.begin(), problems.back().points.end());
      focalLengths.push_back(problems.back().truth.focalLength);
    }
    const solvers::MinimalSolver& p3p = *solvers::rowsOf(Solver::P3P).begin();
    std::vector<FocalPose> solutions(static_cast<std::size_t>(count * p3p.maxSolutions));
    std::vector<int> found(static_cast<std::size_t>(count));
    solveMany(p3p, points.data(), focalLengths.data(), count, solutions.data(), found.data());
    for (std::size_t i = 0; i < problems.size(); ++i) {
      const auto begin = solutions.begin() + static_cast<std::ptrdiff_t>(i) * p3p.maxSolutions;
      EXPECT_LT(distanceToNearest(FocalPoses(begin, begin + found[i]), problems[i].truth), 1e-6);
    }
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

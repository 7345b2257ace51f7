// Time per call of every minimal solver, through the body of its public function and an adapter, in microseconds and as a ratio to OpenGV's
// gp3p in the same run.
//
//   solver_benchmark [--markdown] [--benchmark_filter=REGEX] [--benchmark_repetitions=N] ...
//
// Every row cycles through 1000 different random problems. The repetitions of all rows are mixed in random order, so that other
// work on the machine burdens all rows alike; the table shows medians. A row per solver and way to share its rays among rig
// cameras: h51f_32 has three rays of one camera and two of another. p3p_side_by_side solves eight problems at once, as hybridRansac does.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <memory>
#include <opengv/absolute_pose/methods.hpp>
#include <string>
#include <vector>

#include "Gp3pProblem.hpp"
#include "MinimalProblem.hpp"
#include "SolverConfigurations.hpp"
#include "TableReporter.hpp"
#include "hybrid_pose/solveSample.hpp"

namespace hybridgv {
namespace benchmarks {
namespace {

constexpr int kProblems = 1000;
constexpr std::uint64_t kSeed = 7102;
constexpr double kRecovered = 1e-6;  // rotation [rad] and relative focal length

using test::SolverConfiguration;

FocalPoses solve(const SolverConfiguration& row, const NoncentralHybridAdapter& adapter, double focalLength) {
  return hybrid_pose::solve(solvers::rowsOf(row.solver->name), adapter, focalLength);
}

struct Statistics {
  int problems = 0, recovered = 0;
  std::size_t solutions = 0, most = 0;

  void add(std::size_t count, double error) {
    ++problems;
    recovered += error < kRecovered;
    solutions += count;
    most = std::max(most, count);
  }
  void writeTo(benchmark::State& state) const {
    state.counters["mean solutions"] = static_cast<double>(solutions) / problems;
    state.counters["max solutions"] = static_cast<double>(most);
    state.counters["recovered %"] = 100.0 * recovered / problems;
  }
};

// The problems of a row and what is found; made when the row is first run.
struct SolverData {
  std::vector<NoncentralHybridAdapter> adapters;
  std::vector<double> focalLengths;
  Statistics statistics;

  explicit SolverData(const SolverConfiguration& row) {
    for (std::uint64_t i = 0; i < kProblems; ++i) {
      test::Random random(kSeed, i);
      const test::MinimalProblem problem = test::makeMinimalProblem(random, row.raysPerCamera, row.solver->points);
      adapters.push_back(test::makeAdapter(problem));
      focalLengths.push_back(problem.truth.focalLength);
      const FocalPoses solutions = solve(row, adapters.back(), focalLengths.back());
      statistics.add(solutions.size(), test::distanceToNearest(solutions, problem.truth));
    }
  }
};

void registerSolver(const SolverConfiguration& row) {
  benchmark::RegisterBenchmark(row.name.c_str(), [row, data = std::shared_ptr<SolverData>()](benchmark::State& state) mutable {
    if (!data) data = std::make_shared<SolverData>(row);
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(solve(row, data->adapters[i], data->focalLengths[i]));
      i = (i + 1) % kProblems;
    }
    data->statistics.writeTo(state);
  });
}

// The same problems without an adapter, as many at once as the solver takes; the time is that of one.
struct SideBySideData {
  static constexpr std::size_t kSamples = solvers::kSideBySide;
  std::vector<solvers::PointMatch> points;
  std::vector<double> focalLengths;
  Statistics statistics;

  explicit SideBySideData(const SolverConfiguration& row) {
    for (std::uint64_t i = 0; i < kProblems; i += kSamples) {
      std::vector<test::MinimalProblem> problems;
      for (std::uint64_t k = 0; k < kSamples; ++k) {
        test::Random random(kSeed, i + k);
        problems.push_back(test::makeMinimalProblem(random, row.raysPerCamera, row.solver->points));
        points.insert(points.end(), problems.back().points.begin(), problems.back().points.end());
        focalLengths.push_back(problems.back().truth.focalLength);
      }
      const std::vector<FocalPoses> solutions = solve(row, i);
      for (std::size_t k = 0; k < kSamples; ++k)
        statistics.add(solutions[k].size(), test::distanceToNearest(solutions[k], problems[k].truth));
    }
  }

  std::vector<FocalPoses> solve(const SolverConfiguration& row, std::size_t first) const {
    const auto size = static_cast<std::size_t>(row.solver->points), most = static_cast<std::size_t>(row.solver->maxSolutions);
    std::vector<solvers::PointMatch> samples(points.begin() + static_cast<std::ptrdiff_t>(first * size),
                                             points.begin() + static_cast<std::ptrdiff_t>((first + kSamples) * size));
    FocalPose solutions[solvers::kMaxSolutions];
    int found[kSamples];
    solvers::solveMany(*row.solver, samples.data(), &focalLengths[first], static_cast<int>(kSamples), solutions, found);
    std::vector<FocalPoses> result;
    for (std::size_t k = 0; k < kSamples; ++k)
      result.emplace_back(solutions + k * most, solutions + k * most + static_cast<std::size_t>(found[k]));
    return result;
  }
};

void registerSideBySide(const SolverConfiguration& row) {
  const auto run = [row, data = std::shared_ptr<SideBySideData>()](benchmark::State& state) mutable {
    if (!data) data = std::make_shared<SideBySideData>(row);
    std::size_t i = 0;
    while (state.KeepRunningBatch(SideBySideData::kSamples)) {
      benchmark::DoNotOptimize(data->solve(row, i));
      i = (i + SideBySideData::kSamples) % kProblems;
    }
    data->statistics.writeTo(state);
  };
  benchmark::RegisterBenchmark((row.name + "_side_by_side").c_str(), run);
}

struct Gp3pData {
  std::vector<std::unique_ptr<Gp3pProblem>> problems;
  Statistics statistics;

  Gp3pData() {
    for (std::uint64_t i = 0; i < kProblems; ++i) {
      test::Random random(kSeed, i);
      problems.push_back(std::make_unique<Gp3pProblem>(random));
      const Gp3pProblem& problem = *problems.back();
      const opengv::transformations_t solutions = opengv::absolute_pose::gp3p(problem.adapter());
      double error = 1;
      for (const auto& solution : solutions) error = std::min(error, (solution.leftCols<3>() - problem.truthRotation()).norm());
      statistics.add(solutions.size(), error);
    }
  }
};

void registerGp3p() {
  benchmark::RegisterBenchmark("gp3p", [data = std::shared_ptr<Gp3pData>()](benchmark::State& state) mutable {
    if (!data) data = std::make_shared<Gp3pData>();
    const std::vector<int> indices{0, 1, 2};
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(opengv::absolute_pose::gp3p(data->problems[i]->adapter(), indices));
      i = (i + 1) % kProblems;
    }
    data->statistics.writeTo(state);
  });
}

}  // namespace
}  // namespace benchmarks
}  // namespace hybridgv

int main(int argc, char** argv) {
  using namespace hybridgv::benchmarks;
  std::string defaults[] = {"--benchmark_enable_random_interleaving=true", "--benchmark_repetitions=25",
                            "--benchmark_min_time=0.02"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& argument : defaults) arguments.push_back(argument.data());
  bool markdown = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--markdown") == 0)
      markdown = true;
    else
      arguments.push_back(argv[i]);
  }
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
  registerGp3p();
  for (const SolverConfiguration& row : hybridgv::test::solverConfigurations()) {
    registerSolver(row);
    if (row.solver->solveMany != nullptr) registerSideBySide(row);
  }
  TableReporter reporter("gp3p", markdown);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
}

// Time per call of every minimal solver, through the body of its public function and an adapter, in microseconds and as a ratio to OpenGV's
// gp3p in the same run.
//
//   solver_benchmark [--markdown] [--benchmark_filter=REGEX] [--benchmark_repetitions=N] ...
//
// Every row cycles through 1000 different random problems. The repetitions of all rows are mixed in random order, so that other
// work on the machine burdens all rows alike; the table shows medians. A row per solver and way to share its rays among rig
// cameras: h51f_32 has three rays of one camera and two of another.
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
  for (const SolverConfiguration& row : hybridgv::test::solverConfigurations()) registerSolver(row);
  TableReporter reporter("gp3p", markdown);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
}

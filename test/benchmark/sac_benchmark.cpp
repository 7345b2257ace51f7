// Microseconds per sample that the problems for OpenGV's loops draw, and per model that they count: the bookkeeping of a loop's
// iteration beside the solver. Drawing must not depend on the number of correspondences.
#include "hybridgv/sac_problems/hybrid_pose/HybridPoseSacProblem.hpp"
#include "hybridgv/sac_problems/hybrid_pose/MultiHybridPoseSacProblem.hpp"

// The problems come first: OpenGV's headers need what they include.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "HybridScene.hpp"

namespace {

using namespace hybridgv;
using sac_problems::hybrid_pose::HybridPoseSacProblem;
using sac_problems::hybrid_pose::MultiHybridPoseSacProblem;

// Half of the correspondences are rays; `raysPerCamera` of them have one centre.
test::HybridScene makeScene(int count, int raysPerCamera) {
  test::Random random(1, 0);
  test::SceneOptions options;
  options.rays = options.points = count / 2;
  options.cameras = std::max(1, count / 2 / raysPerCamera);
  options.outlierShareRays = options.outlierSharePoints = 0.5;
  return test::makeHybridScene(random, options);
}

template <class Problem>
void getSamples(benchmark::State& state, Solver solver, int raysPerCamera) {
  const NoncentralHybridAdapter adapter = makeScene(static_cast<int>(state.range(0)), raysPerCamera).adapter();
  Problem problem(adapter, solver, 4, 2);
  using Sample =
      std::conditional_t<std::is_same<Problem, HybridPoseSacProblem>::value, std::vector<int>, std::vector<std::vector<int>>>;
  Sample sample;
  int iterations = 0;
  for (auto _ : state) {
    problem.getSamples(iterations, sample);
    benchmark::DoNotOptimize(sample);
  }
}

void countWithin(benchmark::State& state) {
  const test::HybridScene scene = makeScene(static_cast<int>(state.range(0)), 100);
  const NoncentralHybridAdapter adapter = scene.adapter();
  HybridPoseSacProblem problem(adapter, Solver::P4Pf, 4, 2);
  for (auto _ : state) benchmark::DoNotOptimize(problem.countWithinDistance(scene.truth, 1.0));
}

void construct(benchmark::State& state) {  // each ray has a centre of its own
  const NoncentralHybridAdapter adapter = makeScene(2 * static_cast<int>(state.range(0)), 1).adapter();
  for (auto _ : state) benchmark::DoNotOptimize(HybridPoseSacProblem(adapter, Solver::P4Pf, 4, 2));
}

}  // namespace

int main(int argc, char** argv) {
  for (const Solver solver : {Solver::P4Pf, Solver::H32f, Solver::H51f}) {
    const std::string name = toString(solver);
    benchmark::RegisterBenchmark(("samples/" + name).c_str(), getSamples<HybridPoseSacProblem>, solver, 100)
        ->Arg(400)
        ->Arg(4000)
        ->Arg(40000);
    benchmark::RegisterBenchmark(("multi_samples/" + name).c_str(), getSamples<MultiHybridPoseSacProblem>, solver, 100)
        ->Arg(400)
        ->Arg(4000)
        ->Arg(40000);
  }
  benchmark::RegisterBenchmark("count", countWithin)->Arg(400)->Arg(4000)->Arg(40000);
  benchmark::RegisterBenchmark("construct_with_centres", construct)->Arg(2000)->Arg(16000)->Arg(100000);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

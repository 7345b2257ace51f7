// Nanoseconds per correspondence of the loops over all correspondences, at every instruction set that this processor has.
#include <benchmark/benchmark.h>

#include <string>

#include "HybridScene.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "robust/kernels/Kernels.hpp"
#include "robust/toPlain.hpp"

namespace {

using namespace hybridgv;

struct Data {
  explicit Data(int count) : scene(make(count)), adapter(scene.adapter()), arrays(read(adapter)) {
    test::Random random(2, 0);
    for (int i = 0; i < 32; ++i) {  // half of them near the truth
      const FocalPose pose =
          i % 2 ? test::perturbed(random, scene.truth, 0.01, 0.1, 0.01) : test::perturbed(random, scene.truth, 1, 5, 1);
      poses.push_back(robust::toPlain(arrays.normalization().apply(pose)));
    }
  }
  static test::HybridScene make(int count) {
    test::SceneOptions options;
    options.rays = options.points = count;
    options.imageNoise = 2;
    options.outlierShareRays = options.outlierSharePoints = 0.5;
    test::Random random(1, 0);
    return test::makeHybridScene(random, options);
  }
  static correspondences::CorrespondenceArrays read(const NoncentralHybridAdapter& adapter) {
    return {adapter, correspondences::allIndices(adapter.getNumberCorrespondences2d2d()),
            correspondences::allIndices(adapter.getNumberCorrespondences2d3d())};
  }
  test::HybridScene scene;
  NoncentralHybridAdapter adapter;
  correspondences::CorrespondenceArrays arrays;
  std::vector<robust::PlainPose> poses;
};

template <class Call>
void run(benchmark::State& state, Call call) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const Data data(static_cast<int>(count));
  std::size_t calls = 0;
  for (auto _ : state) call(data, data.poses[calls++ % data.poses.size()], count);
  state.counters["ns_per_correspondence"] =
      benchmark::Counter(static_cast<double>(calls * count) * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void add(const char* name, math::SimdLevel level, void (*function)(benchmark::State&, const robust::Kernels&)) {
  for (const auto model : {robust::CameraModel::Pinhole, robust::CameraModel::Radial}) {
    const char* const camera = model == robust::CameraModel::Pinhole ? "pinhole" : "radial";
    const std::string title = std::string(name) + "/" + camera + "/" + math::toString(level);
    benchmark::RegisterBenchmark(title.c_str(), function, robust::kernels(level, model))->Arg(200)->Arg(1000);
  }
}

void scorePoints(benchmark::State& state, const robust::Kernels& kernels) {
  run(state, [&](const Data& data, const robust::PlainPose& pose, std::size_t count) {
    benchmark::DoNotOptimize(kernels.scorePoints(data.arrays.pointArrays(), pose, 144, 0, count));
  });
}

void scoreRays(benchmark::State& state, const robust::Kernels& kernels) {
  run(state, [&](const Data& data, const robust::PlainPose& pose, std::size_t count) {
    benchmark::DoNotOptimize(kernels.scoreRays(data.arrays.rayArrays(), pose, 36, 0, count));
  });
}

void normalEquationsPoints(benchmark::State& state, const robust::Kernels& kernels) {
  run(state, [&](const Data& data, const robust::PlainPose& pose, std::size_t) {
    robust::NormalEquations sums;
    kernels.addPoints(data.arrays.pointArrays(), pose, {robust::Loss::Truncated, 12, 1}, sums);
    benchmark::DoNotOptimize(sums);
  });
}

void normalEquationsRays(benchmark::State& state, const robust::Kernels& kernels) {
  run(state, [&](const Data& data, const robust::PlainPose& pose, std::size_t) {
    robust::NormalEquations sums;
    kernels.addRays(data.arrays.rayArrays(), pose, {robust::Loss::Truncated, 6, 1}, sums);
    benchmark::DoNotOptimize(sums);
  });
}

}  // namespace

int main(int argc, char** argv) {
  for (const auto level : {math::SimdLevel::Baseline, math::SimdLevel::Avx2, math::SimdLevel::Avx512}) {
    if (level > math::supportedSimdLevel()) continue;
    add("score_2d3d", level, scorePoints);
    add("score_2d2d", level, scoreRays);
    add("normal_equations_2d3d", level, normalEquationsPoints);
    add("normal_equations_2d2d", level, normalEquationsRays);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// Time of hybridRansac for one query (Time column), with the samples per solver, at several shares of outliers and amounts of
// noise in the points. One core, 200 + 200 correspondences, five rig cameras.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "HybridScene.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace {

using namespace hybridgv;

constexpr int kScenes = 64;
constexpr double kPointDepth = 20;  // about, in makeHybridScene

struct Row {
  int outliersPercent;
  double pointNoisePercent;  // standard deviation over depth
  double outlierShareRays;   // negative: as of the points
  int rays = 200;
};

void query(benchmark::State& state, const Row& row) {
  test::SceneOptions sceneOptions;
  sceneOptions.rays = row.rays;
  sceneOptions.points = 200;
  sceneOptions.imageNoise = 2;
  sceneOptions.outlierSharePoints = row.outliersPercent / 100.;
  sceneOptions.outlierShareRays = row.outlierShareRays < 0 ? sceneOptions.outlierSharePoints : row.outlierShareRays;
  sceneOptions.pointNoise = row.pointNoisePercent / 100 * kPointDepth;
  sac::HybridRansacOptions options;
  options.maxReprojectionErrorPx = std::max(12., 2.5 * std::hypot(2, 10 * row.pointNoisePercent));

  test::Random random(1, static_cast<std::uint64_t>(row.outliersPercent));
  std::vector<test::HybridScene> scenes;
  std::vector<NoncentralHybridAdapter> adapters;
  for (int i = 0; i < kScenes; ++i) {
    scenes.push_back(test::makeHybridScene(random, sceneOptions));
    adapters.push_back(scenes.back().adapter());
  }
  std::vector<double> focalErrors;
  std::map<Solver, double> samples;
  std::size_t calls = 0;
  for (auto _ : state) {
    const std::size_t i = calls++ % kScenes;
    options.seed = i;
    const sac::HybridRansacResult result = sac::hybridRansac(adapters[i], options);
    if (calls > kScenes) continue;
    focalErrors.push_back(100 * std::abs(result.pose.focalLength / scenes[i].truth.focalLength - 1));
    for (const auto& [solver, count] : result.iterationsPerSolver) samples[solver] += count;
  }
  std::nth_element(focalErrors.begin(), focalErrors.begin() + static_cast<std::ptrdiff_t>(focalErrors.size() / 2),
                   focalErrors.end());
  state.counters["median_focal_error_%"] = focalErrors[focalErrors.size() / 2];
  for (const auto& [solver, count] : samples) state.counters[toString(solver)] = count / static_cast<double>(focalErrors.size());
}

}  // namespace

int main(int argc, char** argv) {
  const auto add = [](const std::string& name, const Row& row) {
    benchmark::RegisterBenchmark(name.c_str(), query, row)->Unit(benchmark::kMillisecond);
  };
  for (const double noise : {0., 1., 3.})
    for (const int outliers : {0, 30, 50, 70})
      add("outliers_" + std::to_string(outliers) + "%/point_noise_" + std::to_string(static_cast<int>(noise)) + "%",
          {outliers, noise, -1});
  for (const int outliers : {0, 30, 50, 70}) {
    const std::string share = "outliers_" + std::to_string(outliers) + "%";
    add(share + "/rays_all_outliers", {outliers, 0, 1});
    add(share + "/no_rays", {outliers, 0, 0, 0});
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

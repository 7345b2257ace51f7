// What each kind of match is good for: the same scenes by their rays alone, by their points alone, and by both, over the number of
// matches and the share of wrong ones.
//
// Writes rays_and_points.csv.
#include "../common/CsvFile.hpp"
#include "HybridScene.hpp"
#include "cells.hpp"
#include "estimate.hpp"

namespace {

using hybridgv::test::HybridScene;

constexpr double kImageNoisePx = 2;

struct Kinds {
  const char* name;
  bool rays, points;
};
constexpr Kinds kAllKinds[] = {{"rays", true, false}, {"points", false, true}, {"both", true, true}};

struct Cell {
  int matches;  // of each kind
  double pointNoise, outlierShare;
};

HybridScene makeScene(std::uint64_t seed, std::uint64_t index, const Cell& cell) {
  hybridgv::test::SceneOptions options;
  options.rays = options.points = cell.matches;
  options.imageNoise = kImageNoisePx;
  options.pointNoise = cell.pointNoise;
  options.outlierShareRays = options.outlierSharePoints = cell.outlierShare;
  hybridgv::test::Random random(seed, index);
  return makeHybridScene(random, options);
}

hybridgv::NoncentralHybridAdapter adapterOf(HybridScene scene, const Kinds& kinds) {
  if (!kinds.rays) scene.removeRays();
  if (!kinds.points) scene.removePoints();
  return scene.adapter();
}

// With few matches it is their number that decides, not their noise.
std::vector<Cell> allCells() {
  std::vector<Cell> cells;
  for (const double outliers : {0., 0.3, 0.5, 0.7}) {
    for (const int matches : {6, 8, 12, 16, 30}) cells.push_back({matches, 0, outliers});
    for (const double pointNoise : {0., 0.1, 0.3})
      for (const int matches : {10, 20, 50, 100, 200, 500}) cells.push_back({matches, pointNoise, outliers});
  }
  return cells;
}

void measure(const Cell& cell, int scenes, const CommonOptions& common, ErrorTable& table) {
  for (int i = 0; i < scenes; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const HybridScene scene = makeScene(common.seed, index, cell);
    hybridgv::sac::HybridRansacOptions options;
    options.seed = common.seed + index;
    options.threads = common.threads;
    for (const Kinds& kinds : kAllKinds) {
      if (!kinds.points && cell.pointNoise > 0) continue;  // the same as without
      const hybridgv::NoncentralHybridAdapter adapter = adapterOf(scene, kinds);
      int iterations = 0;
      table.add(
          {kinds.name, text(cell.matches), text(100 * cell.outlierShare), text(5 * cell.pointNoise)}, scene.truth,
          [&] { return estimate(adapter, options, &iterations); }, &iterations);
    }
  }
}

void run(const CommonOptions& common, int scenes) {
  const ErrorTable table =
      measureCells(allCells(), common, 8, [&](const Cell& cell, ErrorTable& rows) { measure(cell, scenes, common, rows); });
  table.write(
      common.output, "rays_and_points.csv",
      text(scenes, " scenes each, seed ", common.seed, "; five map cameras, image noise ", kImageNoisePx,
           " px, noise of the 3D points in percent of the mean depth; hybridRansac without options; a failure counts as an "
           "infinite error; hybridgv ",
           hybridgv::version()),
      "kinds,matches_of_each_kind,outlier_percent,point_noise_percent");
}

}  // namespace

int main(int argc, char** argv) {
  return runSceneExperiment(
      argc, argv,
      "hybridRansac on rays alone, on points alone and on both, over the number of matches and the share of wrong ones.", 100,
      run);
}

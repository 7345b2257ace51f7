// What a known focal length buys: hybridRansac with it, without it, and without it with the focal length set right afterwards, when only
// the refinement is left. Over noise of the 3D points, outliers and the number of matches.
//
// Writes known_focal_length.csv.
#include "../common/CsvFile.hpp"
#include "HybridScene.hpp"
#include "cells.hpp"
#include "estimate.hpp"

namespace {

using hybridgv::FocalPose;
using hybridgv::FocalPoses;
using hybridgv::sac::HybridRansacOptions;
using hybridgv::test::HybridScene;

constexpr double kImageNoisePx = 2;

struct Cell {
  int matches;  // of each kind
  double pointNoisePercent, outlierPercent;
};

std::vector<Cell> allCells() {
  std::vector<Cell> cells;
  for (const int matches : {200, 20, 12, 8})
    for (const double noise : {0., 0.5, 1., 2., 3.})
      for (const double outliers : {0, 30, 50, 70}) cells.push_back({matches, noise, outliers});
  return cells;
}

HybridScene makeScene(std::uint64_t seed, std::uint64_t index, const Cell& cell) {
  constexpr double kMeanDepth = 20;
  hybridgv::test::SceneOptions options;
  options.rays = options.points = cell.matches;
  options.imageNoise = kImageNoisePx;
  options.pointNoise = cell.pointNoisePercent / 100 * kMeanDepth;
  options.outlierShareRays = options.outlierSharePoints = cell.outlierPercent / 100;
  hybridgv::test::Random random(seed, index);
  return makeHybridScene(random, options);
}

// The result with unknown focal length, refined with the right one: nothing else is drawn.
FocalPoses corrected(const hybridgv::NoncentralHybridAdapter& adapter, HybridRansacOptions options, FocalPoses unknown,
                     double focalLength) {
  if (unknown.empty()) return {};
  unknown[0].focalLength = focalLength;
  options.initialPose = unknown[0];
  options.knownFocalLengthPx = focalLength;
  options.timeBudgetSeconds = 1e-9;
  int iterations = 0;
  return estimate(adapter, options, &iterations);
}

void measure(const Cell& cell, int scenes, const CommonOptions& common, ErrorTable& table) {
  for (int i = 0; i < scenes; ++i) {
    const HybridScene scene = makeScene(common.seed, static_cast<std::uint64_t>(i), cell);
    const hybridgv::NoncentralHybridAdapter adapter = scene.adapter();
    HybridRansacOptions unknown;
    unknown.seed = common.seed + static_cast<std::uint64_t>(i);
    unknown.threads = common.threads;
    HybridRansacOptions known = unknown;
    known.knownFocalLengthPx = scene.truth.focalLength;
    FocalPoses found;
    int iterations = 0;
    const auto add = [&](const char* name, const auto& solve) {
      table.add({name, text(cell.matches), text(cell.pointNoisePercent), text(cell.outlierPercent)}, scene.truth, solve,
                &iterations);
    };
    add("known", [&] { return estimate(adapter, known, &iterations); });
    add("unknown", [&] { return found = estimate(adapter, unknown, &iterations); });
    add("set afterwards", [&] { return corrected(adapter, unknown, found, scene.truth.focalLength); });
  }
}

void run(const CommonOptions& common, int scenes) {
  const ErrorTable table =
      measureCells(allCells(), common, 7, [&](const Cell& cell, ErrorTable& rows) { measure(cell, scenes, common, rows); });
  table.write(
      common.output, "known_focal_length.csv",
      text(scenes, " scenes each, seed ", common.seed, "; five map cameras, image noise ", kImageNoisePx,
           " px, noise of the 3D points in percent of the mean depth; hybridRansac without other options; set afterwards: the "
           "result with unknown focal length, its focal length corrected and the rest refined (the time is that of the "
           "refinement alone); a failure counts as an infinite error; hybridgv ",
           hybridgv::version()),
      "focal_length,matches_of_each_kind,point_noise_percent,outlier_percent");
}

}  // namespace

int main(int argc, char** argv) {
  return runSceneExperiment(
      argc, argv, "hybridRansac with known focal length, without it, and with a focal length that is set right afterwards.", 100,
      run);
}

// Where the focal length is unknown, hybridRansac draws P3P at a guess of it, around the size of the image. What that is worth where the
// guess is wrong: fields of view from 5 to 140 degrees, for which it is up to 16 times too short or too long; flat and strong relief;
// many and few points; with and without rays; over noise of the points and outliers. Beside it the same search with P4Pf in the place
// of P3P.
//
// Writes focal_length_guess.csv.
#include "../common/CsvFile.hpp"
#include "WideScene.hpp"
#include "cells.hpp"
#include "estimate.hpp"

namespace {

using hybridgv::Solver;
using hybridgv::sac::HybridRansacOptions;
using hybridgv::sac::SolverPrior;
using hybridgv::test::WideSceneOptions;

constexpr double kImageNoisePx = 2, kDegree = 3.14159265358979323846 / 180;

// P4Pf at full weight, and no P3P.
std::vector<SolverPrior> solversWithoutGuess() {
  std::vector<SolverPrior> solvers;
  for (SolverPrior prior : hybridgv::sac::defaultSolvers()) {
    if (prior.solver == Solver::P3P) continue;
    if (prior.solver == Solver::P4Pf) prior.prior = 1;
    solvers.push_back(prior);
  }
  return solvers;
}

struct Relief {
  const char* name;
  double meanDepth, relief;
};
constexpr Relief kReliefs[] = {{"depth 15 to 25", 20, 5}, {"depth 2 to 40", 21, 19}};

struct Cell {
  double fieldOfView;  // [degrees]
  Relief relief;
  int points;
  bool hasRays;
  double pointNoisePercent, outlierPercent;
};

std::vector<Cell> allCells() {
  std::vector<Cell> cells;
  for (const double fieldOfView : {5, 15, 40, 75, 110, 140})
    for (const Relief& relief : kReliefs)
      for (const int points : {200, 20})
        for (const bool hasRays : {false, true})
          for (const double noise : {0, 1, 3})
            for (const double outliers : {0, 30, 50, 70, 80, 90, 95})
              cells.push_back({fieldOfView, relief, points, hasRays, noise, outliers});
  return cells;
}

WideSceneOptions sceneOptions(const Cell& cell) {
  WideSceneOptions options;
  options.leastFocal = options.largestFocal = hybridgv::test::kWideHalfSize / std::tan(cell.fieldOfView / 2 * kDegree);
  options.meanDepth = cell.relief.meanDepth;
  options.relief = cell.relief.relief;
  options.points = cell.points;
  options.rays = cell.hasRays ? cell.points : 0;
  options.pointNoise = cell.pointNoisePercent / 100;
  options.outlierShare = cell.outlierPercent / 100;
  options.imageNoise = kImageNoisePx;
  return options;
}

void measure(const Cell& cell, int scenes, const CommonOptions& common, ErrorTable& table) {
  const struct {
    const char* name;
    std::vector<SolverPrior> solvers;
  } searches[] = {{"P3P at a guess", hybridgv::sac::defaultSolvers()}, {"P4Pf", solversWithoutGuess()}};
  for (int i = 0; i < scenes; ++i) {
    hybridgv::test::Random random(common.seed, static_cast<std::uint64_t>(i));
    const hybridgv::test::HybridScene scene = makeWideScene(random, sceneOptions(cell));
    const hybridgv::NoncentralHybridAdapter adapter = scene.adapter();
    for (const auto& search : searches) {
      HybridRansacOptions options;
      options.solvers = search.solvers;
      options.seed = common.seed + static_cast<std::uint64_t>(i);
      options.threads = common.threads;
      int iterations = 0;
      table.add(
          {text(cell.fieldOfView), cell.relief.name, text(cell.points), cell.hasRays ? "both" : "points",
           text(cell.pointNoisePercent), text(cell.outlierPercent), search.name},
          scene.truth, [&] { return estimate(adapter, options, &iterations); }, &iterations);
    }
  }
}

void run(const CommonOptions& common, int scenes) {
  const ErrorTable table =
      measureCells(allCells(), common, 50, [&](const Cell& cell, ErrorTable& rows) { measure(cell, scenes, common, rows); });
  table.write(
      common.output, "focal_length_guess.csv",
      text(scenes, " scenes each, seed ", common.seed, "; image of 1000 px, noise ", kImageNoisePx,
           " px, noise of the 3D points in percent of the distance; hybridRansac with its default solvers, and with P4Pf in the "
           "place of P3P; a failure counts as an infinite error; hybridgv ",
           hybridgv::version()),
      "field_of_view_deg,relief,points,kinds,point_noise_percent,outlier_percent,search");
}

}  // namespace

int main(int argc, char** argv) {
  return runSceneExperiment(
      argc, argv, "P3P at a guess of the focal length beside P4Pf, where the guess is right and where it is far off.", 20, run);
}

// How reliably every minimal solver finds the truth of noiseless problems, and whether all it returns is right.
//
//   solver_accuracy [--count N] [--seed S] [--solver NAME] [--awkward]
//
// One row per solver (with --awkward: per solver and awkward case): the share of problems whose truth is recovered to 1e-6
// (rotation and relative focal length), the share of failures (nearest solution off by more than 1e-3), median and 99 % quantile
// of log10 of the error, mean number of solutions, solutions that violate their equations by more than 1e-5 px, solutions
// returned twice, the share of problems whose set of solutions is known to be complete (where the solver can tell), and the mean
// and the largest processor time in microseconds (problems are not repeated, so caches are cold).
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "AwkwardProblems.hpp"
#include "H51fScenes.hpp"
#include "H70fScenes.hpp"
#include "MinimalProblem.hpp"
#include "OneCentreProblems.hpp"
#include "SolverConfigurations.hpp"
#include "processorSeconds.hpp"
#include "solvers/MinimalProblems.hpp"
#include "solvers/h51f/solve.hpp"
#include "solvers/h70f/solve.hpp"

namespace {

using namespace hybridgv;
using namespace hybridgv::test;

struct Row {
  std::string name;
  const solvers::MinimalSolver* solver;  // null where completeness is told
  std::size_t exactPoints;               // points whose reprojection error must vanish
  std::function<MinimalProblem(Random&)> makeProblem;
  // Homotopies: in the place of `solve`, the function that counts the ends of its paths.
  int (*solveAndCount)(const MinimalProblem& problem, FocalPose* poses, bool* complete) = nullptr;
};

constexpr solvers::SolveFunction kH51f = &solvers::h51f::solve, kH70f = &solvers::h70f::solve;

int solveH51f(const MinimalProblem& problem, FocalPose* poses, bool* complete) {
  solvers::h51f::EndPoints ends;
  const int found = solvers::h51f::solve(math::simdLevel(), problem.rays.data(), problem.points[0], poses, &ends);
  *complete = ends.complete();
  return found;
}

int solveH70f(const MinimalProblem& problem, FocalPose* poses, bool* complete) {
  solvers::h70f::EndPoints ends;
  const solvers::h70f::Groups groups(problem.rays.data());
  const int found = solvers::h70f::solve(math::simdLevel(), problem.rays.data(), groups, poses, &ends);
  *complete = ends.complete();
  return found;
}

// A homotopy's pattern: the usual scene, or all the others.
void addScenes(const std::string& name, const RaysPerCamera& pattern, const std::vector<MinimalScene>& scenes, bool awkward,
               const Row& like, std::vector<Row>* rows) {
  const int points = static_cast<int>(like.exactPoints);
  const auto add = [&](const std::string& rowName, const std::function<MinimalProblem(Random&)>& makeProblem) {
    rows->push_back(like);
    rows->back().name = rowName;
    rows->back().makeProblem = makeProblem;
  };
  if (!awkward) add(name, [=](Random& random) { return makeMinimalProblem(random, pattern, points); });
  for (const MinimalScene& scene : scenes)
    if (awkward) add(name + ", " + scene.name, [=](Random& random) { return scene.make(random, pattern); });
}

void addHomotopyRows(bool awkward, std::vector<Row>* rows) {
  for (const RaysPerCamera& pattern : h51fPatterns())
    addScenes("h51f_" + nameOf(pattern), pattern, h51fScenes(), awkward, {"", nullptr, 1, {}, &solveH51f}, rows);
  for (const RaysPerCamera& pattern : h70fPatterns()) {
    const bool isClosedForm = pattern[0] == 6;
    const Row like{"", isClosedForm ? solvers::rowsOf("h70f").begin() : nullptr, 0, {}, isClosedForm ? nullptr : &solveH70f};
    addScenes("h70f_" + nameOf(pattern), pattern, h70fScenes(), awkward, like, rows);
  }
}

// The usual scene; or awkward ones with the three points that they are made for.
void addRows(const SolverConfiguration& configuration, bool awkward, std::vector<Row>* rows) {
  const solvers::MinimalSolver& solver = *configuration.solver;
  const auto exactPoints = static_cast<std::size_t>(solver.exactCoordinates / 2);
  const std::vector<int> pattern = configuration.raysPerCamera;
  const int points = solver.points;
  if (!awkward) {
    rows->push_back(
        {configuration.name, &solver, exactPoints, [=](Random& random) { return makeMinimalProblem(random, pattern, points); }});
    return;
  }
  if (points < 3) return;
  for (const AwkwardCase& c : awkwardCases())
    if (!c.needsRay || !pattern.empty())
      rows->push_back({configuration.name + ", " + c.name, &solver, exactPoints,
                       [=](Random& random) { return makeAwkwardProblem(random, c, pattern, points); }});
}

void addOneCentreRows(std::vector<Row>* rows) {
  for (OneCentreKind kind : {OneCentreKind::FiveRaysOnePoint, OneCentreKind::SixRays})
    for (const OneCentreAwkwardCase& c : oneCentreAwkwardCases()) {
      const bool six = kind == OneCentreKind::SixRays;
      rows->push_back({std::string(six ? "sixpt_onefocal, " : "h51f_5, ") + c.name,
                       solvers::rowsOf(six ? "sixpt_onefocal" : "h51f").begin(), six ? 0u : 1u,
                       [=](Random& random) { return makeOneCentreProblem(random, kind, c); }});
    }
}

std::vector<Row> rows(bool awkward) {
  const auto hasRowsOfItsOwn = [](const solvers::MinimalSolver& solver) {
    return solver.solve == kH51f || solver.solve == kH70f;
  };
  std::vector<Row> rows;
  for (const SolverConfiguration& configuration : solverConfigurations())
    if (!hasRowsOfItsOwn(*configuration.solver)) addRows(configuration, awkward, &rows);
  addHomotopyRows(awkward, &rows);
  if (awkward) addOneCentreRows(&rows);
  return rows;
}

// What it costs to read the clock twice, about as much as P3P.
double secondsOfReading() {
  double least = 1;
  for (int i = 0; i < 1000; ++i) {
    const double start = processorSeconds();
    least = std::min(least, processorSeconds() - start);
  }
  return least;
}

void measure(const Row& row, int count, std::uint64_t seed) {
  static const double kReading = secondsOfReading();
  std::vector<double> logErrors;
  std::size_t solutions = 0, wrong = 0, duplicates = 0;
  int recovered = 0, failures = 0, completeSets = 0;
  double seconds = 0, mostSeconds = 0;
  for (int i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const MinimalProblem problem = row.makeProblem(random);
    FocalPoses poses(solvers::kMaxSolutions);
    const double start = processorSeconds();
    bool complete = false;
    const int found = row.solveAndCount ? row.solveAndCount(problem, poses.data(), &complete)
                                        : solvers::solve(*row.solver, problem.rays.data(), problem.points.data(),
                                                         problem.truth.focalLength, poses.data());
    const double spent = processorSeconds() - start - kReading;
    seconds += spent;
    mostSeconds = std::max(mostSeconds, spent);
    poses.resize(static_cast<std::size_t>(found));
    solutions += poses.size();
    completeSets += complete;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      wrong += !(largestResidual(problem, poses[k], row.exactPoints) < 1e-5);
      for (std::size_t j = 0; j < k; ++j) duplicates += poseDistance(poses[k], poses[j]) < 1e-7;
    }
    const double error = distanceToNearest(poses, problem.truth);
    recovered += error < 1e-6;
    failures += !(error < 1e-3);
    logErrors.push_back(std::log10(std::max(error, 1e-16)));
  }
  std::sort(logErrors.begin(), logErrors.end());
  const auto quantile = [&](double q) { return logErrors[static_cast<std::size_t>(q * (count - 1))]; };
  char completeness[16] = "-";
  if (row.solveAndCount) std::snprintf(completeness, sizeof completeness, "%.4f", 100.0 * completeSets / count);
  std::printf("| %-44s | %7d | %8.4f | %7.4f | %6.2f | %6.2f | %5.2f | %5zu | %5zu | %8s | %7.2f | %7.0f |\n", row.name.c_str(),
              count, 100.0 * recovered / count, 100.0 * failures / count, quantile(0.5), quantile(0.99),
              static_cast<double>(solutions) / count, wrong, duplicates, completeness, 1e6 * seconds / count, 1e6 * mostSeconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  int count = 10000;
  std::uint64_t seed = 1;
  std::string solver;
  bool awkward = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--count") == 0 && i + 1 < argc) {
      count = std::max(1, std::atoi(argv[++i]));
    } else if (std::strcmp(argv[i], "--seed") == 0 && i + 1 < argc) {
      seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (std::strcmp(argv[i], "--solver") == 0 && i + 1 < argc) {
      solver = argv[++i];
    } else if (std::strcmp(argv[i], "--awkward") == 0) {
      awkward = true;
    } else {
      return std::fprintf(stderr, "usage: %s [--count N] [--seed S] [--solver NAME] [--awkward]\n", argv[0]), 2;
    }
  }
  std::printf("| %-44s | %7s | %8s | %7s | %6s | %6s | %5s | %5s | %5s | %8s | %7s | %7s |\n", "solver", "count", "found %",
              "fail %", "median", "99 %", "sol.", "wrong", "twice", "complete", "us", "most us");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows(awkward))
    if (row.name.compare(0, solver.size(), solver) == 0) measure(row, count, seed);
}

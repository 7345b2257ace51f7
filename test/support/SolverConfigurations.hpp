// Every minimal problem with every way in which its rays can be shared among rig cameras.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "solvers/MinimalProblems.hpp"

namespace hybridgv {
namespace test {

struct SolverConfiguration {
  std::string name;  // "p4pf", "h32f_21"
  std::vector<int> raysPerCamera;
  const solvers::MinimalSolver* solver;  // the row of the table that such samples have
};

inline void addPartitions(int left, int largest, std::vector<int>& parts, std::vector<std::vector<int>>& partitions) {
  if (left == 0) partitions.push_back(parts);
  for (int part = 1; part <= std::min(left, largest); ++part) {
    parts.push_back(part);
    addPartitions(left - part, part, parts, partitions);
    parts.pop_back();
  }
}

// {1, 1, 1}, {2, 1}, {3} for three rays.
inline std::vector<std::vector<int>> waysToShare(int rays) {
  std::vector<int> parts;
  std::vector<std::vector<int>> partitions;
  addPartitions(rays, rays, parts, partitions);
  return partitions;
}

inline const solvers::MinimalSolver* solverFor(const solvers::SolverRows& problem, const std::vector<int>& raysPerCamera) {
  std::vector<solvers::RayMatch> rays;
  for (std::size_t camera = 0; camera < raysPerCamera.size(); ++camera)
    for (int i = 0; i < raysPerCamera[camera]; ++i)
      rays.push_back({0, 0, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), static_cast<int>(camera)});
  return problem.forSample(rays.data());
}

// Without those that have no finite number of solutions: rays of one camera for a row that draws them from several.
inline std::vector<SolverConfiguration> configurationsOf(const solvers::SolverRows& problem) {
  std::vector<SolverConfiguration> result;
  for (const std::vector<int>& raysPerCamera : waysToShare(problem.rays())) {
    const solvers::MinimalSolver* const solver = solverFor(problem, raysPerCamera);
    const bool isOneCamera = raysPerCamera.size() == 1;
    if (solver && !(isOneCamera && solver->draw == solvers::RayDraw::Spread))
      result.push_back({problem.name(), raysPerCamera, solver});
  }
  if (result.size() == 1) return result;
  for (SolverConfiguration& configuration : result) {
    configuration.name += "_";
    for (const int count : configuration.raysPerCamera) configuration.name += std::to_string(count);
  }
  return result;
}

// In the table's order, those of one problem together.
inline std::vector<SolverConfiguration> solverConfigurations() {
  std::vector<SolverConfiguration> result;
  for (const solvers::SolverRows& problem : solvers::minimalProblems())
    for (const SolverConfiguration& configuration : configurationsOf(problem)) result.push_back(configuration);
  return result;
}

// The focal length for a call of something that takes it only for solvers that need it.
inline std::optional<double> focalLengthFor(Solver solver, double focalLength) {
  if (solvers::rowsOf(solver).begin()->intrinsics.focalLength) return {};
  return focalLength;
}

// The first value behind the enumerators, and others that are none.
inline std::vector<Solver> noSolvers() {
  const int count = static_cast<int>(allSolvers().size());
  return {static_cast<Solver>(-1), static_cast<Solver>(count), static_cast<Solver>(1000)};
}

}  // namespace test
}  // namespace hybridgv

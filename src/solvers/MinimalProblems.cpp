#include "solvers/MinimalProblems.hpp"

#include "CheckArguments.hpp"

namespace hybridgv {
namespace solvers {

bool canGive(const MinimalSolver& solver, const RayMatch* rays) {
  const auto isOfFirstCamera = [rays](const RayMatch& ray) { return ray.camera == rays[0].camera; };
  return solver.draw != RayDraw::OneCamera || std::all_of(rays, rays + solver.rays, isOfFirstCamera);
}

const MinimalSolver* SolverRows::forSample(const RayMatch* rays) const {
  const auto found = std::find_if(begin_, end_, [rays](const MinimalSolver& solver) { return canGive(solver, rays); });
  return found == end_ ? nullptr : found;
}

SolverRows rowsOf(Solver id) {
  for (const MinimalSolver& solver : kMinimalSolvers)
    if (solver.id == id) return rowsOf(solver.name);
  throwInvalid("solver", "no such value: " + std::to_string(static_cast<int>(id)));
}

std::vector<SolverRows> minimalProblems() {
  std::vector<SolverRows> result;
  for (const MinimalSolver* row = std::begin(kMinimalSolvers); row != std::end(kMinimalSolvers); row = result.back().end())
    result.push_back(rowsOf(row->name));
  return result;
}

void throwUnknownProblem(std::string_view name) {
  std::string valid;
  for (const SolverRows& problem : minimalProblems()) valid += std::string(valid.empty() ? "" : ", ") + problem.name();
  throwInvalid("solver", "unknown name \"" + std::string(name) + "\", valid are " + valid);
}

}  // namespace solvers
}  // namespace hybridgv

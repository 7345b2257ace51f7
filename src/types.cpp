#include "hybridgv/types.hpp"

#include "CheckArguments.hpp"
#include "solvers/MinimalProblems.hpp"

namespace hybridgv {

const char* toString(Solver solver) { return solvers::rowsOf(solver).name(); }

std::vector<Solver> allSolvers() {
  std::vector<Solver> result;
  for (const solvers::SolverRows& problem : solvers::minimalProblems())
    if (problem.id()) result.push_back(*problem.id());
  return result;
}

Solver solverFromString(const std::string& name) {
  std::string valid;
  for (const Solver solver : allSolvers()) {
    if (name == toString(solver)) return solver;
    valid += std::string(valid.empty() ? "" : ", ") + toString(solver);
  }
  throwInvalid("solver", "unknown name \"" + name + "\", valid are " + valid);
}

const char* version() { return HYBRIDGV_VERSION_STRING; }

}  // namespace hybridgv

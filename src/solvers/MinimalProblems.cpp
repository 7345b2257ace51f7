#include "solvers/MinimalProblems.hpp"

#include <stdexcept>

#include "solvers/solvers.hpp"

namespace hybridgv {
namespace solvers {

static const MinimalSolver kMinimalSolvers[] = {
    {Solver::P4Pf, "p4pf", 0, 4, 6, 1.4, &three_points::p4pf},  {Solver::P35Pf, "p35pf", 0, 4, 10, 2.0, &three_points::p35pf},
    {Solver::H13f, "h13f", 1, 3, 12, 2.7, &three_points::h13f}, {Solver::H32f, "h32f", 3, 2, 26, 8, &h32f::solve},
    {Solver::H51f, "h51f", 5, 1, 56, 220, &h51f::solve},
};

const MinimalSolver& minimalSolver(Solver id) {
  for (const MinimalSolver& solver : kMinimalSolvers)
    if (solver.id == id) return solver;
  throw std::invalid_argument("hybridgv::Solver: no such minimal solver: " + std::to_string(static_cast<int>(id)));
}

}  // namespace solvers
}  // namespace hybridgv

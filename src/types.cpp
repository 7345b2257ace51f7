#include "hybridgv/types.hpp"

#include <stdexcept>

namespace hybridgv {

static constexpr struct {
  Solver solver;
  const char* name;
} kNames[] = {
    {Solver::P4Pf, "p4pf"}, {Solver::P35Pf, "p35pf"}, {Solver::H13f, "h13f"}, {Solver::H32f, "h32f"}, {Solver::H51f, "h51f"}};

const char* toString(Solver solver) {
  for (const auto& entry : kNames)
    if (entry.solver == solver) return entry.name;
  throw std::invalid_argument("hybridgv: solver: no such value: " + std::to_string(static_cast<int>(solver)));
}

Solver solverFromString(const std::string& name) {
  std::string valid;
  for (const auto& entry : kNames) {
    if (name == entry.name) return entry.solver;
    valid += std::string(valid.empty() ? "" : ", ") + entry.name;
  }
  throw std::invalid_argument("hybridgv: solver: unknown name \"" + name + "\", valid are " + valid);
}

const char* version() { return HYBRIDGV_VERSION_STRING; }

}  // namespace hybridgv

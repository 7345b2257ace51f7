// Runs a minimal solver, through the body of its public function, on arbitrary doubles:
//
//     solver_fuzzer --solver=NAME [options of libFuzzer] [FOLDER|FILE ..]
//     solver_fuzzer --list     the names, one a line
//
// It stops if the solver breaks a promise: std::invalid_argument for data that are not finite, otherwise at most so many poses,
// each of which is one and satisfies the equations up to rounding.
#include <optional>
#include <vector>

#include "EquationCheck.hpp"
#include "RawAdapter.hpp"
#include "correspondences/numberCameras.hpp"
#include "hybrid_pose/solveSample.hpp"

namespace {

using namespace hybridgv;

std::optional<solvers::SolverRows> chosen;

void listNames() {
  for (const solvers::SolverRows& problem : solvers::minimalProblems()) std::printf("%s\n", problem.name());
}

void choose(const char* name) {
  try {
    chosen = solvers::rowsOf(name);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(2);
  }
}

// The solver that the public function takes: a rig camera is known by its centre, not by the number in the sample.
const solvers::MinimalSolver* solverOf(std::vector<solvers::RayMatch> rays) {
  correspondences::numberCamerasOfSample(rays.data(), static_cast<int>(rays.size()));
  return chosen->forSample(rays.data());
}

}  // namespace

// libFuzzer ignores options that start with two dashes.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string option = "--solver=";
  for (int i = 1; i < *argc; ++i) {
    const std::string argument = (*argv)[i];
    if (argument == "--list") {
      listNames();
      std::exit(0);
    }
    if (argument.compare(0, option.size(), option) == 0) choose(argument.c_str() + option.size());
  }
  if (chosen) return 0;
  std::fprintf(stderr, "usage: solver_fuzzer --solver=NAME [options of libFuzzer] [FOLDER|FILE ..] | --list\n");
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Sample sample =
      fuzz::decodeSample(data, size, static_cast<std::size_t>(chosen->rays()), static_cast<std::size_t>(chosen->points()));
  FocalPoses poses;
  try {
    poses = hybrid_pose::solve(*chosen, fuzz::RawAdapter(sample), fuzz::kFocalLength);
  } catch (const std::invalid_argument&) {
    // Also for a ray without direction, and for rays of several cameras where one is demanded.
    return 0;
  }
  if (!fuzz::isFinite(sample)) fuzz::reportFault("data that are not finite are refused");
  const solvers::MinimalSolver* const solver = solverOf(sample.rays);
  if (!solver) fuzz::reportFault("a sample that no solver takes is refused");
  if (poses.size() > static_cast<std::size_t>(solver->maxSolutions))
    fuzz::reportFault("there are not more solutions than the problem has");
  const test::EquationCheck equations(sample.rays, sample.points, static_cast<std::size_t>(solver->exactCoordinates));
  for (const FocalPose& pose : poses) {
    const std::string violation = equations.violation(pose);
    if (!violation.empty()) fuzz::reportFault(violation.c_str());
  }
  return 0;
}

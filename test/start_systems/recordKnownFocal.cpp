// Writes problems with known focal length with all their solutions, in the format of GoldenProblems.hpp:
// recordKnownFocal NAME SEED COUNT > NAME.txt, the name p3p, h22_11, h22_2, h41, h60 or fivept.
//
// The solutions come from a system of seven equations in the unknowns of H70f, see KnownFocalFamily.hpp, of which all paths are
// followed.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "SolverConfigurations.hpp"
#include "start_systems/KnownFocalFamily.hpp"
#include "start_systems/Recording.hpp"

namespace hybridgv {
namespace test {
namespace {

using Family = KnownFocalFamily;
using System = Family::PathProblem::System;

std::vector<SolverConfiguration> configurations() {
  std::vector<SolverConfiguration> result;
  for (const SolverConfiguration& configuration : solverConfigurations())
    if (!configuration.solver->intrinsics.focalLength) result.push_back(configuration);
  return result;
}

// Five rays leave the scale open: with a sixth of another camera all six equations have the same motions.
bool lacksScale(const SolverConfiguration& configuration) { return configuration.raysPerCamera == std::vector<int>{5}; }

Family::Sharing sharingOf(const SolverConfiguration& configuration) {
  Family::Sharing sharing{configuration.raysPerCamera, configuration.solver->points};
  if (lacksScale(configuration)) sharing.raysPerCamera.push_back(1);
  return sharing;
}

std::size_t numberOfSolutions(const Family::Sharing& sharing) {
  if (sharing.points == 3) return 8;
  return sharing.points == 2 ? 16 : 20;
}

FocalPoses allPoses(const MinimalProblem& problem, const KnownSystem<Family>& known) {
  const solvers::complex_rays::Frame frame = Family::frameOf(known.sharing, problem);
  const Family::Parameters target = Family::parametersIn(frame, problem);
  const auto ends = math::trackCarefully<System>(Family::straightHomotopy(known.parameters, target), known.solutions);
  if (ends.size() != known.solutions.size()) std::abort();
  return realPoses(ends, frame);
}

// The motions at distance 1 from the centre, on either side of it: the sixth ray, which has told the side, is left out.
FocalPoses withoutScale(const FocalPoses& poses, const Eigen::Vector3d& centre) {
  FocalPoses result;
  for (const FocalPose& pose : poses)
    for (const double side : {-1.0, 1.0}) {
      result.push_back(pose);
      result.back().position = centre + side * (pose.position - centre).normalized();
    }
  return result;
}

void record(const SolverConfiguration& configuration, std::uint64_t seed, std::size_t count) {
  Random random(seed);
  const Family::Sharing sharing = sharingOf(configuration);
  const KnownSystem<Family> known = solveByMonodromy<Family>(sharing, 10, random);
  if (known.solutions.size() != numberOfSolutions(sharing)) std::abort();
  std::printf("# recordKnownFocal %s %llu %zu\n", configuration.name.c_str(), static_cast<unsigned long long>(seed), count);
  for (std::size_t i = 0; i < count; ++i) {
    MinimalProblem problem = makeMinimalProblem(random, sharing.raysPerCamera, sharing.points);
    FocalPoses poses = allPoses(problem, known);
    if (lacksScale(configuration)) {
      problem.rays.pop_back();
      poses = withoutScale(poses, problem.rays[0].centre);
    }
    print(i, problem, solutionsAmong(poses, problem));
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

int main(int argc, char** argv) {
  using namespace hybridgv::test;
  if (argc == 4)
    for (const SolverConfiguration& configuration : configurations())
      if (configuration.name == argv[1]) {
        record(configuration, std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
        return 0;
      }
  std::fprintf(stderr, "usage: %s NAME SEED COUNT, the name one of", argv[0]);
  for (const SolverConfiguration& configuration : configurations()) std::fprintf(stderr, " %s", configuration.name.c_str());
  std::fprintf(stderr, "\n");
  return 2;
}

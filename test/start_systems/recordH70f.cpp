// Writes problems of H70f with all their solutions, in the format of GoldenProblems.hpp: recordH70f PATTERN SEED COUNT > h70f_PATTERN.txt
//
// PATTERN gives the rays of each centre, as in 4111. The solutions do not come from the library's solver: a system is solved by
// monodromy, and all its paths are followed to each problem in double precision with small steps.
#include <cstdio>
#include <cstdlib>

#include "start_systems/Recording.hpp"

namespace hybridgv {
namespace test {
namespace {

using namespace solvers::h70f;
using System = H70fFamily::PathProblem::System;

FocalPoses solutionsOf(const MinimalProblem& problem, const KnownSystem<H70fFamily>& known) {
  solvers::RayMatch rays[kRays];
  const StartSystem start{known.sharing, 0, known.parameters, nullptr};
  arrange(problem.rays.data(), Groups(problem.rays.data()), start, rays);
  Frame frame;
  normalize(known.sharing, rays, &frame);
  const Parameters target = alignWith(start, rays, &frame);
  const auto ends = math::trackCarefully<System>(straightHomotopy(known.parameters, target), known.solutions);
  if (ends.size() != known.solutions.size()) std::abort();
  return solutionsAmong(realPoses(ends, frame), problem);
}

void record(const std::string& pattern, std::uint64_t seed, std::size_t count) {
  std::vector<int> raysPerCamera;
  for (const char digit : pattern) raysPerCamera.push_back(digit - '0');
  Random random(seed);
  const MinimalProblem any = makeMinimalProblem(random, raysPerCamera, 0);
  const KnownSystem<H70fFamily> known = solveByMonodromy<H70fFamily>(sharingOf(Groups(any.rays.data())), 10, random);
  if (static_cast<int>(known.solutions.size()) != caseOf(known.sharing).solutions) std::abort();
  std::printf("# recordH70f %s %llu %zu\n", pattern.c_str(), static_cast<unsigned long long>(seed), count);
  for (std::size_t i = 0; i < count; ++i) {
    const MinimalProblem problem = makeMinimalProblem(random, raysPerCamera, 0);
    print(i, problem, solutionsOf(problem, known));
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

int main(int argc, char** argv) {
  const std::string pattern = argc == 4 ? argv[1] : "";
  int rays = 0;
  for (const char digit : pattern) rays += digit - '0';
  if (rays != hybridgv::solvers::h70f::kRays || pattern[0] > '5') {
    std::fprintf(stderr, "usage: %s PATTERN SEED COUNT, the pattern 52, 511, 43 .. 1111111\n", argv[0]);
    return 2;
  }
  hybridgv::test::record(pattern, std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
}

#include "start_systems/H70fFamily.hpp"

#include <cstdlib>

namespace hybridgv {
namespace test {

using namespace solvers::h70f;

const std::vector<std::vector<int>>& H70fFamily::trainingPatterns(Sharing sharing) {
  static const std::vector<std::vector<int>> kPatterns[] = {
      {{1, 1, 1, 1, 1, 1, 1}, {2, 1, 1, 1, 1, 1}, {2, 2, 1, 1, 1}, {2, 2, 2, 1}},
      {{3, 1, 1, 1, 1}, {3, 2, 1, 1}, {3, 2, 2}},
      {{3, 3, 1}},
      {{4, 1, 1, 1}, {4, 2, 1}},
      {{4, 3}},
      {{5, 1, 1}, {5, 2}}};
  return kPatterns[static_cast<int>(sharing)];
}

KnownSystem<H70fFamily> H70fFamily::randomRealSystem(Sharing sharing, Random& random) {
  const MinimalProblem problem = makeMinimalProblem(random, trainingPatterns(sharing)[0], kPoints);
  solvers::RayMatch rays[kRays];
  const StartSystem anyOrder{sharing, 0, {}, nullptr};
  arrange(problem.rays.data(), Groups(problem.rays.data()), anyOrder, rays);
  Frame frame;
  normalize(sharing, rays, &frame);
  const Solution truth = solutionOf(problem.truth, frame);
  return {sharing,
          parametersIn(frame, sharing, rays),
          {pointOf<kUnknowns>({truth.x, truth.y, truth.tauBar, truth.tau, truth.t3, truth.alpha, truth.beta})}};
}

void H70fFamily::restoreSharedCentres(Sharing sharing, Parameters* parameters) {
  for (int j = 0; j < kRays; ++j) {
    if (caseOf(sharing).isOfFirst(j)) restoreMoment(j, 0, parameters);
    if (caseOf(sharing).isOfSecond(j)) restoreMoment(j, kSecondCentre, parameters);
  }
}

H70fFamily::Sample H70fFamily::sampleOf(Sharing sharing, const MinimalProblem& problem) {
  if (sharingOf(Groups(problem.rays.data())) != sharing) std::abort();
  return problem.rays;
}

H70fFamily::Parameters H70fFamily::targetOf(const Sample& sample, const StartSystem& start) {
  solvers::RayMatch rays[kRays];
  arrange(sample.data(), Groups(sample.data()), start, rays);
  Frame frame;
  normalize(start.sharing, rays, &frame);
  return alignWith(start, rays, &frame);
}

}  // namespace test
}  // namespace hybridgv

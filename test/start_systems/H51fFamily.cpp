#include "start_systems/H51fFamily.hpp"

#include <cstdlib>

namespace hybridgv {
namespace test {

using namespace solvers::h51f;

const std::vector<std::vector<int>>& H51fFamily::trainingPatterns(Sharing sharing) {
  static const std::vector<std::vector<int>> kPatterns[] = {
      {{1, 1, 1, 1, 1}, {2, 1, 1, 1}, {2, 2, 1}}, {{3, 1, 1}, {3, 2}}, {{4, 1}}};
  return kPatterns[static_cast<int>(sharing)];
}

KnownSystem<H51fFamily> H51fFamily::randomRealSystem(Sharing sharing, Random& random) {
  const MinimalProblem problem = makeMinimalProblem(random, trainingPatterns(sharing)[0], kPoints);
  const Sample sample = sampleOf(sharing, problem);
  Frame frame;
  normalize(sharing, sample.rays, sample.point, &frame);
  const Solution truth = solutionOf(problem.truth, frame, sample.point);
  return {sharing,
          parametersIn(frame, sharing, sample.rays, sample.point),
          {pointOf<kUnknowns>({truth.x, truth.y, truth.alpha, truth.beta, truth.d})}};
}

H51fFamily::Sample H51fFamily::sampleOf(Sharing sharing, const MinimalProblem& problem) {
  Sample sample;
  sample.point = problem.points[0];
  if (arrange(problem.rays.data(), sample.point, sample.rays) != sharing) std::abort();
  return sample;
}

H51fFamily::Parameters H51fFamily::targetOf(const Sample& sample, const StartSystem& start) {
  Frame frame;
  normalize(start.sharing, sample.rays, sample.point, &frame);
  alignWith(start, sample.rays, sample.point, &frame);
  Parameters target = parametersIn(frame, start.sharing, sample.rays, sample.point);
  solvers::complex_rays::scaleRaysLike<kRays>(start.parameters, &target);
  return target;
}

}  // namespace test
}  // namespace hybridgv

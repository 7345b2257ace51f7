#include "start_systems/H51fMonodromy.hpp"

#include "MinimalProblem.hpp"
#include "start_systems/Monodromy.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using namespace HYBRIDGV_INSTRUCTION_SET;
using Number = std::complex<double>;

constexpr double kLoopDeviation = 0.4;

KnownSystem randomRealSystem(Sharing sharing, test::Random& random) {
  static const std::vector<int> kRaysPerCamera[] = {{1, 1, 1, 1, 1}, {3, 1, 1}, {4, 1}};
  const test::MinimalProblem problem = test::makeMinimalProblem(random, kRaysPerCamera[static_cast<int>(sharing)], 1);
  const solvers::PointMatch& point = problem.points[0];
  solvers::RayMatch rays[kRays];
  arrange(problem.rays.data(), point, rays);
  Frame frame;
  normalize(sharing, rays, point, &frame);
  const Solution truth = solutionOf(problem.truth, frame, point);
  KnownSystem system{sharing, parametersIn(frame, sharing, rays, point), {KnownSolution{}}};
  const Number unknowns[] = {truth.x, truth.y, truth.alpha, truth.beta, truth.d};
  for (int k = 0; k < kUnknowns; ++k) {
    system.solutions[0].re[k] = unknowns[k].real();
    system.solutions[0].im[k] = unknowns[k].imag();
  }
  return system;
}

static void perturb(ComplexNumber& number, double deviation, test::Random& random) {
  number.re += deviation * random.normal();
  number.im += deviation * random.normal();
}

Parameters perturbed(Sharing sharing, const Parameters& parameters, double deviation, test::Random& random) {
  Parameters p = parameters;
  for (int j = 0; j < kRays; ++j) {
    for (ComplexNumber& q : p.direction[j]) perturb(q, deviation, random);
    for (ComplexNumber& m : p.moment[j]) perturb(m, deviation, random);
    perturb(p.image[j], deviation / 2, random);
    perturb(p.imageBar[j], deviation / 2, random);
  }
  perturb(p.pointImage, deviation / 2, random);
  perturb(p.pointImageBar, deviation / 2, random);
  restoreSharedCentre(sharing, &p);
  return p;
}

void restoreSharedCentre(Sharing sharing, Parameters* parameters) {
  for (int j = 0; j < caseOf(sharing).sharedRays; ++j) {  // q x (0, 0, kSharedCentre)
    const ComplexNumber* q = parameters->direction[j];
    ComplexNumber* m = parameters->moment[j];
    m[0] = {kSharedCentre * q[1].re, kSharedCentre * q[1].im};
    m[1] = {-kSharedCentre * q[0].re, -kSharedCentre * q[0].im};
    m[2] = {0, 0};
  }
}

bool moveTo(const Parameters& parameters, KnownSystem* system) {
  const Homotopy<double> way = straightHomotopy(system->parameters, parameters);
  system->parameters = parameters;
  return moveAll<H51fSystem>(way, &system->solutions);
}

KnownSystem solveByMonodromy(Sharing sharing, int idleLoops, test::Random& random) {
  KnownSystem system;
  Parameters real;
  const auto randomParameters = [&] { return perturbed(sharing, real, kLoopDeviation, random); };
  do {
    system = randomRealSystem(sharing, random);
    real = system.parameters;
  } while (!moveTo(randomParameters(), &system));
  addByMonodromy<H51fSystem>(system.parameters, straightHomotopy, randomParameters, idleLoops, &system.solutions);
  return system;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

#include "solvers/h51f/Monodromy.hpp"

#include <cmath>
#include <numeric>

#include "MinimalProblem.hpp"

namespace hybridgv {
namespace h51f {

using namespace HYBRIDGV_INSTRUCTION_SET;
using Tracker = PathTracker<H51fSystem, Doubles, Pivoting::Rows>;
using Number = std::complex<double>;

constexpr double kLoopDeviation = 0.4;
constexpr double kDistinct = 1e-6;

int solutionCount(Sharing sharing) { return sharing == Sharing::AtMostTwo ? 56 : sharing == Sharing::Three ? 50 : 36; }

KnownSystem randomRealSystem(Sharing sharing, test::Random& random) {
  static const std::vector<int> kRaysPerCamera[] = {{1, 1, 1, 1, 1}, {3, 1, 1}, {4, 1}};
  const test::MinimalProblem problem = test::makeMinimalProblem(random, kRaysPerCamera[static_cast<int>(sharing)], 1);
  const solvers::PointMatch& point = problem.points[0];
  solvers::RayMatch rays[kRays];
  arrange(problem.rays.data(), point, rays);
  Frame frame;
  normalise(sharing, rays, point, &frame);
  const Solution truth = solutionOf(problem.truth, frame, point);
  KnownSystem system{sharing, parametersIn(frame, sharing, rays, point), {KnownSolution{}}};
  const Number unknowns[] = {truth.x, truth.y, truth.alpha, truth.beta, truth.d};
  for (int k = 0; k < kUnknowns; ++k)
    system.solutions[0].re[k] = unknowns[k].real(), system.solutions[0].im[k] = unknowns[k].imag();
  return system;
}

static void perturb(ComplexNumber& number, double deviation, test::Random& random) {
  number.re += deviation * random.normal(), number.im += deviation * random.normal();
}

Parameters perturbed(Sharing sharing, const Parameters& parameters, double deviation, test::Random& random) {
  Parameters p = parameters;
  for (int j = 0; j < kRays; ++j) {
    for (ComplexNumber& q : p.direction[j]) perturb(q, deviation, random);
    for (ComplexNumber& m : p.moment[j]) perturb(m, deviation, random);
    perturb(p.image[j], deviation / 2, random), perturb(p.imageBar[j], deviation / 2, random);
  }
  perturb(p.pointImage, deviation / 2, random), perturb(p.pointImageBar, deviation / 2, random);
  restoreSharedCentre(sharing, &p);
  return p;
}

void restoreSharedCentre(Sharing sharing, Parameters* parameters) {
  for (int j = 0; j < sharedRays(sharing); ++j) {  // q x (0, 0, kSharedCentre)
    const ComplexNumber* q = parameters->direction[j];
    ComplexNumber* m = parameters->moment[j];
    m[0] = {kSharedCentre * q[1].re, kSharedCentre * q[1].im};
    m[1] = {-kSharedCentre * q[0].re, -kSharedCentre * q[0].im};
    m[2] = {0, 0};
  }
}

static bool coincide(const KnownSolution& a, const KnownSolution& b) {
  for (int k = 0; k < kUnknowns; ++k)
    if (std::hypot(a.re[k] - b.re[k], a.im[k] - b.im[k]) > kDistinct * (1 + std::hypot(a.re[k], a.im[k]))) return false;
  return true;
}

// Tracks the solutions that are there; those whose path fails are dropped.
static void moveWhatCanBeMoved(const Parameters& parameters, KnownSystem* system) {
  const std::size_t count = system->solutions.size();
  const Homotopy<double> path = straightHomotopy(system->parameters, parameters);
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  std::vector<KnownSolution> tangents(count), moved(count);
  std::vector<PathEnd<double, kUnknowns>> ends(count);
  std::vector<double> lastStep(count);
  const int n = static_cast<int>(count);
  Tracker::startTangents(path, system->solutions.data(), all.data(), n, tangents.data());
  Tracker::track(path, system->solutions.data(), tangents.data(), all.data(), n, {1e-3, 1e-2, 1e-5, 0.01, 0.1, 1e-13, 3000},
                 ends.data());
  for (std::size_t i = 0; i < count; ++i) moved[i] = ends[i].point;
  newtonSteps<H51fSystem, Doubles, Pivoting::Rows>(path, 1.0, moved.data(), all.data(), n, 5, 0.0, lastStep.data());
  system->parameters = parameters;
  system->solutions.clear();
  for (std::size_t i = 0; i < count; ++i)
    if (ends[i].reached && lastStep[i] < 1e-10) system->solutions.push_back(moved[i]);
}

bool moveTo(const Parameters& parameters, KnownSystem* system) {
  const std::size_t count = system->solutions.size();
  moveWhatCanBeMoved(parameters, system);
  for (std::size_t i = 0; i < system->solutions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (coincide(system->solutions[i], system->solutions[j])) return false;
  return system->solutions.size() == count;
}

KnownSystem solveByMonodromy(Sharing sharing, int idleLoops, test::Random& random) {
  KnownSystem system;
  Parameters real;
  do {
    system = randomRealSystem(sharing, random);
    real = system.parameters;
  } while (!moveTo(perturbed(sharing, real, kLoopDeviation, random), &system));
  for (int idle = 0; idle < idleLoops; ++idle) {
    KnownSystem moving = system;
    moveWhatCanBeMoved(perturbed(sharing, real, kLoopDeviation, random), &moving);
    moveWhatCanBeMoved(perturbed(sharing, real, kLoopDeviation, random), &moving);
    moveWhatCanBeMoved(system.parameters, &moving);
    for (const KnownSolution& end : moving.solutions) {
      bool known = false;
      for (const KnownSolution& solution : system.solutions) known = known || coincide(solution, end);
      if (!known) system.solutions.push_back(end), idle = -1;
    }
  }
  return system;
}

}  // namespace h51f
}  // namespace hybridgv

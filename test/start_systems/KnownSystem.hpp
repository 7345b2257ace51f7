// Start systems: finds all solutions of a random complex system by monodromy, and moves known solutions to other systems. Needed
// to make the tables of the library, not to use them. For any problem that is solved by following paths; a class Family gives
//   PathProblem, Sharing, Parameters, StartSystem
//   caseOf(sharing)              its row of the library's table: name, solutions, start
//   trainingPatterns(sharing)    the ways in which the rays of its samples may share centres, the plainest first
//   kPoints                      how many 3D points a sample has
//   kTrainingSamples, kTrainingPeriod     of the search; of the period the first half are of the usual scene
//   randomRealSystem(sharing, random)     a random real sample with its true solution, normalized and arranged
//   straightHomotopy(start, target)       the way between two systems
//   forEachNumber(parameters, f)          calls f(number, deviation): how much it is changed, of the deviation of the others
//   restoreSharedCentres(sharing, &parameters)   makes the moments of shared rays those of rays through the shared centre
//   Sample, sampleOf(sharing, problem), targetOf(sample, start)   a sample, and its data aligned with a start system
#pragma once

#include <complex>
#include <vector>

#include "Random.hpp"
#include "solvers/complex_rays/ComplexRays.hpp"
#include "start_systems/Monodromy.hpp"

namespace hybridgv {
namespace test {

template <class Family>
struct KnownSystem {
  using System = typename Family::PathProblem::System;

  typename Family::Sharing sharing;
  typename Family::Parameters parameters;
  math::Solutions<System> solutions;
};

// Adds complex Gaussian numbers of the given standard deviation (of real and imaginary part); a shared centre stays where it is.
template <class Family>
typename Family::Parameters perturbed(typename Family::Sharing sharing, typename Family::Parameters parameters, double deviation,
                                      Random& random) {
  Family::forEachNumber(parameters, [&](auto& number, double share) {
    number.re += deviation * share * random.normal();
    number.im += deviation * share * random.normal();
  });
  Family::restoreSharedCentres(sharing, &parameters);
  return parameters;
}

// Tracks the solutions to other parameters, carefully. False if a path fails or two end points coincide.
template <class Family>
bool moveTo(const typename Family::Parameters& parameters, KnownSystem<Family>* system) {
  const auto way = Family::straightHomotopy(system->parameters, parameters);
  system->parameters = parameters;
  return math::moveAll<typename KnownSystem<Family>::System>(way, &system->solutions);
}

// A complex system near a random real one with all solutions that monodromy finds: the known solutions are tracked around
// triangles in the space of parameters, which permutes all solutions, until `idleLoops` triangles in a row have given nothing
// new.
template <class Family>
KnownSystem<Family> solveByMonodromy(typename Family::Sharing sharing, int idleLoops, Random& random) {
  constexpr double kLoopDeviation = 0.4;
  KnownSystem<Family> system;
  typename Family::Parameters real;
  const auto randomParameters = [&] { return perturbed<Family>(sharing, real, kLoopDeviation, random); };
  do {
    system = Family::randomRealSystem(sharing, random);
    real = system.parameters;
  } while (!moveTo(randomParameters(), &system));
  math::addByMonodromy<typename KnownSystem<Family>::System>(system.parameters, &Family::straightHomotopy, randomParameters,
                                                             idleLoops, &system.solutions);
  return system;
}

// Calls f for the numbers of rays; image points are changed half as much.
template <int Rays, class Function>
void forEachNumberOfRays(solvers::complex_rays::ComplexRays<Rays>& rays, Function f) {
  constexpr double kImageShare = 0.5;
  for (int j = 0; j < Rays; ++j) {
    for (solvers::complex_rays::ComplexNumber& q : rays.direction[j]) f(q, 1.0);
    for (solvers::complex_rays::ComplexNumber& m : rays.moment[j]) f(m, 1.0);
    f(rays.image[j], kImageShare);
    f(rays.imageBar[j], kImageShare);
  }
}

// q x (0, 0, centre)
template <int Rays>
void restoreMoment(int ray, double centre, solvers::complex_rays::ComplexRays<Rays>* rays) {
  const solvers::complex_rays::ComplexNumber* q = rays->direction[ray];
  solvers::complex_rays::ComplexNumber* m = rays->moment[ray];
  m[0] = {centre * q[1].re, centre * q[1].im};
  m[1] = {-centre * q[0].re, -centre * q[0].im};
  m[2] = {0, 0};
}

// A solution as a point.
template <int N>
math::Point<double, N> pointOf(const std::complex<double> (&unknowns)[N]) {
  math::Point<double, N> point;
  for (int k = 0; k < N; ++k) {
    point.re[k] = unknowns[k].real();
    point.im[k] = unknowns[k].imag();
  }
  return point;
}

}  // namespace test
}  // namespace hybridgv

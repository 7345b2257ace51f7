// Start systems: finds all solutions of a random complex system by monodromy, and moves known solutions to other systems. Needed
// to make the tables of the library, not to use them.
#pragma once

#include <vector>

#include "Random.hpp"
#include "solvers/h51f/PathProblem.hpp"
#include "solvers/h51f/Reduction.hpp"
#include "solvers/h51f/StartSystems.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

using KnownSolution = math::Point<double, kUnknowns>;

struct KnownSystem {
  Sharing sharing;
  Parameters parameters;
  std::vector<KnownSolution> solutions;
};

// A random real sample with its true solution, normalized and arranged.
KnownSystem randomRealSystem(Sharing sharing, test::Random& random);

// Adds complex Gaussian numbers of the given standard deviation (of real and imaginary part) to directions and moments, and half
// as large ones to image points; a shared centre stays where it is.
Parameters perturbed(Sharing sharing, const Parameters& parameters, double deviation, test::Random& random);

// Makes the moments of the shared rays those of rays through the shared centre.
void restoreSharedCentre(Sharing sharing, Parameters* parameters);

// Tracks the solutions to other parameters, carefully. False if a path fails or two end points coincide.
bool moveTo(const Parameters& parameters, KnownSystem* system);

// A complex system near a random real one with all solutions that monodromy finds: the known solutions are tracked around
// triangles in the space of parameters, which permutes all solutions, until `idleLoops` triangles in a row have given nothing
// new.
KnownSystem solveByMonodromy(Sharing sharing, int idleLoops, test::Random& random);

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

// The start systems of H70f, one per Sharing, and what else depends on it. StartSystem*.cpp are written by generateStartSystems.
#pragma once

#include "solvers/h70f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

extern const StartSystem kStartAtMostTwo;
extern const StartSystem kStartThree;
extern const StartSystem kStartThreeThree;
extern const StartSystem kStartFour;
extern const StartSystem kStartFourThree;
extern const StartSystem kStartFive;

// What depends on how many rays share a centre.
struct SharingCase {
  const char* name;
  int firstGroup;   // how many of the last rays have the origin as centre
  int secondGroup;  // how many of those before them have (0, 0, kSecondCentre)
  int solutions;    // of general complex parameters
  const StartSystem* start;

  int unshared() const { return kRays - firstGroup - secondGroup; }
  bool isOfFirst(int ray) const { return ray >= kRays - firstGroup; }
  bool isOfSecond(int ray) const { return ray >= unshared() && !isOfFirst(ray); }
};
const SharingCase& caseOf(Sharing sharing);

// The case of a sample whose largest groups of rays with one centre have these sizes; the largest at most five.
Sharing sharingOf(int largest, int second);

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv

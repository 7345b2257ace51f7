// The start systems of H51f, one per Sharing, and what else depends on it. StartSystem*.cpp are written by generateStartSystems.
#pragma once

#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

extern const StartSystem kStartAtMostTwo;
extern const StartSystem kStartThree;
extern const StartSystem kStartFour;

// What depends on how many rays share a centre.
struct SharingCase {
  const char* name;
  int sharedRays;  // how many of the first rays have the centre (0, 0, kSharedCentre)
  int solutions;   // of general complex parameters
  const StartSystem* start;
};
const SharingCase& caseOf(Sharing sharing);

// The case of a sample with at most `rays` rays of one centre; there are at most four.
Sharing sharingOf(int rays);

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

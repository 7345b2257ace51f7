// The start systems of H51f, one per Sharing. StartSystem*.cpp are written by generateStartSystems.
#pragma once

#include "solvers/h51f/Problem.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

extern const StartSystem kStartAtMostTwo, kStartThree, kStartFour;

inline const StartSystem& startSystem(Sharing sharing) {
  return sharing == Sharing::AtMostTwo ? kStartAtMostTwo : sharing == Sharing::Three ? kStartThree : kStartFour;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

#include "solvers/h70f/StartSystems.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

// In the order of Sharing.
static const SharingCase kCases[] = {
    {"AtMostTwo", 0, 0, 118, &kStartAtMostTwo},  {"Three", 3, 0, 108, &kStartThree},
    {"ThreeThree", 3, 3, 98, &kStartThreeThree}, {"Four", 4, 0, 84, &kStartFour},
    {"FourThree", 4, 3, 76, &kStartFourThree},   {"Five", 5, 0, 50, &kStartFive},
};

const SharingCase& caseOf(Sharing sharing) { return kCases[static_cast<int>(sharing)]; }

Sharing sharingOf(int largest, int second) {
  if (largest >= 5) return Sharing::Five;
  if (largest == 4) return second == 3 ? Sharing::FourThree : Sharing::Four;
  if (largest == 3) return second == 3 ? Sharing::ThreeThree : Sharing::Three;
  return Sharing::AtMostTwo;
}

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv

#include "solvers/h51f/StartSystems.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

// In the order of Sharing.
static const SharingCase kCases[] = {
    {"AtMostTwo", 0, 56, &kStartAtMostTwo},
    {"Three", 3, 50, &kStartThree},
    {"Four", 4, 36, &kStartFour},
};

const SharingCase& caseOf(Sharing sharing) { return kCases[static_cast<int>(sharing)]; }

Sharing sharingOf(int rays) {
  if (rays >= 4) return Sharing::Four;
  return rays == 3 ? Sharing::Three : Sharing::AtMostTwo;
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

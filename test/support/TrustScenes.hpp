// Correspondences of many shapes: such as no pose explains, such as do not determine one, and such as a right pose is hidden in.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "HybridScene.hpp"

namespace hybridgv {
namespace test {

struct TrustCase {
  std::string name;
  std::function<HybridScene(Random&)> make;
};

inline std::ostream& operator<<(std::ostream& stream, const TrustCase& scenes) { return stream << scenes.name; }

// Every pair is wrong.
const std::vector<TrustCase>& casesWithoutPose();
// The pairs agree with many poses, or only with poses that no camera has.
const std::vector<TrustCase>& undeterminedCases();
// The true pose is among wrong pairs.
const std::vector<TrustCase>& casesWithPose();

}  // namespace test
}  // namespace hybridgv

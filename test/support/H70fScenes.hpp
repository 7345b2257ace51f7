// Scenes for H70f: which rays share a centre, and where everything is.
#pragma once

#include "H51fScenes.hpp"

namespace hybridgv {
namespace test {

// All ways in which the rays share at least two centres; the first one is solved in closed form.
inline const std::vector<RaysPerCamera>& h70fPatterns() {
  static const std::vector<RaysPerCamera> patterns = {
      {6, 1},    {5, 2},       {5, 1, 1},       {4, 3},       {4, 2, 1},       {4, 1, 1, 1},       {3, 3, 1},
      {3, 2, 2}, {3, 2, 1, 1}, {3, 1, 1, 1, 1}, {2, 2, 2, 1}, {2, 2, 1, 1, 1}, {2, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1, 1}};
  return patterns;
}

// Scenes other than the usual one.
inline const std::vector<MinimalScene>& h70fScenes() {
  static const std::vector<MinimalScene> scenes = {
      {"rig +-0.5", [](Random& random, const RaysPerCamera& pattern) { return makeRigProblem(random, pattern, 0.5, 0); }},
      {"rig +-0.1", [](Random& random, const RaysPerCamera& pattern) { return makeRigProblem(random, pattern, 0.1, 0); }},
      {"same side", [](Random& random, const RaysPerCamera& pattern) { return makeSameSideProblem(random, pattern, 0); }},
      {"planar", [](Random& random, const RaysPerCamera& pattern) { return makePlanarProblem(random, pattern, 0); }},
      {"ray at the principal point",
       [](Random& random, const RaysPerCamera& pattern) {
         MinimalProblem problem = makeMinimalProblem(random, pattern, 0);
         moveRayToAxis(problem, 1, random.uniform(10, 30));
         return problem;
       },
       false},
  };
  return scenes;
}

}  // namespace test
}  // namespace hybridgv

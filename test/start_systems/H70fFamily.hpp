// The start systems of H70f, see KnownSystem.hpp.
#pragma once

#include "MinimalProblem.hpp"
#include "solvers/h70f/PathProblem.hpp"
#include "solvers/h70f/Reduction.hpp"
#include "solvers/h70f/StartSystems.hpp"
#include "start_systems/KnownSystem.hpp"

namespace hybridgv {
namespace test {

struct H70fFamily {
  using PathProblem = solvers::h70f::HYBRIDGV_INSTRUCTION_SET::H70fPathProblem;
  using Sharing = solvers::h70f::Sharing;
  using Parameters = solvers::h70f::Parameters;
  using StartSystem = solvers::h70f::StartSystem;
  static constexpr const char* kName = "h70f";
  static constexpr int kPoints = 0;
  static constexpr int kTrainingSamples = 60, kTrainingPeriod = 24;
  static constexpr Sharing kAll[] = {Sharing::AtMostTwo, Sharing::Three,     Sharing::ThreeThree,
                                     Sharing::Four,      Sharing::FourThree, Sharing::Five};

  static const solvers::h70f::SharingCase& caseOf(Sharing sharing) { return solvers::h70f::caseOf(sharing); }
  static const std::vector<std::vector<int>>& trainingPatterns(Sharing sharing);

  static KnownSystem<H70fFamily> randomRealSystem(Sharing sharing, Random& random);
  static auto straightHomotopy(const Parameters& start, const Parameters& target) {
    return solvers::h70f::straightHomotopy(start, target);
  }

  template <class Function>
  static void forEachNumber(Parameters& parameters, Function f) {
    forEachNumberOfRays(parameters, f);
  }
  static void restoreSharedCentres(Sharing sharing, Parameters* parameters);

  // The rays as they come: their order depends on the start system.
  using Sample = std::vector<solvers::RayMatch>;
  static Sample sampleOf(Sharing sharing, const MinimalProblem& problem);
  static Parameters targetOf(const Sample& sample, const StartSystem& start);
};

}  // namespace test
}  // namespace hybridgv

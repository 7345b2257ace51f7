// The start systems of H51f, see KnownSystem.hpp.
#pragma once

#include "MinimalProblem.hpp"
#include "solvers/h51f/PathProblem.hpp"
#include "solvers/h51f/Reduction.hpp"
#include "solvers/h51f/StartSystems.hpp"
#include "start_systems/KnownSystem.hpp"

namespace hybridgv {
namespace test {

struct H51fFamily {
  using PathProblem = solvers::h51f::HYBRIDGV_INSTRUCTION_SET::H51fPathProblem;
  using Sharing = solvers::h51f::Sharing;
  using Parameters = solvers::h51f::Parameters;
  using StartSystem = solvers::h51f::StartSystem;
  static constexpr const char* kName = "h51f";
  static constexpr int kPoints = 1;
  static constexpr int kTrainingSamples = 150, kTrainingPeriod = 6;
  static constexpr Sharing kAll[] = {Sharing::AtMostTwo, Sharing::Three, Sharing::Four};

  static const solvers::h51f::SharingCase& caseOf(Sharing sharing) { return solvers::h51f::caseOf(sharing); }
  static const std::vector<std::vector<int>>& trainingPatterns(Sharing sharing);

  static KnownSystem<H51fFamily> randomRealSystem(Sharing sharing, Random& random);
  static auto straightHomotopy(const Parameters& start, const Parameters& target) {
    return solvers::h51f::straightHomotopy(start, target);
  }

  template <class Function>
  static void forEachNumber(Parameters& parameters, Function f) {
    forEachNumberOfRays(parameters, f);
    f(parameters.pointImage, 0.5);
    f(parameters.pointImageBar, 0.5);
  }
  static void restoreSharedCentres(Sharing sharing, Parameters* parameters) {
    for (int j = 0; j < caseOf(sharing).sharedRays; ++j)
      restoreMoment<solvers::h51f::kRays>(j, solvers::h51f::kSharedCentre, parameters);
  }

  struct Sample {
    solvers::RayMatch rays[solvers::h51f::kRays];
    solvers::PointMatch point;
  };
  static Sample sampleOf(Sharing sharing, const MinimalProblem& problem);
  static Parameters targetOf(const Sample& sample, const StartSystem& start);
};

}  // namespace test
}  // namespace hybridgv

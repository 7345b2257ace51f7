// Writes the tables of start systems: generateStartSystems PROBLEM CLASS SEED CANDIDATES STEPS > StartSystemX.cpp
//
// PROBLEM is h51f or h70f, CLASS the name of one of its values of Sharing (AtMostTwo, Three, ..). From the seed: all solutions of a
// complex system by monodromy; CANDIDATES other systems near random real ones, of which the one with the shortest paths to a set of
// training samples is taken; then STEPS random changes of it, of which those are kept that make the paths shorter. The length of
// a path is the number of its steps. The parameters are rounded to five decimals before the solutions are computed.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "H51fScenes.hpp"
#include "start_systems/H51fFamily.hpp"
#include "start_systems/H70fFamily.hpp"
#include "start_systems/StartSystemSearch.hpp"

namespace hybridgv {
namespace test {
namespace {

using namespace math;
using solvers::complex_rays::ComplexNumber;
using solvers::complex_rays::ComplexRays;

constexpr double kCandidateDeviation = 0.3;
constexpr int kIdleLoops = 10;

// Half of them of the usual scene, half of a rig.
template <class Family>
std::vector<typename Family::Sample> trainingSamples(typename Family::Sharing sharing, Random& random) {
  const std::vector<std::vector<int>>& patterns = Family::trainingPatterns(sharing);
  std::vector<typename Family::Sample> samples;
  for (int i = 0; i < Family::kTrainingSamples; ++i) {
    const std::vector<int>& pattern = patterns[static_cast<std::size_t>(i) % patterns.size()];
    const bool isUsual = i % Family::kTrainingPeriod < Family::kTrainingPeriod / 2;
    samples.push_back(Family::sampleOf(sharing, isUsual ? makeMinimalProblem(random, pattern, Family::kPoints)
                                                        : makeRigProblem(random, pattern, 0.5, Family::kPoints)));
  }
  return samples;
}

template <int N>
std::vector<math::Point<float, N>> singlePrecision(const std::vector<math::Point<double, N>>& solutions) {
  std::vector<math::Point<float, N>> result(solutions.size());
  for (std::size_t i = 0; i < solutions.size(); ++i)
    for (int k = 0; k < N; ++k) {
      result[i].re[k] = static_cast<float>(solutions[i].re[k]);
      result[i].im[k] = static_cast<float>(solutions[i].im[k]);
    }
  return result;
}

// For StartSystemSearch.
template <class Family>
class Search {
 public:
  using System = KnownSystem<Family>;
  using Parameters = typename Family::Parameters;
  using Sharing = typename Family::Sharing;

  Search(Sharing sharing, Random& random)
      : sharing_(sharing), random_(random), samples_(trainingSamples<Family>(sharing, random)) {}

  Parameters nearRandomReal() {
    const Parameters real = Family::randomRealSystem(sharing_, random_).parameters;
    return perturbed<Family>(sharing_, real, kCandidateDeviation, random_);
  }
  Parameters changed(const System& system, double deviation) {
    return perturbed<Family>(sharing_, system.parameters, deviation, random_);
  }
  Parameters rounded(Parameters parameters) const {
    Family::forEachNumber(parameters, [](ComplexNumber& a, double) {
      a.re = std::round(a.re * 1e5) / 1e5;
      a.im = std::round(a.im * 1e5) / 1e5;
    });
    Family::restoreSharedCentres(sharing_, &parameters);
    return parameters;
  }
  bool moveTo(const Parameters& parameters, System* system) const { return test::moveTo<Family>(parameters, system); }

  // Failures counted as the largest number.
  std::vector<double> meanSteps(const System& system) const {
    const auto solutions = singlePrecision(system.solutions);
    const typename Family::StartSystem start{sharing_, static_cast<int>(solutions.size()), system.parameters, solutions.data()};
    std::vector<double> steps(solutions.size());
    for (const typename Family::Sample& sample : samples_) {
      const Parameters target = Family::targetOf(sample, start);
      int attempts[Family::PathProblem::kMaxPaths];
      PathSolver<typename Family::PathProblem>({start, target}).countSteps(attempts);
      for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += attempts[i] / static_cast<double>(samples_.size());
    }
    return steps;
  }

 private:
  Sharing sharing_;
  Random& random_;
  std::vector<typename Family::Sample> samples_;
};

void print(const ComplexNumber& a) { std::printf("{%.5f, %.5f}", a.re, a.im); }
template <std::size_t Count>
void print(const ComplexNumber (&values)[Count]) {
  std::printf("{");
  for (std::size_t k = 0; k < Count; ++k) {
    if (k > 0) std::printf(", ");
    print(values[k]);
  }
  std::printf("}");
}
template <std::size_t Count>
void print(const ComplexNumber (&rows)[Count][3]) {
  std::printf("     {");
  for (std::size_t k = 0; k < Count; ++k) {
    if (k > 0) std::printf(",\n      ");
    print(rows[k]);
  }
  std::printf("},\n");
}
template <int Rays>
void print(const ComplexRays<Rays>& rays) {
  print(rays.direction);
  print(rays.moment);
  std::printf("     ");
  print(rays.image);
  std::printf(",\n     ");
  print(rays.imageBar);
}
void printParameters(const H51fFamily::Parameters& p) {
  std::printf("{{\n");
  print<solvers::h51f::kRays>(p);
  std::printf("},\n     ");
  print(p.pointImage);
  std::printf(", ");
  print(p.pointImageBar);
  std::printf("}");
}
void printParameters(const H70fFamily::Parameters& p) {
  std::printf("{\n");
  print(p);
  std::printf("}");
}
template <std::size_t N>
void print(const float (&values)[N]) {
  std::printf("{");
  for (std::size_t k = 0; k < N; ++k) std::printf("%s%#.9gf", k > 0 ? ", " : "", static_cast<double>(values[k]));
  std::printf("}");
}

template <class Family>
void printTable(const KnownSystem<Family>& system) {
  const char* name = Family::caseOf(system.sharing).name;
  std::printf("// clang-format off\n#include \"solvers/%s/StartSystems.hpp\"\n\n", Family::kName);
  std::printf("namespace hybridgv {\nnamespace solvers {\nnamespace %s {\n\n", Family::kName);
  std::printf("static const math::Point<float, kUnknowns> kSolutions[] = {\n");
  for (const auto& solution : singlePrecision(system.solutions)) {
    std::printf("    {");
    print(solution.re);
    std::printf(", ");
    print(solution.im);
    std::printf("},\n");
  }
  std::printf("};\n\nconst StartSystem kStart%s = {\n    Sharing::%s, %d,\n    ", name, name,
              static_cast<int>(system.solutions.size()));
  printParameters(system.parameters);
  std::printf(",\n    kSolutions};\n\n}  // namespace %s\n}  // namespace solvers\n}  // namespace hybridgv\n", Family::kName);
}

template <class Family>
bool generate(char** arguments) {
  for (const typename Family::Sharing sharing : Family::kAll) {
    if (std::string(arguments[2]) != Family::caseOf(sharing).name) continue;
    Random random(std::strtoull(arguments[3], nullptr, 10));
    Search<Family> family(sharing, random);
    const KnownSystem<Family> known = solveByMonodromy<Family>(sharing, kIdleLoops, random);
    if (static_cast<int>(known.solutions.size()) != Family::caseOf(sharing).solutions) std::abort();
    StartSystemSearch<Search<Family>> search(family, known);
    search.run(std::atoi(arguments[4]), std::atoi(arguments[5]));
    std::printf("// Written by: generateStartSystems %s %s %s %s %s", arguments[1], arguments[2], arguments[3], arguments[4],
                arguments[5]);
    std::printf("  (mean number of steps of a path on the training samples: %.2f)\n", search.stepsPerPath());
    printTable(search.chosen());
    return true;
  }
  return false;
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

int main(int argc, char** argv) {
  using namespace hybridgv::test;
  const std::string problem = argc == 6 ? argv[1] : "";
  if (problem == H51fFamily::kName && generate<H51fFamily>(argv)) return 0;
  if (problem == H70fFamily::kName && generate<H70fFamily>(argv)) return 0;
  std::fprintf(stderr, "usage: %s h51f|h70f CLASS SEED CANDIDATES STEPS\n", argv[0]);
  return 2;
}

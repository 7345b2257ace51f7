// Writes the tables of start systems: generateStartSystems SHARING SEED CANDIDATES STEPS > StartSystemX.cpp
//
// SHARING is 2, 3 or 4, the largest number of rays with one centre (2: at most two). From the seed: all solutions of a complex
// system by monodromy; CANDIDATES other systems near random real ones, of which the one with the shortest paths to a set of
// training samples is taken; then STEPS random changes of it, of which those are kept that make the paths shorter. The length of
// a path is the number of its steps. The parameters are rounded to five decimals before the solutions are computed.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "H51fScenes.hpp"
#include "start_systems/H51fMonodromy.hpp"
#include "start_systems/StartSystemSearch.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {
namespace {

using namespace HYBRIDGV_INSTRUCTION_SET;

constexpr double kCandidateDeviation = 0.3;
constexpr int kTrainingSamples = 150, kIdleLoops = 10;

struct Sample {
  RayMatch rays[kRays];
  PointMatch point;
};

Sample makeSample(Sharing sharing, const test::MinimalProblem& problem) {
  Sample sample;
  sample.point = problem.points[0];
  if (arrange(problem.rays.data(), sample.point, sample.rays) != sharing) std::abort();
  return sample;
}

std::vector<Sample> trainingSamples(Sharing sharing, test::Random& random) {
  static const std::vector<std::vector<int>> kPatterns[] = {
      {{1, 1, 1, 1, 1}, {2, 1, 1, 1}, {2, 2, 1}}, {{3, 1, 1}, {3, 2}}, {{4, 1}}};
  const std::vector<std::vector<int>>& patterns = kPatterns[static_cast<int>(sharing)];
  std::vector<Sample> samples;
  for (int i = 0; i < kTrainingSamples; ++i) {
    const std::vector<int>& pattern = patterns[static_cast<std::size_t>(i) % patterns.size()];
    samples.push_back(makeSample(
        sharing, i % 6 < 3 ? test::makeMinimalProblem(random, pattern, 1) : test::makeRigProblem(random, pattern, 0.5)));
  }
  return samples;
}

std::vector<math::Point<float, kUnknowns>> singlePrecision(const std::vector<KnownSolution>& solutions) {
  std::vector<math::Point<float, kUnknowns>> result(solutions.size());
  for (std::size_t i = 0; i < solutions.size(); ++i)
    for (int k = 0; k < kUnknowns; ++k) {
      result[i].re[k] = static_cast<float>(solutions[i].re[k]);
      result[i].im[k] = static_cast<float>(solutions[i].im[k]);
    }
  return result;
}

// The parameters as the table has them.
Parameters roundedToTable(Sharing sharing, Parameters parameters) {
  const auto round = [](ComplexNumber& a) {
    a.re = std::round(a.re * 1e5) / 1e5;
    a.im = std::round(a.im * 1e5) / 1e5;
  };
  for (int j = 0; j < kRays; ++j) {
    for (ComplexNumber& a : parameters.direction[j]) round(a);
    for (ComplexNumber& a : parameters.moment[j]) round(a);
    round(parameters.image[j]);
    round(parameters.imageBar[j]);
  }
  round(parameters.pointImage);
  round(parameters.pointImageBar);
  restoreSharedCentre(sharing, &parameters);
  return parameters;
}

// For StartSystemSearch.
class Family {
 public:
  using System = KnownSystem;
  using Parameters = h51f::Parameters;

  Family(Sharing sharing, test::Random& random)
      : sharing_(sharing), random_(random), samples_(trainingSamples(sharing, random)) {}

  Parameters nearRandomReal() {
    const Parameters real = randomRealSystem(sharing_, random_).parameters;
    return perturbed(sharing_, real, kCandidateDeviation, random_);
  }
  Parameters changed(const KnownSystem& system, double deviation) {
    return perturbed(sharing_, system.parameters, deviation, random_);
  }
  Parameters rounded(const Parameters& parameters) const { return roundedToTable(sharing_, parameters); }
  bool moveTo(const Parameters& parameters, KnownSystem* system) const { return h51f::moveTo(parameters, system); }

  // Failures counted as the largest number.
  std::vector<double> meanSteps(const KnownSystem& system) const {
    const auto solutions = singlePrecision(system.solutions);
    const StartSystem start{sharing_, static_cast<int>(solutions.size()), system.parameters, solutions.data()};
    std::vector<double> steps(solutions.size());
    for (const Sample& sample : samples_) {
      Frame frame;
      normalize(sharing_, sample.rays, sample.point, &frame);
      alignWith(start, sample.rays, sample.point, &frame);
      Parameters target = parametersIn(frame, sharing_, sample.rays, sample.point);
      scaleRaysLike(system.parameters, &target);
      int attempts[kMaxPaths];
      PathSolver<H51fPathProblem>({start, target}).countSteps(attempts);
      for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += attempts[i] / static_cast<double>(samples_.size());
    }
    return steps;
  }

 private:
  Sharing sharing_;
  test::Random& random_;
  std::vector<Sample> samples_;
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
void print(const float (&values)[kUnknowns]) {
  std::printf("{");
  for (int k = 0; k < kUnknowns; ++k) std::printf("%s%#.9gf", k > 0 ? ", " : "", static_cast<double>(values[k]));
  std::printf("}");
}

void printTable(const KnownSystem& system) {
  const char* name = caseOf(system.sharing).name;
  std::printf("// clang-format off\n#include \"solvers/h51f/StartSystems.hpp\"\n\n");
  std::printf("namespace hybridgv {\nnamespace solvers {\nnamespace h51f {\n\n");
  std::printf("static const math::Point<float, kUnknowns> kSolutions[] = {\n");
  for (const math::Point<float, kUnknowns>& solution : singlePrecision(system.solutions)) {
    std::printf("    {");
    print(solution.re);
    std::printf(", ");
    print(solution.im);
    std::printf("},\n");
  }
  std::printf("};\n\nconst StartSystem kStart%s = {\n    Sharing::%s, %d,\n    {\n", name, name,
              static_cast<int>(system.solutions.size()));
  const Parameters& p = system.parameters;
  print(p.direction);
  print(p.moment);
  std::printf("     ");
  print(p.image);
  std::printf(",\n     ");
  print(p.imageBar);
  std::printf(",\n     ");
  print(p.pointImage);
  std::printf(", ");
  print(p.pointImageBar);
  std::printf("},\n    kSolutions};\n\n}  // namespace h51f\n}  // namespace solvers\n}  // namespace hybridgv\n");
}

void generate(Sharing sharing, char** arguments) {
  test::Random random(std::strtoull(arguments[2], nullptr, 10));
  Family family(sharing, random);
  const KnownSystem known = solveByMonodromy(sharing, kIdleLoops, random);
  if (static_cast<int>(known.solutions.size()) != caseOf(sharing).solutions) std::abort();
  test::StartSystemSearch<Family> search(family, known);
  search.run(std::atoi(arguments[3]), std::atoi(arguments[4]));
  std::printf("// Written by: generateStartSystems %s %s %s %s  (mean number of steps of a path on the training samples: %.2f)\n",
              arguments[1], arguments[2], arguments[3], arguments[4], search.stepsPerPath());
  printTable(search.chosen());
}

}  // namespace
}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

int main(int argc, char** argv) {
  using namespace hybridgv::solvers::h51f;
  const int shared = argc == 5 ? std::atoi(argv[1]) : 0;
  if (shared < 2 || shared > 4) {
    std::fprintf(stderr, "usage: %s 2|3|4 SEED CANDIDATES STEPS\n", argv[0]);
    return 2;
  }
  generate(sharingOf(shared), argv);
}

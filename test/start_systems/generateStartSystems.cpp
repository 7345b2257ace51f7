// Writes the tables of start systems: generateStartSystems SHARING SEED CANDIDATES STEPS > StartSystemX.cpp
//
// SHARING is 2, 3 or 4, the largest number of rays with one centre (2: at most two). From the seed: all solutions of a complex
// system by monodromy; CANDIDATES other systems near random real ones, of which the one with the shortest paths to a set of
// training samples is taken; then STEPS random changes of it, of which those are kept that make the paths shorter. The length of
// a path is the number of its steps. The parameters are rounded to five decimals before the solutions are computed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "H51fScenes.hpp"
#include "start_systems/H51fMonodromy.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {
namespace {

using namespace HYBRIDGV_INSTRUCTION_SET;

constexpr double kCandidateDeviation = 0.3;
constexpr int kTrainingSamples = 150, kIdleLoops = 10;

struct Sample {
  solvers::RayMatch rays[kRays];
  solvers::PointMatch point;
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

// Mean number of steps of every path, failures counted as the largest number.
std::vector<double> meanSteps(const KnownSystem& system, const std::vector<Sample>& samples) {
  const auto solutions = singlePrecision(system.solutions);
  const int paths = static_cast<int>(solutions.size());
  const StartSystem start{system.sharing, paths, system.parameters, solutions.data()};
  std::vector<double> steps(solutions.size());
  for (const Sample& sample : samples) {
    Frame frame;
    normalize(system.sharing, sample.rays, sample.point, &frame);
    alignWith(start, sample.rays, sample.point, &frame);
    Parameters target = parametersIn(frame, system.sharing, sample.rays, sample.point);
    scaleRaysLike(system.parameters, &target);
    int attempts[kMaxPaths];
    PathSolver<H51fPathProblem>({start, target}).countSteps(attempts);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += attempts[i] / static_cast<double>(samples.size());
  }
  return steps;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void roundToTable(Sharing sharing, Parameters& parameters) {
  const auto round = [](ComplexNumber& a) { a.re = std::round(a.re * 1e5) / 1e5, a.im = std::round(a.im * 1e5) / 1e5; };
  for (int j = 0; j < kRays; ++j) {
    for (ComplexNumber& a : parameters.direction[j]) round(a);
    for (ComplexNumber& a : parameters.moment[j]) round(a);
    round(parameters.image[j]), round(parameters.imageBar[j]);
  }
  round(parameters.pointImage), round(parameters.pointImageBar);
  restoreSharedCentre(sharing, &parameters);
}

// Keeps the better of the two systems.
bool improve(const KnownSystem& system, Parameters parameters, const std::vector<Sample>& samples, double* best,
             KnownSystem* chosen) {
  KnownSystem candidate = system;
  roundToTable(system.sharing, parameters);
  if (!moveTo(parameters, &candidate)) return false;
  const double mean = meanOf(meanSteps(candidate, samples));
  if (!(mean < *best)) return false;
  *best = mean, *chosen = candidate;
  return true;
}

KnownSystem chooseStart(Sharing sharing, int candidates, int steps, test::Random& random, double* best) {
  const std::vector<Sample> samples = trainingSamples(sharing, random);
  const KnownSystem system = solveByMonodromy(sharing, kIdleLoops, random);
  if (static_cast<int>(system.solutions.size()) != solutionCount(sharing)) std::abort();
  KnownSystem chosen;
  *best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < candidates; ++i) {
    const Parameters real = randomRealSystem(sharing, random).parameters;
    improve(system, perturbed(sharing, real, kCandidateDeviation, random), samples, best, &chosen);
  }
  std::fprintf(stderr, "candidates: %.2f steps per path\n", *best);
  double deviation = 0.05;
  for (int i = 0; i < steps; ++i) {
    const KnownSystem current = chosen;
    const bool better = improve(current, perturbed(sharing, current.parameters, deviation, random), samples, best, &chosen);
    deviation = std::min(0.1, std::max(0.01, better ? deviation * 1.3 : deviation * 0.97));
  }
  std::fprintf(stderr, "after %d changes: %.2f\n", steps, *best);
  // The longest paths first, so that no lane is left alone with one at the end.
  const std::vector<double> length = meanSteps(chosen, samples);
  std::vector<std::size_t> order(length.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&length](std::size_t a, std::size_t b) { return length[a] > length[b]; });
  const KnownSystem unsorted = chosen;
  for (std::size_t i = 0; i < order.size(); ++i) chosen.solutions[i] = unsorted.solutions[order[i]];
  return chosen;
}

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

void printTable(const KnownSystem& system, const char* name) {
  std::printf("// clang-format off\n#include \"solvers/h51f/StartSystems.hpp\"\n\nnamespace hybridgv {\nnamespace h51f {\n\n");
  std::printf("static const math::Point<float, kUnknowns> kSolutions[] = {\n");
  for (const math::Point<float, kUnknowns>& solution : singlePrecision(system.solutions)) {
    std::printf("    {");
    print(solution.re), std::printf(", "), print(solution.im);
    std::printf("},\n");
  }
  std::printf("};\n\nconst StartSystem kStart%s = {\n    Sharing::%s, %d,\n    {\n", name, name,
              static_cast<int>(system.solutions.size()));
  const Parameters& p = system.parameters;
  print(p.direction), print(p.moment);
  std::printf("     "), print(p.image), std::printf(",\n     "), print(p.imageBar), std::printf(",\n     ");
  print(p.pointImage), std::printf(", "), print(p.pointImageBar);
  std::printf("},\n    kSolutions};\n\n}  // namespace h51f\n}  // namespace hybridgv\n");
}

}  // namespace
}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv

int main(int argc, char** argv) {
  using namespace hybridgv::h51f;
  const int shared = argc == 5 ? std::atoi(argv[1]) : 0;
  if (shared < 2 || shared > 4) return std::fprintf(stderr, "usage: %s 2|3|4 SEED CANDIDATES STEPS\n", argv[0]), 2;
  const Sharing sharing = shared == 2 ? Sharing::AtMostTwo : shared == 3 ? Sharing::Three : Sharing::Four;
  hybridgv::test::Random random(std::strtoull(argv[2], nullptr, 10));
  double best = 0;
  const KnownSystem system = chooseStart(sharing, std::atoi(argv[3]), std::atoi(argv[4]), random, &best);
  std::printf("// Written by: generateStartSystems %s %s %s %s  (mean number of steps of a path on the training samples: %.2f)\n",
              argv[1], argv[2], argv[3], argv[4], best);
  printTable(system, shared == 2 ? "AtMostTwo" : shared == 3 ? "Three" : "Four");
}

// The table of all minimal solvers: numbers of solutions, sizes, times, and how often the truth is found in noiseless problems.
//
// Writes solver_table.csv. Times are those of the public functions on one thread, beside OpenGV's gp3p in the same run.
#include <hybridgv/absolute_pose/methods.hpp>
#include <hybridgv/detail/parallelFor.hpp>
#include <hybridgv/hybrid_pose/methods.hpp>
#include <hybridgv/relative_pose/methods.hpp>

#include <memory>
#include <opengv/absolute_pose/methods.hpp>

#include "../common/CsvFile.hpp"
#include "../common/Options.hpp"
#include "../common/processorSeconds.hpp"
#include "Gp3pProblem.hpp"
#include "MinimalProblem.hpp"
#include "common/ProgressBar.hpp"
#include "common/Statistics.hpp"

namespace {

using hybridgv::FocalPoses;
using hybridgv::NoncentralHybridAdapter;
using hybridgv::test::Random;

struct Row {
  const char *problem, *configuration;
  std::vector<int> raysPerCamera;
  int points;
  FocalPoses (*solve)(const NoncentralHybridAdapter&, double focalLength);  // which those that estimate it ignore
  int solutions;                                                            // complex ones, the bound of ours
  const char* ours;                                                         // the core of the algorithm
  const char* paper;  // size of the elimination template of Bhayani et al. 2023, Table 1
};

FocalPoses p4pf(const NoncentralHybridAdapter& adapter, double) { return hybridgv::absolute_pose::p4pf(adapter); }
FocalPoses p35pf(const NoncentralHybridAdapter& adapter, double) { return hybridgv::absolute_pose::p35pf(adapter); }
FocalPoses h13f(const NoncentralHybridAdapter& adapter, double) { return hybridgv::hybrid_pose::h13f(adapter); }
FocalPoses h32f(const NoncentralHybridAdapter& adapter, double) { return hybridgv::hybrid_pose::h32f(adapter); }
FocalPoses h51f(const NoncentralHybridAdapter& adapter, double) { return hybridgv::hybrid_pose::h51f(adapter); }
FocalPoses h70f(const NoncentralHybridAdapter& adapter, double) { return hybridgv::hybrid_pose::h70f(adapter); }
FocalPoses p3p(const NoncentralHybridAdapter& adapter, double f) { return hybridgv::absolute_pose::p3p(adapter, f); }
FocalPoses h22(const NoncentralHybridAdapter& adapter, double f) { return hybridgv::hybrid_pose::h22(adapter, f); }
FocalPoses h41(const NoncentralHybridAdapter& adapter, double f) { return hybridgv::hybrid_pose::h41(adapter, f); }
FocalPoses h60(const NoncentralHybridAdapter& adapter, double f) { return hybridgv::hybrid_pose::h60(adapter, f); }
FocalPoses fivept(const NoncentralHybridAdapter& adapter, double f) { return hybridgv::relative_pose::fivept(adapter, f); }

const std::vector<Row> kRows = {
    {"P4Pf", "-", {}, 4, p4pf, 6, "form of degree 6", "-"},
    {"P3.5Pf", "-", {}, 4, p35pf, 10, "form of degree 10", "-"},
    {"H13f", "[1]", {1}, 3, h13f, 12, "form of degree 12", "70x82"},
    {"H32f", "[1]", {1, 1, 1}, 2, h32f, 26, "8x8 resultant of degree 26", "289x315"},
    {"H32f", "[2]", {2, 1}, 2, h32f, 26, "8x8 resultant of degree 26", "289x315"},
    {"H32f", "[3]", {3}, 2, h32f, 26, "8x8 resultant of degree 26", "289x315"},
    {"H51f", "[1] 1+1+1+1+1", {1, 1, 1, 1, 1}, 1, h51f, 56, "56 paths", "506x562"},
    {"H51f", "[2] 2+1+1+1", {2, 1, 1, 1}, 1, h51f, 56, "56 paths", "511x561"},
    {"H51f", "[2] 2+2+1", {2, 2, 1}, 1, h51f, 56, "56 paths", "511x561"},
    {"H51f", "[3] 3+1+1", {3, 1, 1}, 1, h51f, 50, "50 paths", "511x561"},
    {"H51f", "[3] 3+2", {3, 2}, 1, h51f, 50, "50 paths", "511x561"},
    {"H51f", "[4] 4+1", {4, 1}, 1, h51f, 36, "36 paths", "390x428"},
    {"H51f", "[5] 5", {5}, 1, h51f, 9, "form of degree 9", "9x18"},
    {"H70f", "[1] 1+1+1+1+1+1+1", {1, 1, 1, 1, 1, 1, 1}, 0, h70f, 118, "118 paths", "-"},
    {"H70f", "[2] 2+2+2+1", {2, 2, 2, 1}, 0, h70f, 118, "118 paths", "-"},
    {"H70f", "[3] 3+2+2", {3, 2, 2}, 0, h70f, 108, "108 paths", "-"},
    {"H70f", "[3] 3+3+1", {3, 3, 1}, 0, h70f, 98, "98 paths", "-"},
    {"H70f", "[4] 4+2+1", {4, 2, 1}, 0, h70f, 84, "84 paths", "-"},
    {"H70f", "[4] 4+3", {4, 3}, 0, h70f, 76, "76 paths", "-"},
    {"H70f", "[5] 5+2", {5, 2}, 0, h70f, 50, "50 paths", "-"},
    {"H70f", "[6] 6+1", {6, 1}, 0, h70f, 18, "form of degree 9", "-"},
    {"P3P", "f known", {}, 3, p3p, 4, "cubic", "-"},
    {"H22", "[1] f known", {1, 1}, 2, h22, 16, "form of degree 16", "-"},
    {"H22", "[2] f known", {2}, 2, h22, 16, "form of degree 16", "-"},
    {"H41", "[4] f known", {4}, 1, h41, 20, "form of degree 10", "-"},
    {"H60", "[5] 5+1 f known", {5, 1}, 0, h60, 20, "form of degree 10", "-"},
    {"fivept", "[5] f known", {5}, 0, fivept, 20, "form of degree 10", "-"},
};

struct Settings {
  CommonOptions options;
  std::size_t problems = 20000, timed = 200;
  int repetitions = 25;
};

struct Statistics {
  double meanSolutions = 0, recoveredPercent = 0;
  std::size_t mostSolutions = 0;
};

Statistics countSolutions(const Row& row, const Settings& settings, ProgressBar& progress) {
  std::vector<std::size_t> counts(settings.problems);
  std::vector<char> recovered(settings.problems);
  hybridgv::detail::parallelFor(settings.problems, settings.options.threads, [&](std::size_t i) {
    Random random(settings.options.seed, i);
    const hybridgv::test::MinimalProblem problem = hybridgv::test::makeMinimalProblem(random, row.raysPerCamera, row.points);
    const FocalPoses solutions = row.solve(hybridgv::test::makeAdapter(problem), problem.truth.focalLength);
    counts[i] = solutions.size();
    recovered[i] = hybridgv::test::distanceToNearest(solutions, problem.truth) < 1e-6;
    progress.step();
  });
  Statistics result;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    result.meanSolutions += static_cast<double>(counts[i]) / static_cast<double>(counts.size());
    result.mostSolutions = std::max(result.mostSolutions, counts[i]);
    result.recoveredPercent += 100.0 * recovered[i] / static_cast<double>(counts.size());
  }
  return result;
}

// Microseconds of processor time per call of one solver, a pass over all its problems at a time.
class Stopwatch {
 public:
  template <class Call>
  void pass(std::size_t calls, const Call& call) {
    const double start = processorSeconds();
    for (std::size_t i = 0; i < calls; ++i) solutions_ += call(i);
    const double seconds = processorSeconds() - start;
    microseconds_.push_back(1e6 * seconds / static_cast<double>(calls));
  }
  double least() const { return quantile(microseconds_, 0); }
  double middle() const { return median(microseconds_); }

 private:
  std::vector<double> microseconds_;
  volatile std::size_t solutions_ = 0;  // so that no call is left out
};

void run(const Settings& settings) {
  ProgressBar progress(kRows.size() * settings.problems, !settings.options.quiet);
  std::vector<Statistics> statistics;
  for (const Row& row : kRows) statistics.push_back(countSolutions(row, settings, progress));

  // All solvers take turns, so that other work on the machine burdens all alike.
  std::vector<std::vector<NoncentralHybridAdapter>> adapters(kRows.size());
  std::vector<std::vector<double>> focalLengths(kRows.size());
  std::vector<std::unique_ptr<hybridgv::benchmarks::Gp3pProblem>> gp3pProblems;
  for (std::size_t i = 0; i < settings.timed; ++i) {
    for (std::size_t s = 0; s < kRows.size(); ++s) {
      Random random(settings.options.seed, i);
      const auto problem = hybridgv::test::makeMinimalProblem(random, kRows[s].raysPerCamera, kRows[s].points);
      adapters[s].push_back(makeAdapter(problem));
      focalLengths[s].push_back(problem.truth.focalLength);
    }
    Random random(settings.options.seed, i);
    gp3pProblems.push_back(std::make_unique<hybridgv::benchmarks::Gp3pProblem>(random));
  }
  std::vector<Stopwatch> watches(kRows.size());
  Stopwatch gp3p;
  const std::vector<int> three{0, 1, 2};
  for (int repetition = 0; repetition < settings.repetitions; ++repetition) {
    gp3p.pass(settings.timed,
              [&](std::size_t i) { return opengv::absolute_pose::gp3p(gp3pProblems[i]->adapter(), three).size(); });
    for (std::size_t s = 0; s < kRows.size(); ++s)
      watches[s].pass(settings.timed, [&](std::size_t i) { return kRows[s].solve(adapters[s][i], focalLengths[s][i]).size(); });
  }

  CsvFile csv(
      settings.options.output, "solver_table.csv",
      {text(settings.problems, " noiseless problems, seed ", settings.options.seed, "; times: ", settings.repetitions,
            " passes (processor time) over ", settings.timed, " problems, one thread, gp3p ", gp3p.middle(),
            " us (median); hybridgv ", hybridgv::version()),
       "paper_template: the size printed in Bhayani et al., WACV 2023, Table 1; everything else is measured here; real "
       "solutions: with a positive focal length, in front of all cameras"},
      "problem,configuration,solutions_at_most,most_real_solutions,mean_real_solutions,core,paper_template,microseconds_median,"
      "microseconds_least,times_gp3p,recovered_percent");
  for (std::size_t s = 0; s < kRows.size(); ++s)
    csv.row(kRows[s].problem, kRows[s].configuration, kRows[s].solutions, statistics[s].mostSolutions,
            statistics[s].meanSolutions, kRows[s].ours, kRows[s].paper, watches[s].middle(), watches[s].least(),
            watches[s].middle() / gp3p.middle(), statistics[s].recoveredPercent);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"All minimal solvers: numbers of solutions, sizes, times relative to OpenGV's gp3p, share of truths found."};
  Settings settings;
  addCommonOptions(app, settings.options, "threads that count solutions; times are always taken on one");
  return runExperiment(app, argc, argv, [&] {
    if (settings.options.quick) {
      settings.problems = 50;
      settings.timed = 10;
      settings.repetitions = 3;
    }
    run(settings);
  });
}

// How the errors of the minimal solvers grow with the noise of the 3D points and of the images, and how exact the solvers are
// without noise. Of the solutions of a sample the one nearest to the truth is taken: this measures the solvers, not the choice.
//
// Writes synthetic_noise.csv (quantiles of the errors) and synthetic_stability.csv (histogram of log10 of the focal error).
#include <hybridgv/absolute_pose/methods.hpp>
#include <hybridgv/detail/parallelFor.hpp>
#include <hybridgv/hybrid_pose/methods.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "../common/CsvFile.hpp"
#include "../common/Options.hpp"
#include "ErrorTable.hpp"
#include "SyntheticScene.hpp"
#include "common/PoseError.hpp"
#include "common/ProgressBar.hpp"
#include "common/Statistics.hpp"

namespace {

using hybridgv::FocalPoses;
using hybridgv::NoncentralHybridAdapter;
using MultiIndices = std::vector<std::vector<int>>;

struct SolverRow {
  const char* name;
  MultiIndices sample;  // of a SyntheticScene
  FocalPoses (*solve)(const NoncentralHybridAdapter&, const MultiIndices&);
};

const std::vector<SolverRow> kSolvers = {
    {"P4Pf", {{}, {0, 1, 2, 3}}, [](const auto& a, const auto& sample) { return hybridgv::absolute_pose::p4pf(a, sample[1]); }},
    {"P3.5Pf",
     {{}, {0, 1, 2, 3}},
     [](const auto& a, const auto& sample) { return hybridgv::absolute_pose::p35pf(a, sample[1]); }},
    {"H13f", {{0}, {0, 1, 2}}, [](const auto& a, const auto& sample) { return hybridgv::hybrid_pose::h13f(a, sample); }},
    {"H32f", {{0, 1, 2}, {0, 1}}, [](const auto& a, const auto& sample) { return hybridgv::hybrid_pose::h32f(a, sample); }},
    {"H51f[1]", {{0, 1, 2, 3, 4}, {0}}, [](const auto& a, const auto& sample) { return hybridgv::hybrid_pose::h51f(a, sample); }},
    {"H51f[5]", {{5, 6, 7, 8, 9}, {0}}, [](const auto& a, const auto& sample) { return hybridgv::hybrid_pose::h51f(a, sample); }},
};

struct Experiment {
  CommonOptions options;
  std::size_t scenes = 5000;

  std::string remark() const {
    return text(scenes, " scenes, seed ", options.seed, ", hybridgv ", hybridgv::version(),
                ", solution nearest to the truth, a missing one counts as an infinite error");
  }

  // errors[solver][scene]
  std::vector<std::vector<PoseError>> errors(Motion motion, const Noise& noise, ProgressBar& progress) const {
    std::vector<std::vector<PoseError>> result(kSolvers.size(), std::vector<PoseError>(scenes));
    hybridgv::detail::parallelFor(scenes, options.threads, [&](std::size_t i) {
      const SyntheticScene scene = makeSyntheticScene(hybridgv::test::Random(options.seed, i), motion, noise);
      for (std::size_t s = 0; s < kSolvers.size(); ++s)
        result[s][i] = errorOfNearest(kSolvers[s].solve(scene.adapter, kSolvers[s].sample), scene.query);
      progress.step();
    });
    return result;
  }
};

void writeQuantiles(CsvFile& csv, const char* series, Motion motion, std::size_t level, const Noise& noise,
                    const std::vector<std::vector<PoseError>>& errors) {
  const struct {
    const char* name;
    double PoseError::*member;
  } measures[] = {
      {"rotation_deg", &PoseError::rotationDeg}, {"position", &PoseError::position}, {"focal_percent", &PoseError::focalPercent}};
  for (std::size_t s = 0; s < kSolvers.size(); ++s)
    for (const auto& measure : measures) {
      std::vector<double> values;
      for (const PoseError& error : errors[s]) values.push_back(error.*measure.member);
      std::vector<double> solved;
      std::copy_if(values.begin(), values.end(), std::back_inserter(solved), [](double value) { return std::isfinite(value); });
      csv.row(series, toString(motion), level, noise.pointPercent, noise.imagePx, kSolvers[s].name, measure.name,
              100.0 * static_cast<double>(solved.size()) / static_cast<double>(values.size()), median(solved),
              quantile(values, 0.05), quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75),
              quantile(values, 0.95));
    }
}

// Percent of the scenes whose log10 of the relative focal error is within each half unit from -16 to 1; the first bin takes what
// is below, the last what is above, with the scenes without a solution.
void writeHistogram(CsvFile& csv, const std::vector<std::vector<PoseError>>& errors) {
  constexpr int kBins = 34;
  for (std::size_t s = 0; s < kSolvers.size(); ++s) {
    std::vector<int> counts(kBins, 0);
    for (const PoseError& error : errors[s]) {
      const double logError = std::log10(std::max(1e-300, error.focalPercent / 100));
      ++counts[static_cast<std::size_t>(std::min(kBins - 1.0, std::max(0.0, 2 * (logError + 16))))];
    }
    for (int bin = 0; bin < kBins; ++bin)
      csv.row(kSolvers[s].name, -16 + 0.5 * bin,
              100.0 * counts[static_cast<std::size_t>(bin)] / static_cast<double>(errors[s].size()));
  }
}

void run(const Experiment& experiment) {
  const std::vector<Motion> motions{Motion::Random, Motion::Forward, Motion::Sideways};
  const std::vector<double> pointLevels{0, 0.1, 0.5, 1, 2, 3}, imageLevels{0, 0.5, 1, 2, 4, 8};
  const double imagePx = 2, pointPercent = 1;  // what is fixed while the other one grows
  const std::size_t passes = motions.size() * pointLevels.size() + imageLevels.size() + 1;
  ProgressBar progress(passes * experiment.scenes, !experiment.options.quiet);

  CsvFile csv(experiment.options.output, "synthetic_noise.csv", {experiment.remark()},
              "series,motion,level,noise3d_percent_of_depth,image_noise_px,solver,error,solved_percent,median_of_solved,q05,q25,"
              "median,q75,q95");
  for (const Motion motion : motions)
    for (std::size_t level = 0; level < pointLevels.size(); ++level) {
      const Noise noise{imagePx, pointLevels[level]};
      writeQuantiles(csv, "noise3d", motion, level, noise, experiment.errors(motion, noise, progress));
    }
  for (std::size_t level = 0; level < imageLevels.size(); ++level) {
    const Noise noise{imageLevels[level], pointPercent};
    writeQuantiles(csv, "image_noise", Motion::Random, level, noise, experiment.errors(Motion::Random, noise, progress));
  }
  CsvFile histogram(experiment.options.output, "synthetic_stability.csv", {experiment.remark()},
                    "solver,log10_focal_error_from,percent");
  writeHistogram(histogram, experiment.errors(Motion::Random, {0, 0}, progress));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Errors of the minimal solvers under noise of the 3D points and of the images, and their numerical stability."};
  Experiment experiment;
  addCommonOptions(app, experiment.options, "threads that share the scenes");
  CLI::Option* scenes =
      app.add_option("--scenes", experiment.scenes, "number of scenes (--quick: 40)")->check(CLI::Range(1, 10000000));
  scenes->capture_default_str();
  return runExperiment(app, argc, argv, [&] {
    if (experiment.options.quick && !*scenes) experiment.scenes = 40;
    run(experiment);
  });
}

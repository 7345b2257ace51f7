// Every image of a sparse model in turn is localized against the others, with different sets of minimal solvers in the same
// hybrid RANSAC, with and without local optimization. All score the 2D-2D and the 2D-3D matches alike.
//
// Writes localization_table.csv. Takes any COLMAP, Bundler or NVM models; without one, the map that comes with the library.
#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/detail/parallelFor.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <cmath>
#include <limits>

#include "../common/CsvFile.hpp"
#include "../common/Options.hpp"
#include "../common/processorSeconds.hpp"
#include "../common/sceneName.hpp"
#include "common/PoseError.hpp"
#include "common/ProgressBar.hpp"
#include "common/Statistics.hpp"

namespace {

using hybridgv::Solver;
using hybridgv::sac::HybridRansacOptions;
using hybridgv::sfm::LocalizationProblem;
using hybridgv::sfm::SparseModel;

struct Settings {
  CommonOptions options;
  std::vector<std::string> maps;
  double outlierShare = 0.3, maxRotationDeg = 1, maxPositionPercent = 2;
  int repetitions = 50;
  HybridRansacOptions ransac;
};

struct SolverSet {
  const char* name;
  std::vector<hybridgv::sac::SolverPrior> solvers;
};

const std::vector<SolverSet> kSolverSets = {
    {"P4Pf", {{Solver::P4Pf}}},
    {"P3.5Pf", {{Solver::P35Pf}}},
    {"H13f", {{Solver::H13f}}},
    {"H32f", {{Solver::H32f}}},
    {"H51f", {{Solver::H51f}}},
    {"P3.5Pf+H13f+H51f", {{Solver::P35Pf}, {Solver::H13f}, {Solver::H51f}}},
    {"all", HybridRansacOptions().solvers},
};

struct Query {
  LocalizationProblem problem;
  double depth;  // median of the map's points that the query image sees: the yardstick of its position error
};

std::vector<Query> makeQueries(const SparseModel& map) {
  std::vector<Query> queries;
  for (std::size_t i = 0; i < map.images.size(); ++i) {
    const hybridgv::sfm::Image& image = map.images[i];
    std::vector<double> depths;
    for (const hybridgv::sfm::Observation& observation : image.observations)
      if (observation.point != observation.kNoPoint)
        depths.push_back(image.rotation.col(2).dot(map.points[observation.point].position - image.position));
    if (image.registered && !depths.empty()) queries.push_back({makeLocalizationProblem(map, i), median(depths)});
  }
  return queries;
}

struct Attempt {
  bool success = false, good = false;
  PoseError error{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::infinity()};
  double milliseconds = 0;
  int iterations = 0;
};

// The position error is in percent of the query's depth.
Attempt localize(const Query& query, const Settings& settings, const HybridRansacOptions& options) {
  const LocalizationProblem problem = injectOutliers(query.problem, settings.outlierShare, options.seed);
  const double start = threadSeconds();
  const hybridgv::sac::HybridRansacResult result = hybridRansac(problem.adapter, options);  // in this thread
  Attempt attempt;
  attempt.success = result.success;
  attempt.milliseconds = 1e3 * (threadSeconds() - start);
  attempt.iterations = result.iterations;
  if (!result.success) return attempt;
  attempt.error = poseError(result.pose, *query.problem.reference);
  attempt.error.focalPercent = std::abs(attempt.error.focalPercent);
  attempt.error.position *= 100 / query.depth;
  attempt.good = attempt.error.rotationDeg < settings.maxRotationDeg && attempt.error.position < settings.maxPositionPercent;
  return attempt;
}

void writeRow(CsvFile& csv, const std::string& scene, std::size_t queries, const SolverSet& set, bool optimize,
              const std::vector<Attempt>& attempts) {
  std::vector<double> rotation, position, focal, milliseconds, iterations;
  double success = 0, good = 0;
  for (const Attempt& attempt : attempts) {
    success += attempt.success;
    good += attempt.good;
    rotation.push_back(attempt.error.rotationDeg);
    position.push_back(attempt.error.position);
    focal.push_back(attempt.error.focalPercent);
    milliseconds.push_back(attempt.milliseconds);
    iterations.push_back(attempt.iterations);
  }
  const double share = 100.0 / static_cast<double>(attempts.size());
  csv.row(scene, queries, set.name, optimize ? "yes" : "no", share * success, share * good, median(rotation), median(position),
          median(focal), median(milliseconds), median(iterations));
}

void run(const Settings& settings) {
  CsvFile csv(
      settings.options.output, "localization_table.csv",
      {text("each query image ", settings.repetitions, " times, with other wrong matches and another seed each time, from ",
            settings.options.seed, " on; wrong matches: ", 100 * settings.outlierShare, " %; thresholds ",
            settings.ransac.maxReprojectionErrorPx, " px (2D-3D), ", settings.ransac.maxEpipolarErrorPx, " px (2D-2D); hybridgv ",
            hybridgv::version()),
       text("within_percent: rotation within ", settings.maxRotationDeg, " deg and position within ", settings.maxPositionPercent,
            " % of the median depth of the image's points; a failure counts as an infinite error; milliseconds of processor "
            "time")},
      "scene,queries,solvers,local_optimization,success_percent,within_percent,rotation_deg,position_percent_of_depth,"
      "focal_percent,milliseconds,iterations");
  for (const std::string& path : settings.maps) {
    const std::vector<Query> queries = makeQueries(hybridgv::sfm::readModel(path));
    if (queries.empty()) throw std::invalid_argument(path + " has no image that can be localized");
    const std::string scene = sceneName(path);
    const std::size_t attempts = queries.size() * static_cast<std::size_t>(settings.repetitions);
    ProgressBar progress(2 * kSolverSets.size() * attempts, !settings.options.quiet);
    for (const SolverSet& set : kSolverSets)
      for (const bool optimize : {false, true}) {
        std::vector<Attempt> results(attempts);
        hybridgv::detail::parallelFor(attempts, settings.options.threads, [&](std::size_t i) {
          HybridRansacOptions options = settings.ransac;
          options.solvers = set.solvers;
          options.localOptimization = options.finalOptimization = optimize;
          options.seed = settings.options.seed + i;
          results[i] = localize(queries[i % queries.size()], settings, options);
          progress.step();
        });
        writeRow(csv, scene, queries.size(), set, optimize, results);
      }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Localizes every image of sparse models with each minimal solver in the hybrid RANSAC, plain and with local optimization."};
  Settings settings;
  addCommonOptions(app, settings.options, "threads that share the images (each is localized by one)");
  app.add_option("map", settings.maps, "COLMAP folder, Bundler .out or NVM file (default: the map that comes with the library)");
  app.add_option("--outliers", settings.outlierShare, "share of the matches to pair wrongly, 0 .. 1")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--max-rotation", settings.maxRotationDeg, "bound of a good pose [deg]")->capture_default_str();
  app.add_option("--max-position", settings.maxPositionPercent, "bound of a good pose [% of the depth]")->capture_default_str();
  app.add_option("--max-reprojection-error", settings.ransac.maxReprojectionErrorPx, "inlier threshold of 2D-3D matches [px]")
      ->capture_default_str();
  app.add_option("--max-epipolar-error", settings.ransac.maxEpipolarErrorPx, "inlier threshold of 2D-2D matches [px]")
      ->capture_default_str();
  CLI::Option* repetitions =
      app.add_option("--repetitions", settings.repetitions, "attempts per image (--quick: 1)")->check(CLI::Range(1, 100000));
  repetitions->capture_default_str();
  return runExperiment(app, argc, argv, [&] {
    if (settings.maps.empty()) settings.maps = {HYBRIDGV_DEFAULT_MAP};
    if (settings.options.quick && !*repetitions) settings.repetitions = 1;
    settings.ransac.check();
    run(settings);
  });
}

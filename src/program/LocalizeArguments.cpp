#include "LocalizeArguments.hpp"

#include <hybridgv/types.hpp>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "common/CommandLine.hpp"

namespace program {
namespace {

// "all, p4pf, .."
std::string solverNames() {
  std::string names = "all";
  for (const hybridgv::Solver solver : hybridgv::allSolvers()) names += std::string(", ") + hybridgv::toString(solver);
  return names;
}

std::string checkSolver(const std::string& name) {
  const std::vector<hybridgv::Solver> solvers = hybridgv::allSolvers();
  const auto isNamed = [&](hybridgv::Solver solver) { return name == hybridgv::toString(solver); };
  const bool isKnown = name == "all" || std::any_of(solvers.begin(), solvers.end(), isNamed);
  return isKnown ? std::string() : "unknown name \"" + name + "\", valid are " + solverNames();
}

std::string checkFocalLength(const std::string& given) {
  double focalLength = 0;
  const bool isNumber = CLI::detail::lexical_cast(given, focalLength) && isPositive(focalLength);
  return given == "prior" || isNumber ? std::string() : "must be positive and finite, or prior, is " + given;
}

// The map that comes with the library: beside the installed program, else among the sources.
std::string defaultMap() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed = program.parent_path().parent_path() / HYBRIDGV_DEFAULT_MAP_IN_PREFIX;
  return !error && std::filesystem::is_directory(installed, error) ? installed.string() : HYBRIDGV_DEFAULT_MAP;
}

}  // namespace

int parseLocalize(std::vector<std::string> given, LocalizeArguments& arguments) {
  CLI::App app{
      "Localizes images of unknown focal length and distortion against a map, from 2D-2D and 2D-3D matches together (hybrid "
      "LO-RANSAC),\n"
      "and compares with what the 2D-3D matches alone give on the same data (P3.5Pf). Each query is left out of the map, and of\n"
      "its calibration nothing is used but the size of the image. Focal length and k1 are those of COLMAP's SIMPLE_RADIAL.\n"
      "Without an argument it runs on a small map that comes with the library.\n",
      "hybridgv localize"};
  app.add_option("input", arguments.inputs,
                 "a map (COLMAP folder, text or binary; Bundler v0.3 file; NVM_V3 file), or problem files in text format");
  app.add_option("-q,--query", arguments.queries, "names or indices of the query images (default: every image in turn)");
  app.add_flag("--stdin", arguments.readStandardInput,
               "read query names (if a map is given) or problem files from standard input, one a line");
  app.add_option("-s,--solver", arguments.solver, "minimal solver: " + solverNames())->check(checkSolver)->capture_default_str();
  app.add_option("--query-camera", arguments.queryCamera,
                 "radial: the lens distortion is found too, and kept if the data speak for it; pinhole: there is none")
      ->check(CLI::IsMember({"radial", "pinhole"}))
      ->capture_default_str();
  app.add_option("--focal-length", arguments.focalLength,
                 "of the queries, where it is known [px]; \"prior\": the map's is known roughly, as from EXIF (default: unknown)")
      ->check(checkFocalLength);
  arguments.matches.undistortQuery = false;
  app.add_flag("--undistort-query", arguments.matches.undistortQuery,
               "remove the distortion of a query from the map by its calibration, and use its principal point");
  app.add_flag("--rays-only", arguments.matches.raysOnly, "as if the map had no points: all its matches are 2D-2D");
  hybridgv::sac::HybridRansacOptions& ransac = arguments.ransac;
  addNumber(app, "--max-reprojection-error", ransac.maxReprojectionErrorPx, "inlier threshold of 2D-3D matches [px]",
            "positive and finite", isPositive);
  addNumber(app, "--max-epipolar-error", ransac.maxEpipolarErrorPx, "inlier threshold of 2D-2D matches, Sampson error [px]",
            "positive and finite", isPositive);
  addNumber(app, "--principal-point-deviation", ransac.principalPointDeviationPx,
            "how far the principal point may be off, standard deviation [px]: allowed for in those of the results",
            "finite and not negative", isNotNegative);
  addNumber(app, "--min-parallax", arguments.matches.minParallaxDeg,
            "smaller parallax of the map's rays makes a match 2D-2D [deg]", "finite and not negative", isNotNegative);
  addNumber(app, "--outliers", arguments.outlierShare, "share of the matches to pair wrongly, 0 .. 1", "from 0 to 1", isShare);
  addSeed(app, "--seed", ransac.seed, "seed of everything random");
  addNumber(app, "--threads", ransac.threads, "threads per query, 0 = all cores", "0 (all cores) or a positive integer",
            isNotNegativeInteger);
  addNumber(app, "--max-iterations", ransac.maxIterations, "largest number of samples", "a positive integer", isCount);
  addNumber(app, "--success-probability", ransac.successProbability, "when to stop sampling", "between 0 and 1", isProbability);
  addPageOptions(app, arguments.page);
  app.add_flag("--json", arguments.json, "one JSON object per query and line instead of the table");
  app.add_flag("--strict", arguments.reading.strict, "refuse maps with faults that are mended otherwise");
  app.add_flag("--quiet", arguments.quiet, "no progress bar, no word about what was mended in the map");
  const int exitCode = parse(app, std::move(given));
  if (exitCode >= 0) return exitCode;
  if (!arguments.focalLength.empty() && arguments.focalLength != "prior")
    ransac.knownFocalLengthPx = std::stod(arguments.focalLength);
  const std::string contradiction = findContradiction(arguments.page);
  if (!contradiction.empty()) throw std::invalid_argument(contradiction);
  if (arguments.solver != "all") ransac.solvers = {{hybridgv::solverFromString(arguments.solver), 1.0}};
  if (arguments.inputs.empty() && !arguments.readStandardInput) arguments.inputs = {defaultMap()};
  return -1;
}

}  // namespace program

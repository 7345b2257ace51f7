// The main job: localizes query images of unknown focal length against a map, and shows what the 2D-2D matches add.
//
//   localize                          the default map, each of its images in turn as the query
//   localize MAP [--query NAME ...]   a COLMAP folder (text or binary), a Bundler .out or an NVM file
//   localize PROBLEM.txt ...          problems in the text format of hybridgv/adapters/sfm/LocalizationProblem.hpp
#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "common/PoseError.hpp"
#include "common/ProgressBar.hpp"
#include "common/Statistics.hpp"

namespace {

using hybridgv::FocalPose;
using hybridgv::NoncentralHybridAdapter;
using hybridgv::sac::HybridRansacOptions;
using hybridgv::sac::HybridRansacResult;
using hybridgv::sfm::LocalizationProblem;
using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> inputs;
  std::vector<std::string> queries;
  std::string solver = "all";
  hybridgv::sfm::LocalizationProblemOptions matches;
  hybridgv::sfm::ReadOptions reading;
  HybridRansacOptions ransac;
  double outlierShare = 0;
  bool json = false, readStandardInput = false, quiet = false;
};

// "all, p4pf, .."
std::string solverNames() {
  std::string names = "all";
  for (const hybridgv::Solver solver : hybridgv::allSolvers()) names += std::string(", ") + hybridgv::toString(solver);
  return names;
}

// Adds an option whose value must be a number for which `holds`. Otherwise the message names the option, what it `must` be and what
// was given.
template <class Number>
void addNumber(CLI::App& app, const char* name, Number& value, const char* help, const char* must, bool (*holds)(Number)) {
  const auto check = [must, holds](const std::string& given) {
    Number number{};
    const bool isNumber = CLI::detail::lexical_cast(given, number);
    return isNumber && holds(number) ? std::string() : "must be " + std::string(must) + ", is " + given;
  };
  app.add_option(name, value, help)->check(check)->capture_default_str();
}

bool isPositive(double value) { return value > 0 && std::isfinite(value); }
bool isNotNegative(double value) { return value >= 0 && std::isfinite(value); }
bool isShare(double value) { return value >= 0 && value <= 1; }
bool isProbability(double value) { return value > 0 && value < 1; }
bool isCount(int value) { return value > 0; }
bool isThreads(int value) { return value >= 0; }

// (CLI11 takes "-1" and numbers beyond 64 bits for other numbers.)
std::string checkSeed(const std::string& given) {
  std::uint64_t seed = 0;
  const char* const end = given.data() + given.size();
  const auto result = std::from_chars(given.data(), end, seed);
  return result.ec == std::errc() && result.ptr == end ? std::string() : "must be an integer from 0 to 2^64 - 1, is " + given;
}

std::string checkSolver(const std::string& name) {
  const std::vector<hybridgv::Solver> solvers = hybridgv::allSolvers();
  const auto isNamed = [&](hybridgv::Solver solver) { return name == hybridgv::toString(solver); };
  const bool isKnown = name == "all" || std::any_of(solvers.begin(), solvers.end(), isNamed);
  return isKnown ? std::string() : "unknown name \"" + name + "\", valid are " + solverNames();
}

// Fills `arguments`; returns the exit code if the program is to stop here (help, wrong usage), -1 otherwise.
int parse(int argc, char** argv, Arguments& arguments) {
  CLI::App app{
      "Localizes images of unknown focal length against a map, from 2D-2D and 2D-3D matches together (hybrid LO-RANSAC),\n"
      "and compares with what the 2D-3D matches alone give on the same data (P3.5Pf). Each query is left out of the map.\n"
      "Without an argument it runs on a small map that comes with the library.\n"};
  app.add_option("input", arguments.inputs,
                 "a map (COLMAP folder, text or binary; Bundler v0.3 file; NVM_V3 file), or problem files in text format");
  app.add_option("-q,--query", arguments.queries, "names or indices of the query images (default: every image in turn)");
  app.add_flag("--stdin", arguments.readStandardInput,
               "read query names (if a map is given) or problem files from standard input, one a line");
  app.add_option("-s,--solver", arguments.solver, "minimal solver: " + solverNames())->check(checkSolver)->capture_default_str();
  HybridRansacOptions& ransac = arguments.ransac;
  addNumber(app, "--max-reprojection-error", ransac.maxReprojectionErrorPx, "inlier threshold of 2D-3D matches [px]",
            "positive and finite", isPositive);
  addNumber(app, "--max-epipolar-error", ransac.maxEpipolarErrorPx, "inlier threshold of 2D-2D matches, Sampson error [px]",
            "positive and finite", isPositive);
  addNumber(app, "--min-parallax", arguments.matches.minParallaxDeg,
            "smaller parallax of the map's rays makes a match 2D-2D [deg]", "finite and not negative", isNotNegative);
  addNumber(app, "--outliers", arguments.outlierShare, "share of the matches to pair wrongly, 0 .. 1", "from 0 to 1", isShare);
  app.add_option("--seed", ransac.seed, "seed of everything random")->check(checkSeed)->capture_default_str();
  addNumber(app, "--threads", ransac.threads, "threads per query, 0 = all cores", "0 (all cores) or a positive integer",
            isThreads);
  addNumber(app, "--max-iterations", ransac.maxIterations, "largest number of samples", "a positive integer", isCount);
  addNumber(app, "--success-probability", ransac.successProbability, "when to stop sampling", "between 0 and 1", isProbability);
  app.add_flag("--json", arguments.json, "one JSON object per query and line instead of the table");
  app.add_flag("--strict", arguments.reading.strict, "refuse maps with faults that are mended otherwise");
  app.add_flag("--quiet", arguments.quiet, "no progress bar, no word about what was mended in the map");
  try {
    app.parse(argc, argv);
    if (arguments.solver != "all") arguments.ransac.solvers = {{hybridgv::solverFromString(arguments.solver), 1.0}};
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  if (arguments.inputs.empty() && !arguments.readStandardInput) arguments.inputs = {HYBRIDGV_DEFAULT_MAP};
  return -1;
}

// ------------------------------------------------------------------------------------------------------------ what to localize

// A query that is made when its turn comes.
using Query = std::function<LocalizationProblem()>;

// In quotation marks, with control characters as \xHH, so that one sees them.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    char code[8];
    std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned char>(c));
    const bool isControl = (c >= 0 && c < ' ') || c == 127;
    result += isControl ? std::string(code) : std::string(1, c);
  }
  return result + "\"";
}

// Without the blanks around it and the carriage return of Windows' text files.
std::string trimmed(const std::string& line) {
  constexpr const char* kBlanks = " \t\r";
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

std::vector<std::string> readLines(std::istream& in) {
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    line = trimmed(line);
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

// What the reader has mended, unless --quiet.
void printReport(const hybridgv::sfm::ReadReport& report, const Arguments& arguments) {
  if (arguments.quiet) return;
  for (const std::string& sentence : report.sentences()) std::fprintf(stderr, "localize: %s\n", sentence.c_str());
}

// All images of this name, of which a map may have several; if there is none, the one whose index it is.
std::vector<std::size_t> findImages(const hybridgv::sfm::SparseModel& map, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < map.images.size(); ++i)
    if (map.images[i].name == name) found.push_back(i);
  if (!found.empty()) return found;
  std::size_t index = 0;
  const bool isNumber = CLI::detail::lexical_cast(name, index);
  if (isNumber && index < map.images.size()) return {index};
  throw std::invalid_argument("no image of the map is called " + quoted(name));
}

// A panorama has no pose with a focal length to look for.
bool canBeQuery(const hybridgv::sfm::SparseModel& map, std::size_t index, const Arguments& arguments) {
  const hybridgv::sfm::Image& image = map.images[index];
  if (!image.registered) return false;
  const hybridgv::sfm::CameraModel model = map.cameras[image.camera].model;
  if (hasImagePlane(model)) return true;
  if (!arguments.quiet)
    std::fprintf(stderr, "localize: %s is no query: %s has no image plane\n", image.name.c_str(), toString(model));
  return false;
}

std::vector<Query> queriesOfMap(const std::string& path, const Arguments& arguments, const std::vector<std::string>& names) {
  hybridgv::sfm::ReadReport report;
  const auto map = std::make_shared<const hybridgv::sfm::SparseModel>(hybridgv::sfm::readModel(path, arguments.reading, &report));
  printReport(report, arguments);
  std::vector<std::size_t> images;
  for (const std::string& name : names)
    for (const std::size_t image : findImages(*map, name)) images.push_back(image);
  if (names.empty())
    for (std::size_t i = 0; i < map->images.size(); ++i)
      if (canBeQuery(*map, i, arguments)) images.push_back(i);
  std::vector<Query> queries;
  for (const std::size_t image : images)
    queries.emplace_back([map, image, options = arguments.matches] { return makeLocalizationProblem(*map, image, options); });
  return queries;
}

std::vector<Query> collectQueries(const Arguments& arguments) {
  std::vector<std::string> names = arguments.queries, files;
  std::vector<std::string> maps;
  for (const std::string& input : arguments.inputs) (hybridgv::sfm::isProblemFile(input) ? files : maps).push_back(input);
  if (arguments.readStandardInput)
    for (const std::string& line : readLines(std::cin)) (maps.empty() ? files : names).push_back(line);
  if (maps.empty() && !arguments.queries.empty()) throw std::invalid_argument("--query: there is no map to look for images in");
  for (const std::string& file : files)
    if (maps.empty() && !std::filesystem::exists(file))
      throw std::invalid_argument("no file is called " + quoted(file) + "; to localize an image by its name, name its map too");
  std::vector<Query> queries;
  for (const std::string& map : maps)
    for (Query& query : queriesOfMap(map, arguments, names)) queries.push_back(std::move(query));
  for (const std::string& file : files)
    queries.emplace_back([file, &arguments] {
      hybridgv::sfm::ReadReport report;
      LocalizationProblem problem = hybridgv::sfm::readProblem(file, arguments.reading, &report);
      printReport(report, arguments);
      return problem;
    });
  return queries;
}

// ------------------------------------------------------------------------------------------------------------ localization

struct Localization {
  HybridRansacResult result;
  std::optional<PoseError> error;  // if the query has a reference and a pose was found
};

Localization localize(const NoncentralHybridAdapter& adapter, const std::optional<FocalPose>& reference,
                      const HybridRansacOptions& options) {
  Localization localization{hybridRansac(adapter, options), {}};
  if (reference && localization.result.success) localization.error = poseError(localization.result.pose, *reference);
  return localization;
}

NoncentralHybridAdapter pointsOnly(const NoncentralHybridAdapter& adapter) {
  std::vector<Eigen::Vector3d> imagePoints, points;
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i) {
    imagePoints.push_back(adapter.getImagePoint2d3d(i));
    points.push_back(adapter.getPoint(i));
  }
  return {{}, {}, {}, {}, {}, imagePoints, points};
}

struct Row {
  LocalizationProblem problem;
  Localization hybrid, pointsOnly;
};

Row localizeBothWays(LocalizationProblem problem, const Arguments& arguments) {
  if (arguments.outlierShare > 0) problem = injectOutliers(problem, arguments.outlierShare, arguments.ransac.seed);
  HybridRansacOptions p35pf = arguments.ransac;
  p35pf.solvers = {{hybridgv::Solver::P35Pf, 1.0}};
  const Localization hybrid = localize(problem.adapter, problem.reference, arguments.ransac);
  const Localization reference = localize(pointsOnly(problem.adapter), problem.reference, p35pf);
  return {std::move(problem), hybrid, reference};
}

// ------------------------------------------------------------------------------------------------------------ output

// What was printed has arrived: results must not be lost in silence on a full disk, nor with a program that is interrupted.
void flush() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw std::runtime_error("cannot write to the standard output");
}

// The table is 100 columns wide.
constexpr std::size_t kNameWidth = 17;

void printHeader() {
  std::printf("%-17s %7s | %7s %6s %6s %6s %8s %8s %8s | %s\n", "", "", "hybrid", "", "", "", "", "inliers", "inliers",
              "2D-3D only");
  std::printf("%-17s %7s | %7s %6s %6s %6s %8s %8s %8s | %7s %6s\n", "query", "f ref", "f px", "+- px", "df %", "dR deg", "dpos",
              "2D-2D", "2D-3D", "f px", "df %");
}

// A name that is too long loses its beginning, which is the same for most.
std::string shortened(const std::string& name) {
  if (name.size() <= kNameWidth) return name;
  std::size_t start = name.size() - (kNameWidth - 2);
  const auto isInsideOfCharacter = [&] { return (static_cast<unsigned char>(name[start]) & 0xC0) == 0x80; };  // of UTF-8
  while (start < name.size() && isInsideOfCharacter()) ++start;
  return ".." + name.substr(start);
}

std::string share(int inliers, std::size_t all) { return std::to_string(inliers) + "/" + std::to_string(all); }

void printErrors(const std::optional<PoseError>& error) {
  if (error)
    std::printf(" %6.2f %6.3f %8.4f", error->focalPercent, error->rotationDeg, error->position);
  else
    std::printf(" %6s %6s %8s", "-", "-", "-");
}

void printFocalLength(const HybridRansacResult& result) {
  if (result.success)
    std::printf(" %7.1f", result.pose.focalLength);
  else
    std::printf(" %7s", "failed");
}

void printRow(const Row& row) {
  const HybridRansacResult& hybrid = row.hybrid.result;
  const NoncentralHybridAdapter& adapter = row.problem.adapter;
  std::printf("%-17s", shortened(row.problem.imageName).c_str());
  if (row.problem.reference)
    std::printf(" %7.1f |", row.problem.reference->focalLength);
  else
    std::printf(" %7s |", "-");
  printFocalLength(hybrid);
  if (hybrid.success)
    std::printf(" %6.1f", hybrid.focalLengthStandardDeviation);
  else
    std::printf(" %6s", "-");
  printErrors(row.hybrid.error);
  std::printf(" %8s %8s |", share(hybrid.numberInliers2d2d, adapter.getNumberCorrespondences2d2d()).c_str(),
              share(hybrid.numberInliers2d3d, adapter.getNumberCorrespondences2d3d()).c_str());
  printFocalLength(row.pointsOnly.result);
  if (row.pointsOnly.error)
    std::printf(" %6.2f\n", row.pointsOnly.error->focalPercent);
  else
    std::printf(" %6s\n", "-");
}

Json toJson(const Localization& localization) {
  const HybridRansacResult& result = localization.result;
  Json json{{"success", result.success}};
  if (!result.success) json["failure_reason"] = toString(result.failureReason);
  if (result.success) {
    const FocalPose& pose = result.pose;
    json["focal_length_px"] = pose.focalLength;
    json["focal_length_std_px"] = result.focalLengthStandardDeviation;
    json["rotation_query_to_rig"] = std::vector<double>(pose.rotation.data(), pose.rotation.data() + 9);  // column by column
    json["position"] = std::vector<double>(pose.position.data(), pose.position.data() + 3);
  }
  json["inliers_2d2d"] = result.numberInliers2d2d;
  json["inliers_2d3d"] = result.numberInliers2d3d;
  json["iterations"] = result.iterations;
  if (localization.error) {
    json["focal_error_percent"] = localization.error->focalPercent;
    json["rotation_error_deg"] = localization.error->rotationDeg;
    json["position_error"] = localization.error->position;
  }
  json["seconds"] = result.seconds;
  return json;
}

void printJson(const Row& row) {
  Json json{{"query", row.problem.imageName},
            {"matches_2d2d", row.problem.adapter.getNumberCorrespondences2d2d()},
            {"matches_2d3d", row.problem.adapter.getNumberCorrespondences2d3d()}};
  if (row.problem.reference) json["reference_focal_length_px"] = row.problem.reference->focalLength;
  json["hybrid"] = toJson(row.hybrid);
  json["points_only"] = toJson(row.pointsOnly);
  // Names need not be UTF-8, of which JSON consists.
  std::printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

// Collects what the closing line of the table says.
class Summary {
 public:
  void add(const Localization& localization) {
    ++queries_;
    if (localization.result.success) ++successes_;
    milliseconds_.push_back(1e3 * localization.result.seconds);
    if (!localization.error) return;
    focal_.push_back(std::abs(localization.error->focalPercent));
    rotation_.push_back(localization.error->rotationDeg);
    position_.push_back(localization.error->position);
  }
  void print(const char* name) const {
    std::printf("%-10s localized %d of %d", name, successes_, queries_);
    if (!focal_.empty())
      std::printf("; medians: f %.3f %%, rotation %.4f deg, position %.5f", median(focal_), median(rotation_), median(position_));
    std::printf(", %.2f ms\n", median(milliseconds_));
  }

 private:
  int queries_ = 0, successes_ = 0;
  std::vector<double> focal_, rotation_, position_, milliseconds_;
};

void run(const Arguments& arguments) {
  const std::vector<Query> queries = collectQueries(arguments);
  if (queries.empty()) throw std::invalid_argument("nothing to localize");
  ProgressBar progress(queries.size(), !arguments.quiet);
  Summary hybrid, pointsOnly;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    progress.show(i);
    const Row row = localizeBothWays(queries[i](), arguments);
    hybrid.add(row.hybrid);
    pointsOnly.add(row.pointsOnly);
    progress.clear();
    if (!arguments.json && i == 0) printHeader();
    if (arguments.json)
      printJson(row);
    else
      printRow(row);
    flush();
  }
  if (arguments.json) return;
  hybrid.print("hybrid");
  pointsOnly.print("2D-3D only");
  flush();
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  try {
    const int exitCode = parse(argc, argv, arguments);
    if (exitCode >= 0) return exitCode;
    run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "localize: %s\n", error.what());
    return 1;
  }
}

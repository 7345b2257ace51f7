// Images that are not in the map, with the features and matches that COLMAP found in them: this library, from both kinds of matches and from
// 2D-3D matches alone, beside what programs have registered. real_photos.sh makes such folders of images.
//
// Writes real_photos.csv (a row for each kind of map and method) and real_photos_queries.csv (a row for each image, map and method).
#include <hybridgv/adapters/colmap/DatabaseQueries.hpp>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/adapters/sfm/localizeQuery.hpp>
#include <hybridgv/detail/parallelFor.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>

#include "../common/CsvFile.hpp"
#include "../common/Options.hpp"
#include "../common/processorSeconds.hpp"
#include "../common/sceneName.hpp"
#include "PhotoSets.hpp"
#include "common/PoseError.hpp"
#include "common/ProgressBar.hpp"
#include "common/Statistics.hpp"

namespace {

namespace fs = std::filesystem;
using namespace hybridgv::sfm;
using hybridgv::FocalPose;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMaxRotationDeg = 1, kMaxPositionPercent = 5;

// What this library is asked in this program.
struct Method {
  const char* name;
  MatchTable table;
  bool hasRays;
};
const std::vector<Method> kMethods = {{"hybrid; verified matches", MatchTable::Verified, true},
                                      {"2D-3D only; verified matches", MatchTable::Verified, false},
                                      {"hybrid; raw matches", MatchTable::Raw, true},
                                      {"2D-3D only; raw matches", MatchTable::Raw, false}};
// Programs whose models are read: FOLDER/PROGRAM/MAP, with seconds.txt where their time was taken.
const std::vector<std::string> kPrograms = {"colmap", "hybridgv"};

struct Settings {
  CommonOptions common;
  int repetitions = 20;
};

struct Attempt {
  std::string map, query, method;
  PoseError error{kInfinity, kInfinity, kInfinity};  // position in percent of the depth
  double milliseconds = 0;
  std::optional<double> ratio = {};  // of the focal length's error and its standard deviation
};

// Of the points that the query is matched with, seen from where it was; of all points of the map where it is matched with none.
double medianDepth(const SparseModel& map, const QueryImage& query, const FocalPose& truth) {
  std::vector<double> depths;
  const auto add = [&](const Eigen::Vector3d& point) { depths.push_back(truth.rotation.col(2).dot(point - truth.position)); };
  const LocalizationProblem problem = makeLocalizationProblem(map, query);
  for (std::size_t i = 0; i < problem.points2d3d.size(); ++i) add(map.points[problem.points2d3d[i]].position);
  if (depths.empty())
    for (const Point& point : map.points) add(point.position);
  return median(depths);
}

PoseError relativeError(const FocalPose& pose, const FocalPose& truth, double depth) {
  PoseError error = poseError(pose, truth);
  error.focalPercent = std::abs(error.focalPercent);
  error.position *= 100 / depth;
  return error;
}

// Leaves the matches with points that are used as such.
void removeRays(QueryImage& query, const SparseModel& map, const std::vector<char>& isCertain) {
  for (ImageMatches& matches : query.matches) {
    const std::vector<Observation>& observations = map.images[matches.image].observations;
    const auto isRay = [&](const std::array<std::uint32_t, 2>& pair) {
      if (pair[1] >= observations.size()) return true;
      const std::size_t point = observations[pair[1]].point;
      return point == Observation::kNoPoint || isCertain[point] == 0;
    };
    matches.pairs.erase(std::remove_if(matches.pairs.begin(), matches.pairs.end(), isRay), matches.pairs.end());
  }
}

// All that is asked about the images of one map.
class MapExperiment {
 public:
  MapExperiment(const std::string& folder, const PhotoMap& photos, const Settings& settings)
      : folder_(folder), photos_(photos), map_(readModel(photos.path)), settings_(settings) {
    options_.matches.certainPoints = findCertainPoints(map_);
  }

  void run(std::vector<Attempt>& attempts) {
    measureDepths();
    for (const std::string& program : kPrograms) readProgram(program, attempts);
    for (const Method& method : kMethods) localize(method, attempts);
  }

 private:
  DatabaseQueries queries(MatchTable table) const {
    DatabaseQueryOptions options;
    options.table = table;
    return DatabaseQueries(ColmapDatabase(folder_ + "/database.db"), map_, options);
  }

  void measureDepths() {
    DatabaseQueries images = queries(MatchTable::Verified);
    for (const PhotoReference& reference : photos_.queries)
      depths_.push_back(medianDepth(map_, images.read(reference.name), reference.pose));
    tried_ = images.namesNotInMap().size();
  }

  // The file has the seconds that a program took, and for how many images if not for all that the map lacks.
  double millisecondsPerImage(const std::string& path) const {
    double seconds = 0, images = 0;
    std::ifstream in(path);
    in >> seconds;
    if (!(in >> images)) images = static_cast<double>(tried_);
    return 1e3 * seconds / images;
  }

  void readProgram(const std::string& program, std::vector<Attempt>& attempts) {
    const std::string path = folder_ + "/" + program + "/" + photos_.name;
    if (!fs::exists(path)) return;
    const SparseModel model = readModel(path);
    const double milliseconds = millisecondsPerImage(path + "/seconds.txt");
    for (std::size_t i = 0; i < photos_.queries.size(); ++i) {
      const PhotoReference& reference = photos_.queries[i];
      Attempt attempt{photos_.name, reference.name, program + " image_registrator"};
      attempt.milliseconds = milliseconds;
      if (const Image* image = findPosed(model, reference.name))
        attempt.error = relativeError(poseOf(model, *image), reference.pose, depths_[i]);
      attempts.push_back(attempt);
    }
  }

  void localize(const Method& method, std::vector<Attempt>& attempts) {
    DatabaseQueries images = queries(method.table);
    std::vector<QueryImage> read;
    for (const PhotoReference& reference : photos_.queries) {
      read.push_back(images.read(reference.name));
      if (!method.hasRays) removeRays(read.back(), map_, *options_.matches.certainPoints);
    }
    const std::size_t first = attempts.size(), count = read.size() * static_cast<std::size_t>(settings_.repetitions);
    attempts.resize(first + count);
    hybridgv::detail::parallelFor(count, settings_.common.threads, [&](std::size_t i) {
      const std::size_t query = i % read.size();
      attempts[first + i] = localizeOne(read[query], query, settings_.common.seed + i / read.size());
      attempts[first + i].method = method.name;
    });
  }

  Attempt localizeOne(const QueryImage& query, std::size_t number, std::uint64_t seed) const {
    const PhotoReference& reference = photos_.queries[number];
    QueryOptions options = options_;
    options.ransac.seed = seed;
    Attempt attempt{photos_.name, reference.name, ""};
    const double start = threadSeconds();
    const QueryLocalization found = localizeQuery(map_, query, options);  // in this thread
    attempt.milliseconds = 1e3 * (threadSeconds() - start);
    if (!found.success) return attempt;
    const CameraEstimate camera = estimateOf(found);
    FocalPose pose = found.result.pose;
    pose.focalLength = camera.focalLength;
    attempt.error = relativeError(pose, reference.pose, depths_[number]);
    attempt.ratio = std::abs(camera.focalLength - reference.pose.focalLength) / camera.deviation;
    return attempt;
  }

  const std::string& folder_;
  const PhotoMap& photos_;
  const SparseModel map_;
  const Settings& settings_;
  QueryOptions options_;
  std::vector<double> depths_;  // of each query
  std::size_t tried_ = 0;       // images of the database that the map lacks
};

// "median,90 % quantile"
std::string quantiles(const std::vector<double>& values) { return text(median(values), ',', quantile(values, 0.9)); }

void writeRow(CsvFile& csv, const std::string& key, const std::vector<Attempt>& attempts) {
  std::vector<double> focal, rotation, position, ratios, milliseconds;
  double registered = 0, within = 0, honest = 0;
  for (const Attempt& attempt : attempts) {
    focal.push_back(attempt.error.focalPercent);
    rotation.push_back(attempt.error.rotationDeg);
    position.push_back(attempt.error.position);
    milliseconds.push_back(attempt.milliseconds);
    registered += attempt.error.focalPercent < kInfinity;
    within += attempt.error.rotationDeg < kMaxRotationDeg && attempt.error.position < kMaxPositionPercent;
    if (attempt.ratio) {
      ratios.push_back(*attempt.ratio);
      honest += *attempt.ratio < 2;
    }
  }
  const double share = 100 / static_cast<double>(attempts.size());
  const std::string honesty = ratios.empty() ? "," : text(median(ratios), ',', 100 * honest / static_cast<double>(ratios.size()));
  csv.row(key, attempts.size(), share * registered, share * within, quantiles(focal), quantiles(rotation), quantiles(position),
          honesty, median(milliseconds));
}

// The attempts of each method, in the order in which the methods were tried.
void writeRows(CsvFile& csv, const std::string& key, const std::vector<Attempt>& attempts) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<Attempt>> byMethod;
  for (const Attempt& attempt : attempts) {
    if (byMethod.count(attempt.method) == 0) order.push_back(attempt.method);
    byMethod[attempt.method].push_back(attempt);
  }
  for (const std::string& method : order) writeRow(csv, text(key, ',', method), byMethod[method]);
}

std::string remark(const Settings& settings) {
  return text("library: every image with ", settings.repetitions, " seeds from ", settings.common.seed, " on; hybridgv ",
              hybridgv::version(), "; focal length [%], rotation [deg], position [% of the median depth of the matched points]");
}

void writeSet(const std::string& folder, const Settings& settings, CsvFile& table, CsvFile& single) {
  const std::string set = sceneName(folder);
  std::vector<std::string> kinds;
  std::map<std::string, std::vector<Attempt>> byKind;
  const std::vector<PhotoMap> maps = readPhotoMaps(folder);
  ProgressBar progress(maps.size(), !settings.common.quiet);
  for (const PhotoMap& map : maps) {
    const bool isNewKind = kinds.empty() || kinds.back() != map.kind();
    if (isNewKind) kinds.push_back(map.kind());
    if (isNewKind || !settings.common.quick) MapExperiment(folder, map, settings).run(byKind[map.kind()]);
    progress.step();
  }
  std::vector<Attempt> all;
  for (const std::string& kind : kinds) {
    writeRows(table, text(set, ',', kind), byKind[kind]);
    all.insert(all.end(), byKind[kind].begin(), byKind[kind].end());
  }
  if (kinds.size() > 1) writeRows(table, text(set, ",all"), all);
  for (const Attempt& a : all)
    single.row(set, a.map, a.query, a.method, a.error.focalPercent, a.error.rotationDeg, a.error.position,
               a.ratio ? text(*a.ratio) : "", a.milliseconds);
}

void run(const std::vector<std::string>& folders, const Settings& settings) {
  CsvFile table(settings.common.output, "real_photos.csv",
                {remark(settings),
                 text("within_percent: rotation within ", kMaxRotationDeg, " deg and position within ", kMaxPositionPercent,
                      " %; an image that was not registered counts as an infinite error"),
                 "error_over_deviation: of the focal length, medians; 0.67 and 95 % would be those of normal errors",
                 "milliseconds of processor time: of a query; of programs, of the whole command divided by its images"},
                "set,map,method,attempts,registered_percent,within_percent,focal_percent,focal_percent_90,rotation_deg,"
                "rotation_deg_90,position_percent,position_percent_90,error_over_deviation,within_2_deviations_percent,"
                "milliseconds");
  CsvFile single(settings.common.output, "real_photos_queries.csv", {remark(settings)},
                 "set,map,query,method,focal_percent,rotation_deg,position_percent,error_over_deviation,milliseconds");
  for (const std::string& folder : folders) writeSet(folder, settings, table, single);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Images that are not in the map, with COLMAP's features and matches: both kinds of matches, 2D-3D only, and COLMAP."};
  Settings settings;
  std::vector<std::string> folders;
  addCommonOptions(app, settings.common, "threads that share the images (each is localized by one)");
  app.add_option("folder", folders, "folders made by real_photos.sh, or laid out alike")
      ->required()
      ->check(CLI::ExistingDirectory);
  CLI::Option* repetitions =
      app.add_option("--repetitions", settings.repetitions, "attempts per image, with other seeds (--quick: 1)")
          ->check(CLI::Range(1, 100000));
  repetitions->capture_default_str();
  return runExperiment(app, argc, argv, [&] {
    if (settings.common.quick && !*repetitions) settings.repetitions = 1;
    run(folders, settings);
  });
}

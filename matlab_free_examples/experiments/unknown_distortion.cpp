// What unknown lens distortion does to the focal length, and what estimating it costs where there is none.
//
// The same scenes with three cameras: *pinhole*, distortion ignored; *free*, always estimated; *selected*, estimated and kept if the
// data speak for it. Writes unknown_distortion.csv (outliers, noise, distortion), distortion_strength.csv (more distortions, lenses of two
// models), distortion_price.csv (lenses without distortion), and with maps distortion_maps.csv (images with their own lenses).
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/adapters/sfm/ransacOptions.hpp>
#include <hybridgv/detail/parallelFor.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <array>
#include <limits>
#include <memory>

#include "../common/CsvFile.hpp"
#include "../common/Options.hpp"
#include "../common/processorSeconds.hpp"
#include "../common/sceneName.hpp"
#include "WideScene.hpp"
#include "common/PoseError.hpp"
#include "common/ProgressBar.hpp"
#include "common/Statistics.hpp"

namespace {

using hybridgv::FocalPose;
using hybridgv::sac::HybridRansacOptions;
using hybridgv::sac::HybridRansacResult;
using hybridgv::sac::QueryCamera;
using hybridgv::sfm::LocalizationProblem;
using hybridgv::sfm::SparseModel;
using hybridgv::test::HybridScene;
using hybridgv::test::WideSceneOptions;

constexpr double kImageNoisePx = 2;
constexpr std::array<const char*, 3> kCameras{"pinhole", "free", "selected"};

HybridRansacOptions optionsOf(std::size_t camera, std::uint64_t seed) {
  HybridRansacOptions options;
  options.seed = seed;
  if (camera > 0) options.queryCamera = QueryCamera::Radial;
  if (camera == 1) options.distortionEvidence = -std::numeric_limits<double>::infinity();
  return options;
}

struct Attempt {
  PoseError error{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::infinity()};
  double ratio = std::numeric_limits<double>::infinity();  // of the focal length's error and its standard deviation
  double milliseconds = 0, k1 = 0;
  bool isKept = false, isRight = false;
};

// `dividesTrueLens`: the true focal length is that of the division model, not of SIMPLE_RADIAL.
Attempt attempt(const hybridgv::NoncentralHybridAdapter& adapter, const HybridRansacOptions& options, const FocalPose& truth,
                bool dividesTrueLens) {
  const double start = threadSeconds();
  const HybridRansacResult result = hybridRansac(adapter, options);  // in this thread
  Attempt attempt;
  attempt.milliseconds = 1e3 * (threadSeconds() - start);
  if (!result.success) return attempt;
  FocalPose pose = result.pose;
  if (!dividesTrueLens) pose.focalLength = result.simpleRadialFocalLength;
  attempt.error = poseError(pose, truth);
  attempt.error.focalPercent = std::abs(attempt.error.focalPercent);
  attempt.ratio = std::abs(pose.focalLength - truth.focalLength) / result.focalLengthStandardDeviation;
  attempt.k1 = result.simpleRadialK1;
  attempt.isKept = result.distortion != 0;
  attempt.isRight = attempt.error.focalPercent < 10 && attempt.error.rotationDeg < 2;
  return attempt;
}

using Attempts = std::array<std::vector<Attempt>, kCameras.size()>;

template <class Value>
std::vector<double> valuesOf(const std::vector<Attempt>& attempts, Value value) {
  std::vector<double> values;
  for (const Attempt& attempt : attempts) values.push_back(value(attempt));
  return values;
}

double percentOf(const std::vector<Attempt>& attempts, bool Attempt::*property) {
  double count = 0;
  for (const Attempt& attempt : attempts) count += attempt.*property;
  return 100 * count / static_cast<double>(attempts.size());
}

const std::string kColumns =
    "camera,right_percent,focal_percent,focal_percent_90,rotation_deg,position,k1_found,error_over_deviation,milliseconds,kept_"
    "percent";

void writeRows(CsvFile& csv, const std::string& key, const Attempts& attempts) {
  for (std::size_t camera = 0; camera < kCameras.size(); ++camera) {
    const std::vector<Attempt>& of = attempts[camera];
    const std::vector<double> focal = valuesOf(of, [](const Attempt& a) { return a.error.focalPercent; });
    csv.row(key, kCameras[camera], percentOf(of, &Attempt::isRight), median(focal), quantile(focal, 0.9),
            median(valuesOf(of, [](const Attempt& a) { return a.error.rotationDeg; })),
            median(valuesOf(of, [](const Attempt& a) { return a.error.position; })),
            median(valuesOf(of, [](const Attempt& a) { return a.k1; })),
            median(valuesOf(of, [](const Attempt& a) { return a.ratio; })),
            median(valuesOf(of, [](const Attempt& a) { return a.milliseconds; })), percentOf(of, &Attempt::isKept));
  }
}

// All three cameras on the same scenes.
Attempts attemptScenes(const WideSceneOptions& scene, int scenes, const CommonOptions& common, bool dividesTrueLens) {
  Attempts attempts;
  for (std::vector<Attempt>& of : attempts) of.resize(static_cast<std::size_t>(scenes));
  hybridgv::detail::parallelFor(static_cast<std::size_t>(scenes), common.threads, [&](std::size_t i) {
    hybridgv::test::Random random(common.seed, i);
    const HybridScene data = makeWideScene(random, scene);
    hybridgv::NoncentralHybridAdapter adapter = data.adapter();
    adapter.setRigFocalLengths(std::vector<double>(data.offsets.size(), hybridgv::test::kRigFocalLength));
    for (std::size_t camera = 0; camera < kCameras.size(); ++camera)
      attempts[camera][i] = attempt(adapter, optionsOf(camera, common.seed + i), data.truth, dividesTrueLens);
  });
  return attempts;
}

WideSceneOptions sceneOf(int matches, double outlierShare, double pointNoisePercent) {
  WideSceneOptions scene;
  scene.rays = scene.points = matches;
  scene.imageNoise = kImageNoisePx;
  scene.pointNoise = pointNoisePercent / 100;
  scene.outlierShare = outlierShare;
  return scene;
}

std::string remark(int scenes, const CommonOptions& common) {
  return text(
      scenes, " scenes each, seed ", common.seed, "; image noise ", kImageNoisePx, " px; hybridgv ", hybridgv::version(),
      "; right: focal length within 10 %, rotation within 2 degrees; other columns: medians, of the focal length's error also "
      "the 90 % quantile; a failure counts as an infinite error; milliseconds of processor time");
}

void writeScenes(int scenes, const CommonOptions& common) {
  CsvFile csv(common.output, "unknown_distortion.csv",
              {remark(scenes, common), "200 2D-2D and 200 2D-3D matches; SIMPLE_RADIAL lenses"},
              "scene,k1,point_noise_percent,outlier_percent," + kColumns);
  ProgressBar progress(48, !common.quiet);
  for (const bool isBox : {false, true})
    for (const double k1 : {0., -0.05, -0.2})
      for (const double pointNoise : {0., 1.})
        for (const double outliers : {0., 0.3, 0.5, 0.7}) {
          WideSceneOptions scene = sceneOf(200, outliers, pointNoise);
          scene.isBox = isBox;
          scene.lens = hybridgv::test::simpleRadialLens(k1);
          writeRows(csv, text(isBox ? "box" : "wide", ',', k1, ',', pointNoise, ',', 100 * outliers),
                    attemptScenes(scene, scenes, common, false));
          progress.step();
        }
}

void writeStrengths(int scenes, const CommonOptions& common) {
  CsvFile csv(
      common.output, "distortion_strength.csv",
      {remark(scenes, common), "wide scenes, 200 2D-2D and 200 2D-3D matches, 30 % outliers",
       "distortion: k1 of SIMPLE_RADIAL, or that of the division model times the square of half the image's diagonal; the focal "
       "length is that of the same model"},
      "lens,distortion," + kColumns);
  const double unit = 1 / (2 * hybridgv::test::kWideHalfSize * hybridgv::test::kWideHalfSize);
  ProgressBar progress(14, !common.quiet);
  for (const bool isDivision : {false, true})
    for (const double distortion : {-0.3, -0.2, -0.1, -0.05, -0.02, 0., 0.05}) {
      WideSceneOptions scene = sceneOf(200, 0.3, 0);
      scene.lens = isDivision ? hybridgv::test::divisionLens(distortion * unit) : hybridgv::test::simpleRadialLens(distortion);
      writeRows(csv, text(isDivision ? "division" : "SIMPLE_RADIAL", ',', distortion),
                attemptScenes(scene, scenes, common, isDivision));
      progress.step();
    }
}

// What is estimated in vain.
void writePrice(int scenes, const CommonOptions& common) {
  struct Cell {
    bool isBox;
    int matches;
    double outliers, pointNoise;
  };
  CsvFile csv(
      common.output, "distortion_price.csv",
      {remark(scenes, common), "no distortion: errors of the focal length relative to those of the pinhole camera"},
      "scene,matches_of_each_kind,outlier_percent,point_noise_percent,camera,median_ratio,mean_square_ratio,kept_percent");
  const std::vector<Cell> cells{
      {false, 100, 0.3, 0}, {false, 100, 0.3, 1}, {false, 30, 0, 1}, {false, 12, 0, 0}, {true, 60, 0.3, 1}};
  ProgressBar progress(cells.size(), !common.quiet);
  for (const Cell& cell : cells) {
    WideSceneOptions scene = sceneOf(cell.matches, cell.outliers, cell.pointNoise);
    scene.isBox = cell.isBox;
    const Attempts attempts = attemptScenes(scene, scenes, common, false);
    const auto errors = [&](std::size_t camera) {
      return valuesOf(attempts[camera], [](const Attempt& a) { return a.error.focalPercent; });
    };
    const auto meanSquare = [&](std::size_t camera) {
      double sum = 0;
      for (std::size_t i = 0; i < attempts[camera].size(); ++i) {
        const bool isFinite = std::all_of(attempts.begin(), attempts.end(), [&](const auto& of) { return of[i].isRight; });
        if (isFinite) sum += attempts[camera][i].error.focalPercent * attempts[camera][i].error.focalPercent;
      }
      return sum;
    };
    for (std::size_t camera = 1; camera < kCameras.size(); ++camera)
      csv.row(cell.isBox ? "box" : "wide", cell.matches, 100 * cell.outliers, cell.pointNoise, kCameras[camera],
              median(errors(camera)) / median(errors(0)), std::sqrt(meanSquare(camera) / meanSquare(0)),
              percentOf(attempts[camera], &Attempt::isKept));
    progress.step();
  }
}

// Every image of a map, left out of it, with its own lens and nothing of its calibration.
void writeMaps(const std::vector<std::string>& maps, int repetitions, const CommonOptions& common) {
  CsvFile csv(common.output, "distortion_maps.csv",
              {remark(repetitions, common), "scenes: sets of wrong matches; position in units of the map"},
              "map,outlier_percent," + kColumns);
  for (const std::string& path : maps) {
    const SparseModel map = hybridgv::sfm::readModel(path);
    for (const double outliers : {0., 0.3, 0.5}) {
      Attempts attempts;
      for (std::size_t image = 0; image < map.images.size(); ++image) {
        if (!map.images[image].registered) continue;
        hybridgv::sfm::LocalizationProblemOptions keep;
        keep.undistortQuery = false;
        const LocalizationProblem clean = makeLocalizationProblem(map, image, keep);
        for (int i = 0; i < repetitions; ++i) {
          const std::uint64_t seed = common.seed + static_cast<std::uint64_t>(i);
          const LocalizationProblem problem = injectOutliers(clean, outliers, seed);
          for (std::size_t camera = 0; camera < kCameras.size(); ++camera) {
            HybridRansacOptions options = optionsOf(camera, seed);
            options.imageRadiusPx = ransacOptions(problem).imageRadiusPx;
            attempts[camera].push_back(attempt(problem.adapter, options, *problem.reference, false));
          }
        }
      }
      writeRows(csv, text(sceneName(path), ',', 100 * outliers), attempts);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Query images with unknown lens distortion: ignored, estimated, and estimated where the data speak for it."};
  CommonOptions options;
  std::vector<std::string> maps;
  int scenes = 60;
  addCommonOptions(app, options, "threads that share the scenes (each is localized by one)");
  app.add_option("map", maps, "COLMAP folder, Bundler .out or NVM file: its images are localized with their own lenses");
  app.add_option("--scenes", scenes, "scenes for each row (--quick: 4)")->check(CLI::Range(1, 100000))->capture_default_str();
  return runExperiment(app, argc, argv, [&] {
    if (options.quick) scenes = 4;
    writeScenes(scenes, options);
    writeStrengths(scenes, options);
    writePrice(4 * scenes, options);
    if (!maps.empty()) writeMaps(maps, std::min(scenes, 20), options);
  });
}

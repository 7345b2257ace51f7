// The same scenes through OpenGV's absolute pose and through HybridGV: what an unknown focal length costs, and what 2D-2D matches
// buy. OpenGV's solvers need the focal length; they get the true one, a guess (1.2 x the larger image side), or HybridGV's
// estimate.
//
// Writes opengv_solvers.csv (matches without outliers) and opengv_loops.csv (RANSAC with outliers).
#include <hybridgv/absolute_pose/methods.hpp>
#include <hybridgv/hybrid_pose/methods.hpp>
#include <hybridgv/sac/HybridRansac.hpp>
#include <hybridgv/sac_problems/hybrid_pose/HybridPoseSacProblem.hpp>

#include <algorithm>
#include <iterator>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/absolute_pose/AbsolutePoseSacProblem.hpp>
#include <optional>

#include "../common/CsvFile.hpp"
#include "../common/Options.hpp"
#include "ErrorTable.hpp"
#include "HybridScene.hpp"
#include "common/PoseError.hpp"
#include "common/ProgressBar.hpp"

namespace {

using hybridgv::FocalPose;
using hybridgv::FocalPoses;
using hybridgv::NoncentralHybridAdapter;
using hybridgv::Solver;
using hybridgv::test::HybridScene;
using opengv::absolute_pose::CentralAbsoluteAdapter;
using HybridProblem = hybridgv::sac_problems::hybrid_pose::HybridPoseSacProblem;
using AbsoluteProblem = opengv::sac_problems::absolute_pose::AbsolutePoseSacProblem;

constexpr double kImageSide = 1000, kMaxReprojectionErrorPx = 15, kMaxEpipolarErrorPx = 6;
constexpr double kProbability = 0.9999;
constexpr int kMaxIterations = 1000;

struct Settings {
  CommonOptions options;
  int solverScenes = 1000, loopScenes = 100;
  double imageNoisePx = 2, pointNoise = 0.1;
};

HybridScene makeScene(const Settings& settings, std::uint64_t index, double outlierShare) {
  hybridgv::test::SceneOptions options;
  options.rays = options.points = 200;
  options.imageNoise = settings.imageNoisePx;
  options.pointNoise = settings.pointNoise;
  options.outlierShareRays = options.outlierSharePoints = outlierShare;
  hybridgv::test::Random random(settings.options.seed, index);
  return makeHybridScene(random, options);
}

hybridgv::sac::HybridRansacResult estimate(const Settings& settings, const NoncentralHybridAdapter& adapter,
                                           std::optional<double> focalLength = {}) {
  hybridgv::sac::HybridRansacOptions options;
  options.maxReprojectionErrorPx = kMaxReprojectionErrorPx;
  options.maxEpipolarErrorPx = kMaxEpipolarErrorPx;
  options.successProbability = kProbability;
  options.maxIterations = kMaxIterations;
  options.knownFocalLengthPx = focalLength;
  options.seed = settings.options.seed;
  options.threads = settings.options.threads;
  return hybridRansac(adapter, options);
}

// The query's 2D-3D matches as OpenGV wants them, for an assumed focal length. Not to be moved: OpenGV's adapter keeps
// references to its members.
struct CalibratedQuery {
  CalibratedQuery(const HybridScene& scene, double assumedFocalLength)
      : focalLength(assumedFocalLength), points(scene.points.begin(), scene.points.end()) {
    for (const Eigen::Vector3d& image : scene.image2d3d)
      bearings.push_back(Eigen::Vector3d(image[0], image[1], focalLength).normalized());
  }
  CalibratedQuery(const CalibratedQuery&) = delete;
  CalibratedQuery& operator=(const CalibratedQuery&) = delete;

  FocalPose pose(const opengv::transformation_t& transformation) const {
    return {transformation.leftCols<3>(), transformation.col(3), focalLength};
  }
  FocalPoses poses(const opengv::transformations_t& transformations) const {
    FocalPoses result;
    for (const opengv::transformation_t& transformation : transformations) result.push_back(pose(transformation));
    return result;
  }

  double focalLength;
  opengv::bearingVectors_t bearings;
  opengv::points_t points;
  CentralAbsoluteAdapter adapter{bearings, points};
};

bool needsFocalLength(Solver solver) {
  constexpr Solver those[] = {Solver::P3P, Solver::H22, Solver::H41, Solver::H60};
  return std::find(std::begin(those), std::end(those), solver) != std::end(those);
}

struct Assumption {
  const char* name;
  double focalLength;
};

std::vector<Assumption> assumptions(const HybridScene& scene, const hybridgv::sac::HybridRansacResult& estimated) {
  return {{"true", scene.truth.focalLength}, {"guess", 1.2 * kImageSide}, {"estimated", estimated.pose.focalLength}};
}

// ------------------------------------------------------------------------------------------------------------ solvers

void compareSolvers(const Settings& settings, const HybridScene& scene, ErrorTable& table) {
  const std::vector<int> three{0, 1, 2}, four{0, 1, 2, 3};
  const NoncentralHybridAdapter adapter = scene.adapter();
  const hybridgv::sac::HybridRansacResult estimated = estimate(settings, adapter);
  for (const Assumption& assumed : assumptions(scene, estimated)) {
    const CalibratedQuery query(scene, assumed.focalLength);
    const auto add = [&](const char* name, int matches, const auto& solve) {
      table.add({"OpenGV", name, assumed.name, std::to_string(matches)}, scene.truth, [&] { return query.poses(solve()); });
    };
    const double f = assumed.focalLength;
    const auto addOurs = [&](const char* name, int matches, const auto& solve) {
      table.add({"HybridGV", name, assumed.name, std::to_string(matches)}, scene.truth, solve);
    };
    addOurs("p3p", 3, [&] { return hybridgv::absolute_pose::p3p(adapter, f); });
    addOurs("h22", 4, [&] { return hybridgv::hybrid_pose::h22(adapter, f, {{0, 1}, {0, 1}}); });
    addOurs("h41", 5, [&] { return hybridgv::hybrid_pose::h41(adapter, f, {{0, 5, 10, 15}, {0}}); });
    addOurs("h60", 6, [&] { return hybridgv::hybrid_pose::h60(adapter, f, {{0, 5, 10, 15, 20, 1}, {}}); });
    addOurs("hybridRansac", 400, [&] { return FocalPoses{estimate(settings, adapter, f).pose}; });
    using namespace opengv::absolute_pose;
    add("p3p_kneip", 3, [&] { return p3p_kneip(query.adapter, three); });
    add("p3p_gao", 3, [&] { return p3p_gao(query.adapter, three); });
    add("gp3p", 3, [&] { return gp3p(query.adapter, three); });
    add("epnp", 200, [&] { return opengv::transformations_t{epnp(query.adapter)}; });
    add("upnp", 200, [&] { return upnp(query.adapter); });
  }
  const auto add = [&](const char* name, int matches, const auto& solve) {
    table.add({"HybridGV", name, "unknown", std::to_string(matches)}, scene.truth, solve);
  };
  // Rays 0, 5, 10 .. come from rig camera 0.
  add("p4pf", 4, [&] { return hybridgv::absolute_pose::p4pf(adapter, four); });
  add("p35pf", 4, [&] { return hybridgv::absolute_pose::p35pf(adapter, four); });
  add("h13f", 4, [&] { return hybridgv::hybrid_pose::h13f(adapter, {{0}, three}); });
  add("h32f", 5, [&] { return hybridgv::hybrid_pose::h32f(adapter, {{0, 1, 2}, {0, 1}}); });
  add("h51f[1]", 6, [&] { return hybridgv::hybrid_pose::h51f(adapter, {{0, 1, 2, 3, 4}, {0}}); });
  add("h51f[5]", 6, [&] { return hybridgv::hybrid_pose::h51f(adapter, {{0, 5, 10, 15, 20}, {0}}); });
  add("hybridRansac", 400, [&] { return FocalPoses{estimate(settings, adapter).pose}; });
}

// ------------------------------------------------------------------------------------------------------------ loops

// Runs OpenGV's Ransac on a problem, then its nonlinear refinement over the inliers.
template <class Problem, class Convert>
FocalPoses runLoop(const std::shared_ptr<Problem>& problem, double threshold, const Convert& convert, int& iterations) {
  opengv::sac::Ransac<Problem> ransac(kMaxIterations, threshold, kProbability);
  ransac.sac_model_ = problem;
  const bool found = ransac.computeModel();
  iterations = ransac.iterations_;
  if (!found || ransac.inliers_.size() < 4) return {};
  auto refined = ransac.model_coefficients_;
  problem->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
  return {convert(refined)};
}

void compareLoops(const Settings& settings, double outlierShare, const HybridScene& scene, ErrorTable& table) {
  const std::string outliers = std::to_string(static_cast<int>(std::lround(100 * outlierShare)));
  const NoncentralHybridAdapter adapter = scene.adapter();
  const hybridgv::sac::HybridRansacResult estimated = estimate(settings, adapter);
  int iterations = 0;
  for (const Assumption& assumed : assumptions(scene, estimated)) {
    CalibratedQuery query(scene, assumed.focalLength);
    // OpenGV's distance is 1 - cos(angle between the bearing vectors).
    const double threshold = 1 - std::cos(std::atan(kMaxReprojectionErrorPx / assumed.focalLength));
    const auto add = [&](const char* name, AbsoluteProblem::Algorithm algorithm) {
      const auto solve = [&] {
        const auto problem = std::make_shared<AbsoluteProblem>(query.adapter, algorithm, /*randomSeed=*/false);
        return runLoop(
            problem, threshold, [&](const opengv::transformation_t& t) { return query.pose(t); }, iterations);
      };
      table.add({"opengv::sac::Ransac", name, assumed.name, outliers}, scene.truth, solve, &iterations);
    };
    add("KNEIP", AbsoluteProblem::KNEIP);
    add("GAO", AbsoluteProblem::GAO);
    add("GP3P", AbsoluteProblem::GP3P);
    add("EPNP", AbsoluteProblem::EPNP);
  }
  const auto addOurs = [&](Solver solver, const char* assumption, std::optional<double> focalLength) {
    const auto solve = [&] {
      const auto problem = std::make_shared<HybridProblem>(adapter, solver, kMaxReprojectionErrorPx, kMaxEpipolarErrorPx,
                                                           settings.options.seed, focalLength);
      return runLoop(
          problem, 1.0, [](const FocalPose& pose) { return pose; }, iterations);
    };
    table.add({"opengv::sac::Ransac", toString(solver), assumption, outliers}, scene.truth, solve, &iterations);
  };
  for (const Solver solver : hybridgv::allSolvers()) {
    if (!needsFocalLength(solver)) addOurs(solver, "unknown", {});
    if (needsFocalLength(solver))
      for (const Assumption& assumed : assumptions(scene, estimated)) addOurs(solver, assumed.name, assumed.focalLength);
  }
  const auto addHybrid = [&](const char* assumption, std::optional<double> focalLength) {
    const auto solve = [&] {
      const hybridgv::sac::HybridRansacResult result = estimate(settings, adapter, focalLength);
      iterations = result.iterations;
      return result.success ? FocalPoses{result.pose} : FocalPoses{};
    };
    table.add({"HybridGV", "hybridRansac", assumption, outliers}, scene.truth, solve, &iterations);
  };
  addHybrid("unknown", {});
  for (const Assumption& assumed : assumptions(scene, estimated)) addHybrid(assumed.name, assumed.focalLength);
}

void run(const Settings& settings) {
  const std::vector<double> outlierShares{0, 0.3, 0.5};
  ProgressBar progress(
      static_cast<std::size_t>(settings.solverScenes) + outlierShares.size() * static_cast<std::size_t>(settings.loopScenes),
      !settings.options.quiet);
  const std::string scenes =
      text(" scenes, seed ", settings.options.seed, "; 200 2D-2D and 200 2D-3D matches, image noise ", settings.imageNoisePx,
           " px, noise of the 3D points ", settings.pointNoise, " (", 5 * settings.pointNoise, " % of the mean depth)");
  ErrorTable solvers, loops;
  for (int i = 0; i < settings.solverScenes; ++i, progress.step())
    compareSolvers(settings, makeScene(settings, static_cast<std::uint64_t>(i), 0), solvers);
  solvers.write(settings.options.output, "opengv_solvers.csv",
                text(settings.solverScenes, scenes) +
                    ", no outliers; of several solutions the nearest to the truth; no solution counts as an infinite error",
                "library,method,focal_length,matches");
  for (const double share : outlierShares)
    for (int i = 0; i < settings.loopScenes; ++i, progress.step())
      compareLoops(settings, share, makeScene(settings, static_cast<std::uint64_t>(i), share), loops);
  loops.write(settings.options.output, "opengv_loops.csv",
              text(settings.loopScenes, scenes) + text("; every loop: probability ", kProbability, ", at most ", kMaxIterations,
                                                       " iterations, ", kMaxReprojectionErrorPx, " px (2D-3D) and ",
                                                       kMaxEpipolarErrorPx, " px (2D-2D), nonlinear refinement"),
              "loop,method,focal_length,outliers_percent");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "OpenGV's absolute pose with a true, guessed or estimated focal length beside HybridGV, as solvers and in RANSAC."};
  Settings settings;
  addCommonOptions(app, settings.options, "threads of hybridRansac (all else runs on one, OpenGV's EPnP is not made for more)");
  return runExperiment(app, argc, argv, [&] {
    if (settings.options.quick) {
      settings.solverScenes = 20;
      settings.loopScenes = 3;
    }
    run(settings);
  });
}

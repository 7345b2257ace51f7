// Where OpenGV's gp3p remains the right tool: the query is itself a rig of calibrated cameras (generalized absolute pose).
// HybridGV knows no such query; it can take one camera of it only, but does not need that camera's focal length.
//
// Writes rig_query.csv.
#include <opengv/absolute_pose/NoncentralAbsoluteAdapter.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/absolute_pose/AbsolutePoseSacProblem.hpp>

#include "../common/CsvFile.hpp"
#include "../common/Options.hpp"
#include "ErrorTable.hpp"
#include "HybridScene.hpp"
#include "common/ProgressBar.hpp"
#include "estimate.hpp"

namespace {

using hybridgv::FocalPose;
using hybridgv::FocalPoses;
using AbsoluteProblem = opengv::sac_problems::absolute_pose::AbsolutePoseSacProblem;

constexpr double kMaxReprojectionErrorPx = 15, kProbability = 0.9999, kQueryFocalLength = 1000;
constexpr double kImageNoisePx = 2, kPointNoise = 0.1, kOutlierShare = 0.3;
constexpr int kQueryCameras = 3;

// 2D-3D matches of all the query's cameras (match i belongs to camera i mod 3), and separate ones of both kinds of the first.
struct RigScene {
  FocalPose body;                  // the query rig's frame, which is the frame of its first camera
  std::vector<FocalPose> query;    // its cameras in the world
  opengv::translations_t offsets;  // ... and in the body's frame
  opengv::rotations_t rotations;
  std::vector<int> cameras;
  opengv::bearingVectors_t bearings;
  opengv::points_t points;
  hybridgv::test::HybridScene firstCamera;
};

RigScene makeRigScene(hybridgv::test::Random random, int matchesPerCamera) {
  using namespace hybridgv::test;
  RigScene scene;
  SceneOptions options;
  options.rays = options.points = matchesPerCamera;
  options.imageNoise = kImageNoisePx;
  options.pointNoise = kPointNoise;
  options.outlierShareRays = options.outlierSharePoints = kOutlierShare;
  scene.firstCamera = makeHybridScene(random, options);
  scene.body = scene.firstCamera.truth;
  scene.body.focalLength = kQueryFocalLength;

  // The other cameras stand up to 1 from the first one (the scene is at 15 .. 25) and look at the origin as well.
  for (int k = 0; k < kQueryCameras; ++k) {
    FocalPose camera = scene.body;
    if (k > 0) {
      camera.position += random.vector(-1, 1);
      camera.rotation =
          Eigen::Quaterniond::FromTwoVectors(scene.body.position, camera.position).toRotationMatrix() * scene.body.rotation;
    }
    scene.query.push_back(camera);
    scene.offsets.push_back(toCamera(scene.body, camera.position));
    scene.rotations.push_back(scene.body.rotation.transpose() * camera.rotation);
  }
  for (int i = 0; i < kQueryCameras * matchesPerCamera; ++i) {
    const FocalPose& camera = scene.query[static_cast<std::size_t>(i % kQueryCameras)];
    Eigen::Vector3d point = random.vector(-5, 5);
    while (!isVisible(camera, point)) point = random.vector(-5, 5);
    const bool inlier = random.uniform() >= kOutlierShare;
    const Eigen::Vector3d image =
        inlier ? noisyImagePoint(random, project(camera, point), kImageNoisePx) : randomImagePoint(random);
    const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
    scene.cameras.push_back(i % kQueryCameras);
    scene.bearings.push_back(Eigen::Vector3d(image[0], image[1], kQueryFocalLength).normalized());
    scene.points.push_back(point + kPointNoise * error);
  }
  return scene;
}

FocalPoses gp3pLoop(RigScene& scene, int& iterations) {
  opengv::absolute_pose::NoncentralAbsoluteAdapter adapter(scene.bearings, scene.cameras, scene.points, scene.offsets,
                                                           scene.rotations);
  opengv::sac::Ransac<AbsoluteProblem> ransac(1000, 1 - std::cos(std::atan(kMaxReprojectionErrorPx / kQueryFocalLength)),
                                              kProbability);
  ransac.sac_model_ = std::make_shared<AbsoluteProblem>(adapter, AbsoluteProblem::GP3P, /*randomSeed=*/false);
  const bool found = ransac.computeModel();
  iterations = ransac.iterations_;
  if (!found) return {};
  opengv::transformation_t refined;
  ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
  return {FocalPose{refined.leftCols<3>(), refined.col(3), kQueryFocalLength}};
}

// On the first camera of the query alone, with or without 2D-2D matches.
FocalPoses hybridLoop(const RigScene& scene, bool useRays, const CommonOptions& common, int& iterations) {
  hybridgv::test::HybridScene camera = scene.firstCamera;
  if (!useRays) camera.removeRays();
  hybridgv::sac::HybridRansacOptions options;
  options.maxReprojectionErrorPx = kMaxReprojectionErrorPx;
  options.successProbability = kProbability;
  options.seed = common.seed;
  options.threads = common.threads;
  return estimate(camera.adapter(), options, &iterations);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"A query rig of three calibrated cameras: OpenGV's gp3p on all of it beside HybridGV on its first camera."};
  CommonOptions options;
  int scenes = 300;
  addCommonOptions(app, options, "threads of hybridRansac");
  return runExperiment(app, argc, argv, [&] {
    if (options.quick) scenes = 5;
    const std::vector<int> matchesPerCamera{5, 10, 20, 60};
    ProgressBar progress(matchesPerCamera.size() * static_cast<std::size_t>(scenes), !options.quiet);
    ErrorTable table;
    for (const int matches : matchesPerCamera)
      for (int i = 0; i < scenes; ++i, progress.step()) {
        RigScene scene = makeRigScene(hybridgv::test::Random(options.seed, static_cast<std::uint64_t>(i)), matches);
        const std::string count = std::to_string(matches);
        int iterations = 0;
        table.add(
            {"gp3p in OpenGV's Ransac", "3", "known", "2D-3D", count}, scene.body, [&] { return gp3pLoop(scene, iterations); },
            &iterations);
        for (const bool useRays : {false, true})
          table.add(
              {"hybridRansac", "1", "unknown", useRays ? "2D-3D and 2D-2D" : "2D-3D", count}, scene.firstCamera.truth,
              [&] { return hybridLoop(scene, useRays, options, iterations); }, &iterations);
      }
    table.write(options.output, "rig_query.csv",
                text(scenes, " scenes, seed ", options.seed, "; image noise ", kImageNoisePx, " px, noise of the 3D points ",
                     kPointNoise, " (", 5 * kPointNoise, " % of the mean depth), ", 100 * kOutlierShare,
                     " % outliers; a failure counts as an infinite error"),
                "method,query_cameras,focal_length,matches,matches_of_each_type_per_camera");
  });
}

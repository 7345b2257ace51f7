// Wrong calls of the functions for sparse models. Files that are malformed are tested in adapters/sfm_MalformedFiles_test.cpp.
#include "Misuse.hpp"
#include "SfmScene.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace test {
namespace {

using sfm::CameraModel;
using sfm::SparseModel;

std::vector<CameraModel> allModels() {
  std::vector<CameraModel> models = colmapModels();
  models.push_back(CameraModel::NvmRadial);
  return models;
}

void expectCameraRefused(const std::string& wrong, const sfm::Camera& camera) {
  expectRefused(wrong, "camera", [&] { sfm::focalLength(camera); });
  expectRefused(wrong, "camera", [&] { sfm::undistort(camera, 1, 2); });
  expectRefused(wrong, "camera", [&] { sfm::bearingVector(camera, 1, 2); });
  expectRefused(wrong, "camera", [&] { sfm::project(camera, {1, 2, 1}); });
  expectRefused(wrong, "camera", [&] { sfm::distort(camera, {1, 2, 1}); });
}

TEST(Misuse, WrongCamerasAreRefused) {
  for (const CameraModel model : allModels()) {
    const sfm::Camera good = makeCamera(model);
    const std::string name = sfm::toString(model);
    for (const std::size_t count : {std::size_t{0}, good.parameters.size() - 1, good.parameters.size() + 1}) {
      sfm::Camera camera = good;
      camera.parameters.resize(count, 1);
      expectCameraRefused(name + " with " + std::to_string(count) + " parameters", camera);
    }
    for (std::size_t i = 0; i < good.parameters.size(); ++i)
      for (const double value : notFinite()) {
        sfm::Camera camera = good;
        camera.parameters[i] = value;
        expectCameraRefused(name + ", parameter " + std::to_string(i) + " = " + std::to_string(value), camera);
      }
    for (const double value : {0.0, -700.0}) {
      sfm::Camera camera = good;
      camera.parameters[0] = value;
      expectCameraRefused(name + ", focal length " + std::to_string(value), camera);
    }
    for (const double value : notFinite()) {
      expectRefused(name, "(x, y)", [&] { sfm::bearingVector(good, value, 0); });
      expectRefused(name, "point", [&] { sfm::project(good, {1, value, 1}); });
      if (!sfm::hasImagePlane(model)) continue;
      expectRefused(name, "(x, y)", [&] { sfm::undistort(good, value, 0); });
      expectRefused(name, "(x, y)", [&] { sfm::undistort(good, 0, value); });
      for (int k = 0; k < 3; ++k) {
        Eigen::Vector3d point(1, 2, 1);
        point[k] = value;
        expectRefused(name, "imagePoint", [&] { sfm::distort(good, point); });
      }
    }
    expectRefused(name, sfm::hasImagePlane(model) ? "imagePoint" : "camera", [&] { sfm::distort(good, {1, 2, 0}); });
  }
  for (const int value : {-1, 18, 999, 1002}) {
    sfm::Camera camera = makeCamera(CameraModel::Radial);
    camera.model = static_cast<CameraModel>(value);
    expectCameraRefused("model " + std::to_string(value), camera);
    expectRefused("model " + std::to_string(value), "model", [&] { sfm::toString(static_cast<CameraModel>(value)); });
  }
}

SparseModel goodModel() {
  Random random(testSeed() + 810);
  return makeScene(random, 4, 30, 0.8, {CameraModel::Pinhole, CameraModel::Radial});
}

// A wrong model, and the name that the message must contain.
struct WrongModel {
  std::string name;
  std::function<void(SparseModel&)> change;
  std::string argument;
};

std::vector<WrongModel> wrongModels() {
  constexpr std::size_t kNone = 1000;
  std::vector<WrongModel> models{
      {"camera index", [](SparseModel& m) { m.images[1].camera = kNone; }, "model.images[1]"},
      {"observation of no point", [](SparseModel& m) { m.images[2].observations[0].point = kNone; }, "model.images[2]"},
      {"track with no image",
       [](SparseModel& m) {
         m.points[3].track.push_back({kNone, 0});
       },
       "model.points[3]"},
      {"track with no observation",
       [](SparseModel& m) {
         m.points[3].track.push_back({0, kNone});
       },
       "model.points[3]"},
      {"camera without parameters", [](SparseModel& m) { m.cameras[1].parameters.clear(); }, "camera"},
  };
  for (const double value : notFinite()) {
    const std::string text = " = " + std::to_string(value);
    models.push_back({"observation x" + text, [=](SparseModel& m) { m.images[1].observations[0].x = value; }, "model.images[1]"});
    models.push_back({"observation y" + text, [=](SparseModel& m) { m.images[1].observations[0].y = value; }, "model.images[1]"});
    models.push_back({"error" + text, [=](SparseModel& m) { m.points[0].error = value; }, "model.points[0]"});
    models.push_back({"parameter" + text, [=](SparseModel& m) { m.cameras[0].parameters[1] = value; }, "camera"});
    for (int k = 0; k < 3; ++k) {
      models.push_back({"position" + text, [=](SparseModel& m) { m.images[1].position[k] = value; }, "model.images[1]"});
      models.push_back({"point" + text, [=](SparseModel& m) { m.points[2].position[k] = value; }, "model.points[2]"});
      for (int j = 0; j < 3; ++j)
        models.push_back({"rotation" + text, [=](SparseModel& m) { m.images[1].rotation(j, k) = value; }, "model.images[1]"});
    }
  }
  return models;
}

TEST(Misuse, WritersRefuseWrongModelsAndWriteNothing) {
  const SparseModel good = goodModel();
  std::vector<WrongModel> models = wrongModels();
  models.push_back({"equal camera ids", [](SparseModel& m) { m.cameras[1].id = m.cameras[0].id; }, "model.cameras[1]"});
  models.push_back({"equal image ids", [](SparseModel& m) { m.images[1].id = m.images[0].id; }, "model.images[1]"});
  models.push_back({"equal point ids", [](SparseModel& m) { m.points[1].id = m.points[0].id; }, "model.points[1]"});
  models.push_back({"image without a name", [](SparseModel& m) { m.images[0].name.clear(); }, "model.images[0]"});
  models.push_back({"line break", [](SparseModel& m) { m.images[0].name = "a\nb"; }, "model.images[0]"});
  for (const WrongModel& wrong : models) {
    SparseModel model = good;
    wrong.change(model);
    const TemporaryFolder folder;
    expectRefused(wrong.name + ", text", wrong.argument, [&] { sfm::writeColmapText(folder.path(), model); });
    expectRefused(wrong.name + ", binary", wrong.argument, [&] { sfm::writeColmapBinary(folder.path(), model); });
    EXPECT_THROW(sfm::readModel(folder.path()), sfm::FileError) << wrong.name;
  }
}

TEST(Misuse, LocalizationProblemsRefuseWrongArguments) {
  const SparseModel good = goodModel();
  for (const std::size_t index : {good.images.size(), static_cast<std::size_t>(-1)})
    expectRefused(std::to_string(index), "imageIndex", [&] { sfm::makeLocalizationProblem(good, index); });
  SparseModel unregistered = good;
  unregistered.images[0].registered = false;
  expectRefused("not registered", "imageIndex", [&] { sfm::makeLocalizationProblem(unregistered, 0); });
  for (const double value : {kNaN, kInfinite, -kInfinite, -1.0}) {
    sfm::LocalizationProblemOptions options;
    options.minParallaxDeg = value;
    expectRefused(std::to_string(value), "minParallaxDeg", [&] { sfm::makeLocalizationProblem(good, 0, options); });
    options = {};
    options.maxMapReprojectionErrorPx = value;
    expectRefused(std::to_string(value), "maxMapReprojectionErrorPx", [&] { sfm::makeLocalizationProblem(good, 0, options); });
  }
  for (const WrongModel& wrong : wrongModels()) {
    if (wrong.name.find("point") == 0 || wrong.name.find("error") == 0) continue;  // points are triangulated anew
    SparseModel model = good;
    wrong.change(model);
    int refused = 0;  // where the wrong part is needed
    for (std::size_t image = 0; image < 4; ++image) {
      try {
        sfm::makeLocalizationProblem(model, image);
      } catch (const std::invalid_argument& error) {
        ++refused;
        EXPECT_NE(std::string(error.what()).find(wrong.argument), std::string::npos) << wrong.name << ": " << error.what();
      }
    }
    EXPECT_GT(refused, 0) << wrong.name;
  }
}

TEST(Misuse, SharesOfOutliersOutside0To1AreRefused) {
  const sfm::LocalizationProblem problem = sfm::makeLocalizationProblem(goodModel(), 0);
  for (const double share : {kNaN, kInfinite, -kInfinite, -0.1, 1.1})
    expectRefused(std::to_string(share), "share", [&] { sfm::injectOutliers(problem, share, 1); });
}

TEST(Misuse, FilesThatAreNotThereAreNamed) {
  const std::string path = "/nonexistent/model";
  const std::vector<std::function<void()>> calls{[&] { sfm::readModel(path); },
                                                 [&] { sfm::readColmapText(path); },
                                                 [&] { sfm::readColmapBinary(path); },
                                                 [&] { sfm::readBundler(path); },
                                                 [&] { sfm::readNvm(path); },
                                                 [&] { sfm::readProblem(path); },
                                                 [&] { sfm::writeColmapText(path, goodModel()); },
                                                 [&] { sfm::writeColmapBinary(path, goodModel()); },
                                                 [&] { sfm::writeProblem(path, sfm::makeLocalizationProblem(goodModel(), 0)); }};
  for (std::size_t i = 0; i < calls.size(); ++i) try {
      calls[i]();
      ADD_FAILURE() << i << ": accepted";
    } catch (const sfm::FileError& error) {
      EXPECT_EQ(error.file().find(path), 0u) << i << ": " << error.file();
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << i << ": " << error.what();
    }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

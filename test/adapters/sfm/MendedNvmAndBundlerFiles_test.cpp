// VisualSFM's and Bundler's files as other programs and scripts leave them.
#include "DamagedMaps.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Eigen::Vector3d;

struct NvmStyle {
  bool hasMatrices = false;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  std::string nameSpace = "\"";
};

// The model as an NVM file; its cameras must be NvmRadial.
std::string nvmText(const SparseModel& model, const NvmStyle& style = {}) {
  std::string text =
      std::string(style.hasMatrices ? "NVM_V3_R9T" : "NVM_V3") + "\n\n" + std::to_string(model.images.size()) + "\n";
  for (const Image& image : model.images) {
    const Camera& camera = model.cameras[image.camera];
    text += replacedAll(image.name, " ", style.nameSpace) + " " + numberText(camera.parameters[0]);
    const Eigen::Matrix3d rotation = image.rotation.transpose();
    const Eigen::Quaterniond q(rotation);
    const Vector3d t = -(rotation * image.position);
    std::vector<double> numbers{q.w(), q.x(), q.y(), q.z(), image.position[0], image.position[1], image.position[2]};
    if (style.hasMatrices) {
      numbers.clear();
      for (int i = 0; i < 9; ++i) numbers.push_back(rotation(i / 3, i % 3));
      for (const double value : t) numbers.push_back(value);
    }
    numbers.push_back(camera.parameters[4]);
    numbers.push_back(0);
    for (const double value : numbers) text += " " + numberText(value);
    text += "\n";
  }
  text += "\n" + std::to_string(model.points.size()) + "\n";
  for (const Point& point : model.points) {
    for (const double value : point.position) text += numberText(value) + " ";
    text += "1 2 3 " + std::to_string(point.track.size());
    for (const TrackElement& e : point.track) {
      const Observation& o = model.images[e.image].observations[e.observation];
      text += " " + std::to_string(e.image) + " " + std::to_string(e.observation) + " " + numberText(o.x + style.origin[0]) +
              " " + numberText(o.y + style.origin[1]);
    }
    text += "\n";
  }
  return text + "\n0\n";
}

SparseModel nvmScene() {
  test::Random random(test::testSeed(), 42);
  SparseModel model = test::makeScene(random, 5, 40, 1, std::vector<CameraModel>(5, CameraModel::NvmRadial));
  for (std::size_t i = 0; i < 5; ++i) {
    model.cameras[i].parameters = {700 + 10.0 * static_cast<double>(i), 700 + 10.0 * static_cast<double>(i), 0, 0, 0.02};
    for (Observation& o : model.images[i].observations)
      if (o.point != Observation::kNoPoint) {
        const Image& image = model.images[i];
        const Vector3d x = image.rotation.transpose() * (model.points[o.point].position - image.position);
        const Vector3d pixel = project(model.cameras[i], x).value();
        o.x = pixel[0];
        o.y = pixel[1];
      }
  }
  return model;
}

TEST(MendedNvmFiles, MayHaveMatricesInsteadOfQuaternions) {
  const TemporaryFolder folder;
  const SparseModel original = nvmScene();
  const SparseModel model = expectMends(folder.write("model.nvm", nvmText(original, {true})), {});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT((model.images[i].rotation - original.images[i].rotation).norm(), 1e-14);
    EXPECT_LT((model.images[i].position - original.images[i].position).norm(), 1e-13);
    EXPECT_EQ(model.images[i].name, original.images[i].name);
  }
}

TEST(MendedNvmFiles, NamesMayHaveSpaces) {
  const TemporaryFolder folder;
  for (const bool hasMatrices : {false, true}) {
    const SparseModel model = expectMends(
        folder.write("model.nvm", nvmText(nvmScene(), {hasMatrices, Eigen::Vector2d::Zero(), " "})), {{Mend::NameWithSpaces, 5}});
    EXPECT_EQ(model.images[3].name, "photo 3.jpg");
  }
}

TEST(MendedNvmFiles, PositionsMayCountFromTheCornerOfTheImage) {
  const TemporaryFolder folder;
  const SparseModel original = nvmScene();
  for (const Eigen::Vector2d& origin : {Eigen::Vector2d(800, 600), Eigen::Vector2d(-320, 240)}) {
    const SparseModel model =
        expectMends(folder.write("model.nvm", nvmText(original, {false, origin})), {{Mend::OriginOfImagePositions, 5}});
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(model.cameras[i].parameters[2], origin[0], 1e-6);
      EXPECT_NEAR(model.cameras[i].parameters[3], origin[1], 1e-6);
    }
  }
}

TEST(MendedNvmFiles, ImagesOfDifferentSizesHaveOriginsOfTheirOwn) {
  SparseModel portrait = nvmScene();
  for (std::size_t i = 0; i < 5; ++i)
    for (Observation& o : portrait.images[i].observations) {
      o.x += i % 2 ? 800 : 600;
      o.y += i % 2 ? 600 : 800;
    }
  const TemporaryFolder folder;
  const SparseModel model = expectMends(folder.write("model.nvm", nvmText(portrait)), {{Mend::OriginOfImagePositions, 5}});
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(model.cameras[i].parameters[2], i % 2 ? 800 : 600, 1e-6);
}

std::string bundlerText(const SparseModel& model) {
  std::string text =
      "# Bundle file v0.3\n" + std::to_string(model.images.size()) + " " + std::to_string(model.points.size()) + "\n";
  const Eigen::Matrix3d flip = Vector3d(1, -1, -1).asDiagonal();
  for (const Image& image : model.images) {
    const Eigen::Matrix3d rotation = flip * image.rotation.transpose();
    const Vector3d t = -(rotation * image.position);
    text += numberText(model.cameras[image.camera].parameters[0]) + " 0 0\n";
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) text += numberText(rotation(row, column)) + " ";
      text += "\n";
    }
    text += numberText(t[0]) + " " + numberText(t[1]) + " " + numberText(t[2]) + "\n";
  }
  for (const Point& point : model.points) {
    text +=
        numberText(point.position[0]) + " " + numberText(point.position[1]) + " " + numberText(point.position[2]) + "\n1 2 3\n";
    text += std::to_string(point.track.size());
    for (const TrackElement& e : point.track) {
      const Observation& o = model.images[e.image].observations[e.observation];
      text += " " + std::to_string(e.image) + " 0 " + numberText(o.x) + " " + numberText(-o.y);
    }
    text += "\n";
  }
  return text;
}

SparseModel bundlerScene() {
  SparseModel model = nvmScene();
  for (std::size_t i = 0; i < 5; ++i) {
    model.cameras[i].parameters[4] = 0;
    for (Observation& o : model.images[i].observations) {
      const Vector3d x =
          model.images[i].rotation.transpose() *
          (o.point == Observation::kNoPoint ? Vector3d(0, 0, 0) : model.points[o.point].position - model.images[i].position);
      if (o.point == Observation::kNoPoint) continue;
      o.x = model.cameras[i].parameters[0] * x[0] / x[2];
      o.y = model.cameras[i].parameters[0] * x[1] / x[2];
    }
  }
  return model;
}

TEST(MendedBundlerFiles, PointsMayBeInfinite) {
  SparseModel damaged = bundlerScene();
  const std::string text = replacedAll(bundlerText(damaged), numberText(damaged.points[9].position[0]), "1.#INF");
  const TemporaryFolder folder;
  const SparseModel model = expectMends(folder.write("bundle.out", text), {{Mend::PointNotFinite, 1}});
  EXPECT_EQ(model.points.size(), 39u);
  EXPECT_EQ(model.points[9].id, 10u);
  EXPECT_EQ(model.images[0].observations.size(), 40u);  // a feature without a point is left
}

TEST(MendedBundlerFiles, ViewsMayLieInCamerasWithoutPose) {
  const TemporaryFolder folder;
  const SparseModel original = bundlerScene();
  // f = 0; a negative f; a matrix that is no rotation; a position that is nowhere
  const std::vector<std::pair<std::map<std::size_t, std::string>, std::map<Mend, std::size_t>>> cases{
      {{{0, "0 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}}},
      {{{0, "-700 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}, {Mend::UnusableCamera, 1}}},
      {{{1, "0 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}, {Mend::ImageWithoutUsablePose, 1}}},
      {{{4, "nan 0 0"}}, {{Mend::TrackOfUnregisteredImage, 40}, {Mend::ImageWithoutUsablePose, 1}}}};
  for (const auto& [changes, mends] : cases) {
    std::vector<std::string> lines = linesOf(bundlerText(original));
    for (const auto& [line, text] : changes) lines[2 + 5 * 2 + line] = text;  // of camera 2
    const SparseModel model = expectMends(folder.write("bundle.out", joined(lines)), mends);
    EXPECT_FALSE(model.images[2].registered);
    EXPECT_EQ(countTrackElements(model), 160u);
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

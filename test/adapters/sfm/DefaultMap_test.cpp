// The committed default map is what its generator makes, and is the kind of map that it promises to be.
#include "DefaultMap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace sfm {
namespace {

const std::string kFolder = HYBRIDGV_DEFAULT_MAP_DIR;
constexpr std::uint64_t kSeed = 2;

TEST(DefaultMap, IsWhatItsGeneratorMakes) {
  const SparseModel committed = readModel(kFolder), made = makeDefaultMap(kSeed);
  ASSERT_EQ(committed.cameras.size(), made.cameras.size());
  ASSERT_EQ(committed.images.size(), made.images.size());
  ASSERT_EQ(committed.points.size(), made.points.size());
  for (std::size_t i = 0; i < made.cameras.size(); ++i) {
    EXPECT_EQ(committed.cameras[i].model, made.cameras[i].model);
    ASSERT_EQ(committed.cameras[i].parameters.size(), made.cameras[i].parameters.size());
    for (std::size_t k = 0; k < made.cameras[i].parameters.size(); ++k)
      EXPECT_NEAR(committed.cameras[i].parameters[k], made.cameras[i].parameters[k], 1e-9);
  }
  for (std::size_t i = 0; i < made.images.size(); ++i) {
    const Image &a = committed.images[i], &b = made.images[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_LT((a.rotation - b.rotation).norm(), 1e-9);
    EXPECT_LT((a.position - b.position).norm(), 1e-9);
    ASSERT_EQ(a.observations.size(), b.observations.size());
    for (std::size_t k = 0; k < b.observations.size(); ++k) {
      EXPECT_NEAR(a.observations[k].x, b.observations[k].x, 0.0101);  // the last digit may be rounded otherwise
      EXPECT_NEAR(a.observations[k].y, b.observations[k].y, 0.0101);
      EXPECT_EQ(a.observations[k].point, b.observations[k].point);
    }
  }
  for (std::size_t i = 0; i < made.points.size(); ++i)
    EXPECT_LT((committed.points[i].position - made.points[i].position).norm(), 0.01);
}

TEST(DefaultMap, IsSmall) {
  std::uintmax_t bytes = 0;
  for (const char* name : {"cameras.txt", "images.txt", "points3D.txt"})
    bytes += std::filesystem::file_size(kFolder + "/" + name);
  EXPECT_LE(bytes, 200000u);
}

TEST(DefaultMap, HasManyFocalLengthsAndEveryCommonCameraModel) {
  const SparseModel model = readModel(kFolder);
  std::set<CameraModel> models;
  std::set<double> focalLengths;
  for (const Camera& camera : model.cameras) {
    models.insert(camera.model);
    focalLengths.insert(focalLength(camera));
  }
  EXPECT_EQ(models, (std::set<CameraModel>{CameraModel::SimplePinhole, CameraModel::SimpleRadial, CameraModel::Radial,
                                           CameraModel::OpenCV}));
  EXPECT_EQ(focalLengths.size(), model.images.size());
  EXPECT_LT(*focalLengths.begin(), 700);
  EXPECT_GT(*focalLengths.rbegin(), 1400);
}

TEST(DefaultMap, GivesEveryQueryBothKindsOfMatches) {
  const SparseModel model = readModel(kFolder);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const LocalizationProblem problem = makeLocalizationProblem(model, i);
    EXPECT_GE(problem.adapter.getNumberCorrespondences2d2d(), 20u) << i;
    EXPECT_GE(problem.adapter.getNumberCorrespondences2d3d(), 10u) << i;
  }
}

TEST(DefaultMap, DependsOnTheSeed) {
  EXPECT_NE(makeDefaultMap(1).cameras[0].parameters, makeDefaultMap(kSeed).cameras[0].parameters);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

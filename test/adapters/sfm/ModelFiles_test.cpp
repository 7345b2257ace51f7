#include "hybridgv/adapters/sfm/ModelFiles.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "SfmScene.hpp"
#include "TemporaryFolder.hpp"

namespace hybridgv {
namespace sfm {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::TemporaryFolder;

SparseModel randomModel(std::uint64_t stream) {
  test::Random random(test::testSeed(), stream);
  return test::makeScene(random, 20, 60, 0.5, test::colmapModels());
}

void expectEqual(const SparseModel& a, const SparseModel& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  ASSERT_EQ(a.images.size(), b.images.size());
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].id, b.cameras[i].id);
    EXPECT_EQ(a.cameras[i].model, b.cameras[i].model);
    EXPECT_EQ(a.cameras[i].width, b.cameras[i].width);
    EXPECT_EQ(a.cameras[i].height, b.cameras[i].height);
    EXPECT_EQ(a.cameras[i].parameters, b.cameras[i].parameters);
  }
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    const Image &x = a.images[i], &y = b.images[i];
    EXPECT_EQ(x.id, y.id);
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.camera, y.camera);
    EXPECT_LT((x.rotation - y.rotation).norm(), 1e-14);  // it is stored as a quaternion
    EXPECT_LT((x.position - y.position).norm(), 1e-13);
    ASSERT_EQ(x.observations.size(), y.observations.size());
    for (std::size_t k = 0; k < x.observations.size(); ++k) {
      EXPECT_EQ(x.observations[k].x, y.observations[k].x);
      EXPECT_EQ(x.observations[k].y, y.observations[k].y);
      EXPECT_EQ(x.observations[k].point, y.observations[k].point);
    }
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Point &x = a.points[i], &y = b.points[i];
    EXPECT_EQ(x.id, y.id);
    EXPECT_EQ(x.position, y.position);
    EXPECT_EQ(x.colour, y.colour);
    EXPECT_EQ(x.error, y.error);
    ASSERT_EQ(x.track.size(), y.track.size());
    for (std::size_t k = 0; k < x.track.size(); ++k) {
      EXPECT_EQ(x.track[k].image, y.track[k].image);
      EXPECT_EQ(x.track[k].observation, y.track[k].observation);
    }
  }
}

// Largest distance [px] of an observation from the projection of its point, without distortion.
double largestError(const SparseModel& model) {
  double result = 0;
  for (const Point& point : model.points)
    for (const TrackElement& e : point.track) {
      const Image& image = model.images[e.image];
      const Camera& camera = model.cameras[image.camera];
      const Observation& o = image.observations[e.observation];
      const Vector3d x = image.rotation.transpose() * (point.position - image.position);
      EXPECT_GT(x[2], 0);
      const double f = focalLength(camera);
      const auto imagePoint = undistort(camera, o.x, o.y);
      EXPECT_TRUE(imagePoint);
      if (imagePoint)
        result = std::max(result, std::hypot(f * x[0] / x[2] - (*imagePoint)[0], f * x[1] / x[2] - (*imagePoint)[1]));
    }
  return result;
}

TEST(ModelFiles, ColmapTextKeepsEverything) {
  const TemporaryFolder folder;
  const SparseModel model = randomModel(1);
  writeColmapText(folder.path(), model);
  expectEqual(readColmapText(folder.path()), model);
}

TEST(ModelFiles, ColmapBinaryKeepsEverything) {
  const TemporaryFolder folder;
  const SparseModel model = randomModel(2);
  writeColmapBinary(folder.path(), model);
  expectEqual(readColmapBinary(folder.path()), model);
}

TEST(ModelFiles, TextAndBinaryTellTheSame) {
  const TemporaryFolder text, binary;
  const SparseModel model = randomModel(3);
  writeColmapText(text.path(), model);
  writeColmapBinary(binary.path(), readColmapText(text.path()));
  expectEqual(readModel(binary.path()), readModel(text.path()));
}

TEST(ModelFiles, WritingAgainGivesTheSameObservationsAndPoints) {
  const TemporaryFolder first, second;
  writeColmapText(first.path(), randomModel(4));
  writeColmapText(second.path(), readColmapText(first.path()));
  EXPECT_EQ(first.read("points3D.txt"), second.read("points3D.txt"));
  EXPECT_EQ(first.read("cameras.txt"), second.read("cameras.txt"));
}

// Poses too, which are stored in another way than they are held.
TEST(ModelFiles, WhatWasReadIsWrittenBitByBit) {
  const TemporaryFolder first, second, third;
  writeColmapBinary(first.path(), randomModel(7));
  SparseModel model = readColmapBinary(first.path());
  writeColmapBinary(second.path(), model);
  for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"})
    EXPECT_TRUE(first.read(file) == second.read(file)) << file;
  model.images[3].position[0] += 1;  // a pose that has changed is written as it is now
  writeColmapBinary(third.path(), model);
  EXPECT_NEAR(readColmapBinary(third.path()).images[3].position[0], model.images[3].position[0], 1e-12);
}

// Whoever cannot write everything leaves everything.
TEST(ModelFiles, FailedWritingLeavesTheOldModel) {
  const TemporaryFolder folder;
  const SparseModel old = randomModel(8);
  writeColmapBinary(folder.path(), old);
  std::ofstream(folder.path() + ".hybridgv-unfinished");
  folder.write(".hybridgv-unfinished", "");
  EXPECT_THROW(writeColmapBinary(folder.path(), randomModel(9)), FileError);
  std::filesystem::remove(folder.path() + ".hybridgv-unfinished");
  std::filesystem::remove(folder.file(".hybridgv-unfinished"));
  expectEqual(readColmapBinary(folder.path()), old);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) files += entry.is_regular_file();
  EXPECT_EQ(files, 3u);
}

TEST(ModelFiles, BinaryIsPreferredInAFolderWithBoth) {
  const TemporaryFolder folder;
  writeColmapText(folder.path(), randomModel(5));
  const SparseModel other = randomModel(6);
  writeColmapBinary(folder.path(), other);
  expectEqual(readModel(folder.path()), other);
}

// Two lines of an image may be empty, comments and line ends of other systems are skipped, names contain blanks.
TEST(ModelFiles, ColmapTextAsWrittenByHand) {
  const TemporaryFolder folder;
  folder.write("cameras.txt", "# comment\r\n\r\n3 PINHOLE 640 480 500 510 320 240\r\n");
  folder.write("images.txt",
               "# comment\n7 2 0 0 0 0 0 5 3 a photo.jpg\n10 20 4 +30 1e1 -1\n\n8 0 1 0 0 1 2 3 3 second.jpg\n 320.0\t240.0 4 \n"
               "9 1 0 0 0 0 0 0 3 blind.jpg\n\n");
  folder.write("points3D.txt", "4 1 2 3 255 0 128 -1 7 0 8 0");
  const SparseModel model = readModel(folder.path());
  ASSERT_EQ(model.images.size(), 3u);
  EXPECT_EQ(model.images[0].name, "a photo.jpg");
  EXPECT_EQ(model.images[0].position, Vector3d(0, 0, -5));
  EXPECT_EQ(model.images[0].observations[1].x, 30);
  EXPECT_EQ(model.images[0].observations[1].point, Observation::kNoPoint);
  // q = (0, 1, 0, 0) turns about x by 180 degrees: X -> (X, -Y, -Z) + (1, 2, 3)
  EXPECT_LT((model.images[1].position - Vector3d(-1, 2, 3)).norm(), 1e-15);
  EXPECT_TRUE(model.images[2].observations.empty());
  ASSERT_EQ(model.points[0].track.size(), 2u);
  EXPECT_EQ(model.points[0].track[1].image, 1u);
  EXPECT_EQ(model.points[0].colour, (std::array<std::uint8_t, 3>{255, 0, 128}));
}

TEST(ModelFiles, EmptyColmapModelIsAModel) {
  const TemporaryFolder folder;
  for (const char* name : {"cameras.txt", "images.txt", "points3D.txt"}) folder.write(name, "# none\n");
  EXPECT_TRUE(readModel(folder.path()).images.empty());
}

TEST(ModelFiles, WriterLeavesOutImagesWithoutPose) {
  const TemporaryFolder folder;
  SparseModel model = randomModel(7);
  Image lost;
  lost.id = 12345;
  lost.name = "lost.jpg";
  lost.registered = false;
  lost.camera = model.cameras.size();
  model.cameras.emplace_back();
  model.images.insert(model.images.begin(), lost);
  for (Point& point : model.points)
    for (TrackElement& e : point.track) ++e.image;
  writeColmapText(folder.path(), model);
  expectEqual(readColmapText(folder.path()), randomModel(7));
}

TEST(ModelFiles, WriterRejectsWhatItCannotWrite) {
  const TemporaryFolder folder;
  const auto expectRejected = [&](const std::function<void(SparseModel&)>& damage) {
    SparseModel model = randomModel(8);
    damage(model);
    EXPECT_THROW(writeColmapText(folder.path(), model), std::invalid_argument);
    EXPECT_THROW(writeColmapBinary(folder.path(), model), std::invalid_argument);
  };
  expectRejected([](SparseModel& m) { m.images[1].camera = 99; });
  expectRejected([](SparseModel& m) { m.images[1].name = ""; });
  expectRejected([](SparseModel& m) { m.images[1].name = "a\nb"; });
  expectRejected([](SparseModel& m) { m.images[1].id = m.images[0].id; });
  expectRejected([](SparseModel& m) { m.images[1].position[0] = NAN; });
  expectRejected([](SparseModel& m) { m.images[1].observations[0].point = m.points.size(); });
  expectRejected([](SparseModel& m) { m.images[1].observations[0].x = INFINITY; });
  expectRejected([](SparseModel& m) { m.points[1].position[0] = NAN; });
  expectRejected([](SparseModel& m) { m.points[1].track.push_back({99, 0}); });
  expectRejected([](SparseModel& m) { m.points[1].track.push_back(m.points[2].track.at(0)); });
  expectRejected([](SparseModel& m) { m.cameras[0].parameters.clear(); });
  expectRejected([](SparseModel& m) { m.cameras[0] = test::makeCamera(CameraModel::NvmRadial); });
  EXPECT_THROW(writeColmapText(folder.file("missing/model"), randomModel(8)), FileError);
}

// f, k1, k2, R, t, then points; x = R X + t, seen at -f (x, y) / z, y upwards.
TEST(ModelFiles, BundlerCamerasLookAlongMinusZ) {
  const TemporaryFolder folder;
  const double a = 0.6, b = 0.8;  // a rotation about the x axis
  const Vector3d X(0.3, -0.2, 0.5), t(0.1, 0.2, -5);
  Matrix3d R;
  R << 1, 0, 0, 0, b, -a, 0, a, b;
  const Vector3d p = R * X + t;
  const double x = -p[0] / p[2], y = -p[1] / p[2], r2 = x * x + y * y, distortion = 1 - 0.1 * r2 + 0.02 * r2 * r2;
  std::ostringstream text;
  text.precision(17);
  text << "# Bundle file v0.3\n2 1\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n600 -0.1 0.02\n1 0 0\n0 0.8 -0.6\n0 0.6 0.8\n0.1 0.2 -5\n"
       << "0.3 -0.2 0.5\n1 2 3\n1 1 77 " << 600 * distortion * x << ' ' << 600 * distortion * y << "\n";
  const SparseModel model = readModel(folder.write("bundle.out", text.str()));
  ASSERT_EQ(model.images.size(), 2u);
  EXPECT_FALSE(model.images[0].registered);
  EXPECT_TRUE(model.images[1].registered);
  EXPECT_EQ(model.images[1].name, "image_1");
  EXPECT_EQ(focalLength(model.cameras[model.images[1].camera]), 600);
  EXPECT_LT((model.images[1].position + R.transpose() * t).norm(), 1e-14);
  EXPECT_NEAR(model.images[1].rotation.determinant(), 1, 1e-14);
  EXPECT_LT(largestError(model), 1e-9);
}

std::string nvmFile(const std::string& header, double x, double y, const std::string& end) {
  std::ostringstream text;
  text.precision(17);
  // q = (0, 1, 0, 0): X -> (X, -Y, -Z); centre (1, 2, 9); the point (1.5, 2.2, 5) is at (0.5, -0.2, 4)
  text << header << "\n\n2\na\"b.jpg\t650 0 1 0 0 1 2 9 0.05 0\nsecond.jpg 640 1 0 0 0 0 0 0 0 0\n\n1\n"
       << "1.5 2.2 5 9 8 7 1 0 12 " << x << ' ' << y << "\n"
       << end;
  return text.str();
}

// With d the position in the image over f: (1 + 0.05 |d|^2) d = (0.125, -0.05)
Vector3d nvmPosition() {
  Camera camera = test::makeCamera(CameraModel::NvmRadial);
  camera.parameters = {1, 1, 0, 0, 0.05};
  return *distort(camera, {0.125, -0.05, 1});
}

TEST(ModelFiles, NvmPositionsAreRelativeToThePrincipalPoint) {
  const TemporaryFolder folder;
  const Vector3d d = nvmPosition();
  EXPECT_NEAR((1 + 0.05 * d.head<2>().squaredNorm()) * d[0], 0.125, 1e-15);
  const SparseModel model = readModel(folder.write("model.nvm", nvmFile("NVM_V3 ", 650 * d[0], 650 * d[1], "")));
  ASSERT_EQ(model.images.size(), 2u);
  EXPECT_EQ(model.images[0].name, "a b.jpg");
  EXPECT_EQ(model.images[0].position, Vector3d(1, 2, 9));
  EXPECT_LT(largestError(model), 1e-10);
}

TEST(ModelFiles, NvmFixedCalibrationReplacesTheFocalLengths) {
  const TemporaryFolder folder;
  const Vector3d d = nvmPosition();
  const SparseModel model =
      readModel(folder.write("model.nvm", nvmFile("NVM_V3 FixedK 700 320 710 240", 700 * d[0], 710 * d[1], "")));
  EXPECT_EQ(focalLength(model.cameras[0]), 700);
  EXPECT_LT(largestError(model), 1e-10);
}

TEST(ModelFiles, NvmMayHoldMoreModelsAndAListOfPlyFiles) {
  const TemporaryFolder folder;
  const std::string rest = "\n1\nc.jpg 600 1 0 0 0 0 0 0 0 0\n0\n\n0\n\n#the last part points to the PLY files\n#numbers\n1 0\n";
  const SparseModel model = readModel(folder.write("model.nvm", nvmFile("NVM_V3", 1, 2, rest)));
  EXPECT_EQ(model.images.size(), 2u);
  EXPECT_EQ(model.points.size(), 1u);
}

TEST(ModelFiles, BundlerAndNvmCanBeWrittenForColmap) {
  const TemporaryFolder folder;
  SparseModel model = readModel(folder.write("model.nvm", nvmFile("NVM_V3", 1, 2, "")));
  EXPECT_THROW(writeColmapText(folder.path(), model), std::invalid_argument);
  model.cameras[0].parameters[4] = 0;
  writeColmapText(folder.path(), model);
  EXPECT_EQ(readModel(folder.path()).cameras[0].model, CameraModel::Pinhole);
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

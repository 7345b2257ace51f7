// Writes the first inputs of all fuzzers: make_seeds FOLDER. For the solvers valid samples (their problems solved exactly, see
// MinimalProblem.hpp), for the readers small valid files.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "MinimalProblem.hpp"
#include "SampleBytes.hpp"
#include "SfmScene.hpp"
#include "SolverConfigurations.hpp"
#include "TemporaryFolder.hpp"
#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"

namespace hybridgv {
namespace fuzz {
namespace {

constexpr std::uint64_t kSeed = 71;
constexpr char kSeparator[] = "\n%%%\n";

const char* const kCameras =
    "1 SIMPLE_RADIAL 640 480 500 320 240 0.1\n2 PINHOLE 640 480 500 510 320 240\n3 OPENCV 9 9 5 5 4 4 0.1 0 0.01 0\n"
    "4 RADIAL 9 9 5 4 4 -0.1 0.01\n5 SIMPLE_PINHOLE 9 9 5 4 4\n";
const char* const kImages =
    "# images\n1 1 0 0 0 0 0 5 1 a.jpg\n10 20 7 30 40 -1\n2 1 0 0 0 1 0 5 2 b.jpg\n50 60 7 70 80 8\n3 1 0 0 0 2 0 5 3 c.jpg\n"
    "15 25 8\n4 0.7 0 0.7 0 2 0 5 4 d.jpg\n\n";
const char* const kMoreCameras =
    "6 OPENCV_FISHEYE 9 9 5 5 4 4 0.1 0 0.01 0\n7 FULL_OPENCV 9 9 5 5 4 4 0.1 0 0.01 0 0 0.1 0 0\n8 FOV 9 9 5 5 4 4 0.9\n"
    "9 RADIAL_FISHEYE 9 9 5 4 4 0.1 0.01\n10 THIN_PRISM_FISHEYE 9 9 5 5 4 4 0.1 0 0.01 0 0 0 0.01 0.01\n"
    "11 RAD_TAN_THIN_PRISM_FISHEYE 9 9 5 5 4 4 0.1 0 0 0 0 0 0.01 0 0.01 0 0 0.01\n12 DIVISION 9 9 5 5 4 4 -0.1\n"
    "13 EUCM 9 9 5 5 4 4 0.6 1.1\n14 EQUIRECTANGULAR 9 9 9 9\n15 TOMORROW 9 9 1 2 3\n";
const char* const kPoints = "7 0 0 1 9 9 9 0.5 1 0 2 0\n8 1 1 1 9 9 9 0.5 2 1 3 0\n";
const char* const kBundler =
    "# Bundle file v0.3\n2 2\n500 0.1 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -5\n510 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 -5\n"
    "0 0 1\n1 2 3\n2 0 3 10 20 1 4 50 60\n1 0 1\n1 2 3\n1 0 3 10 20\n";
const char* const kNvm =
    "NVM_V3 FixedK 500 320 510 240\n\n2\na.jpg 500 1 0 0 0 0 0 -5 0.1 0\nb.jpg 500 1 0 0 0 1 0 -5 0 0\n\n1\n"
    "0 0 1 9 9 9 2 0 3 10 20 1 4 50 60\n\n0\n#PLY\n0\n";
const char* const kNvmMatrices =
    "NVM_V3_R9T\n\n1\na photo.jpg 500 1 0 0 0 1 0 0 0 1 0 0 5 0 0\n\n1\n0 0 1 9.0 9 9 1 0 3 10 20\n\n0\n";
const char* const kNvmTwoModels =
    "NVM_V3\n\n1\na.jpg 500 1 0 0 0 0 0 -5 0 0\n1\n0 0 1 9 9 9 1 0 3 10 20\n1\nb.jpg 5 1 0 0 0 0 0 0 0 0\n0\n0\n";
const char* const kProblem =
    "# problem\nquery 500 1 0 0 0 0 0 5\nimage 640 480\ncam 3 1 2 3\ncam 4 0 1 0 500 1 0 0 0\np3 10 20 1 2 3\np3 -10 2 1 3 3\np2 "
    "30 40 3 0 0 1\np2 3 4 4 1 "
    "0 1\n";

void write(const std::filesystem::path& file, const std::string& contents) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << contents;
}

// The image in the unit in which the focal length is the one that the fuzzer gives to solvers that need it.
void setFocalLength(test::MinimalProblem& problem) {
  const double scale = kFocalLength / problem.truth.focalLength;
  for (solvers::RayMatch& ray : problem.rays) {
    ray.u *= scale;
    ray.v *= scale;
  }
  for (solvers::PointMatch& match : problem.points) {
    match.u *= scale;
    match.v *= scale;
  }
}

void writeSamples(const std::filesystem::path& folder, const std::vector<std::vector<int>>& raysPerCamera, int points) {
  for (std::size_t i = 0; i < raysPerCamera.size(); ++i) {
    test::Random random(kSeed, i);
    test::MinimalProblem problem = test::makeMinimalProblem(random, raysPerCamera[i], points);
    setFocalLength(problem);
    write(folder / ("sample" + std::to_string(i)), encodeSample({problem.rays, problem.points}));
  }
}

// Every way to share the rays among rig cameras; the only one twice.
std::vector<std::vector<int>> raysPerCamera(const solvers::SolverRows& problem) {
  std::vector<std::vector<int>> result;
  for (const test::SolverConfiguration& configuration : test::configurationsOf(problem))
    result.push_back(configuration.raysPerCamera);
  if (result.size() == 1) result.push_back(result[0]);
  return result;
}

template <class Values>
std::string bytesOf(const Values& values) {
  std::string bytes(values.size() * sizeof values[0], '\0');
  std::memcpy(&bytes[0], values.data(), bytes.size());
  return bytes;
}

void writeCameras(const std::filesystem::path& folder) {
  for (const sfm::CameraModel model : test::colmapModels()) {
    std::vector<double> values{700, 300};  // a pixel
    const sfm::Camera camera = test::makeCamera(model);
    values.insert(values.end(), camera.parameters.begin(), camera.parameters.end());
    write(folder / "camera" / toString(model), std::string(1, static_cast<char>(model)) + bytesOf(values));
  }
}

// Two keypoints of six columns, three matches: a byte that is not used, rows, columns, the blob.
void writeBlobs(const std::filesystem::path& folder) {
  const auto header = [](char rows, char columns) {
    std::string bytes(17, '\1');
    bytes[2] = rows;
    bytes[10] = columns;
    return bytes;
  };
  write(folder / "database" / "keypoints", header(2, 6) + bytesOf(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  write(folder / "database" / "matches", header(3, 2) + bytesOf(std::vector<std::uint32_t>{1, 2, 3, 4, 5, 6}));
  write(folder / "database" / "numbers", header(1, 8) + bytesOf(std::vector<double>{1000, 500, 400, 0.1}));
}

void writeModels(const std::filesystem::path& folder) {
  const test::TemporaryFolder files;
  files.write("cameras.txt", kCameras), files.write("images.txt", kImages), files.write("points3D.txt", kPoints);
  sfm::writeColmapBinary(files.path(), sfm::readColmapText(files.path()));
  std::string moreImages;
  for (int id = 6; id <= 15; ++id)
    moreImages += std::to_string(id) + " 1 0 0 0 0 0 5 " + std::to_string(id) + " more.jpg\n3 4 7 5 6 -1\n";
  write(folder / "colmap_text" / "all_cameras", std::string(kMoreCameras) + kSeparator + moreImages + kSeparator + kPoints);
  write(folder / "colmap_text" / "model", std::string(kCameras) + kSeparator + kImages + kSeparator + kPoints);
  write(folder / "colmap_binary" / "model",
        files.read("cameras.bin") + kSeparator + files.read("images.bin") + kSeparator + files.read("points3D.bin"));
  write(folder / "bundler" / "model", kBundler);
  write(folder / "nvm" / "model", kNvm);
  write(folder / "nvm" / "two_models", kNvmTwoModels);
  write(folder / "nvm" / "matrices", kNvmMatrices);
  write(folder / "problem" / "problem", kProblem);
  // They must be valid: a reader throws otherwise.
  sfm::readBundler(folder / "bundler" / "model");
  sfm::readNvm(folder / "nvm" / "model"), sfm::readNvm(folder / "nvm" / "two_models");
  sfm::readProblem(folder / "problem" / "problem");
}

}  // namespace
}  // namespace fuzz
}  // namespace hybridgv

int main(int argc, char** argv) {
  using namespace hybridgv::fuzz;
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_seeds FOLDER\n");
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  for (const hybridgv::solvers::SolverRows& problem : hybridgv::solvers::minimalProblems())
    writeSamples(folder / problem.name(), raysPerCamera(problem), problem.points());
  writeSamples(folder / "hybrid_ransac", {{2, 2, 2}, {6}}, 8);
  writeModels(folder);
  writeCameras(folder);
  writeBlobs(folder);
}

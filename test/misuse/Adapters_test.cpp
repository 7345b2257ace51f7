// Wrong data for NoncentralHybridAdapter.
#include "Misuse.hpp"

namespace hybridgv {
namespace test {
namespace {

using Vectors = NoncentralHybridAdapter::Vectors;

// The constructor's arguments; two 2D-2D correspondences of two cameras and two 2D-3D ones.
struct Arguments {
  Vectors imagePoints2d2d{{1, 2, 1}, {3, 4, 1}}, bearingVectors{{0, 0, 1}, {0, 0.1, 1}};
  std::vector<int> camIndices{0, 1};
  Vectors camOffsets{{1, 0, 0}, {0, 1, 0}};
  NoncentralHybridAdapter::Matrices camRotations{2, Eigen::Matrix3d::Identity()};
  Vectors imagePoints2d3d{{5, 6, 1}, {7, 8, 1}}, points{{1, 2, 3}, {4, 5, 6}};

  NoncentralHybridAdapter adapter() const {
    return {imagePoints2d2d, bearingVectors, camIndices, camOffsets, camRotations, imagePoints2d3d, points};
  }
};

void expectWrong(const std::string& wrong, const std::string& argument, const std::function<void(Arguments&)>& change) {
  Arguments arguments;
  EXPECT_NO_THROW(arguments.adapter());
  change(arguments);
  expectRefused(wrong, argument, [&] { arguments.adapter(); });
}

TEST(Misuse, NoncentralAdapterRefusesNumbersThatAreNotFinite) {
  const struct {
    const char* name;
    Vectors Arguments::*list;
  } lists[] = {{"imagePoints2d2d", &Arguments::imagePoints2d2d},
               {"bearingVectors", &Arguments::bearingVectors},
               {"camOffsets", &Arguments::camOffsets},
               {"imagePoints2d3d", &Arguments::imagePoints2d3d},
               {"points", &Arguments::points}};
  for (const double value : notFinite())
    for (std::size_t i = 0; i < 2; ++i)
      for (int k = 0; k < 3; ++k) {
        const std::string element = "[" + std::to_string(i) + "]", wrong = element + " = " + std::to_string(value);
        for (const auto& entry : lists)
          expectWrong(entry.name + wrong, entry.name + element, [&](Arguments& a) { (a.*entry.list)[i][k] = value; });
        for (int j = 0; j < 3; ++j)
          expectWrong("camRotations" + wrong, "camRotations" + element, [&](Arguments& a) { a.camRotations[i](j, k) = value; });
      }
}

TEST(Misuse, NoncentralAdapterShowsTheWrongValue) {
  expectWrong("far", "points[1]: must be finite, is (1, -1e-09, inf)", [](Arguments& a) { a.points[1] = {1, -1e-9, kInfinite}; });
  expectWrong("no image", "imagePoints2d2d[1]: must be homogeneous, (u, v, 1), is (1e+300, 2, 0)", [](Arguments& a) {
    a.imagePoints2d2d[1] = {1e300, 2, 0};
  });
  expectWrong("mirror", "camRotations[0]: must be a rotation matrix, is [1, 0, 0; 0, 1, 0; 0, 0, -1]",
              [](Arguments& a) { a.camRotations[0] = Eigen::Vector3d(1, 1, -1).asDiagonal(); });
  NoncentralHybridAdapter adapter = goodAdapter();
  std::vector<double> focalLengths(5, 1000);
  focalLengths[2] = -1e-9;
  expectRefused("rig focal length", "focalLengths[2]: must be finite and not negative, is -1e-09",
                [&] { adapter.setRigFocalLengths(focalLengths); });
}

TEST(Misuse, NoncentralAdapterRefusesListsThatDoNotFit) {
  expectWrong("too few", "bearingVectors", [](Arguments& a) { a.bearingVectors.pop_back(); });
  expectWrong("too many", "bearingVectors", [](Arguments& a) { a.bearingVectors.push_back({0, 0, 1}); });
  expectWrong("too few", "camIndices", [](Arguments& a) { a.camIndices.pop_back(); });
  expectWrong("too many", "camIndices", [](Arguments& a) { a.camIndices.push_back(0); });
  expectWrong("too few", "imagePoints2d2d", [](Arguments& a) { a.imagePoints2d2d.pop_back(); });
  expectWrong("too many", "imagePoints2d2d", [](Arguments& a) { a.imagePoints2d2d.push_back({0, 0, 1}); });
  expectWrong("too few", "camRotations", [](Arguments& a) { a.camRotations.pop_back(); });
  expectWrong("too many", "camOffsets", [](Arguments& a) { a.camOffsets.push_back({0, 0, 1}); });
  expectWrong("too few", "points", [](Arguments& a) { a.points.pop_back(); });
  expectWrong("too many", "imagePoints2d3d", [](Arguments& a) { a.imagePoints2d3d.push_back({0, 0, 1}); });
}

TEST(Misuse, NoncentralAdapterRefusesImpossibleValues) {
  for (const int index : {-1, std::numeric_limits<int>::min(), 2, std::numeric_limits<int>::max()})
    expectWrong("index " + std::to_string(index), "camIndices[1]", [index](Arguments& a) { a.camIndices[1] = index; });
  expectWrong("point at infinity", "imagePoints2d2d[0]", [](Arguments& a) { a.imagePoints2d2d[0][2] = 0; });
  expectWrong("point at infinity", "imagePoints2d3d[1]", [](Arguments& a) { a.imagePoints2d3d[1][2] = 0; });
  expectWrong("zero", "bearingVectors[1]", [](Arguments& a) { a.bearingVectors[1].setZero(); });
  expectWrong("reflection", "camRotations[0]", [](Arguments& a) { a.camRotations[0](0, 0) = -1; });
  expectWrong("scaled", "camRotations[1]", [](Arguments& a) { a.camRotations[1] *= 1.1; });
  expectWrong("zero", "camRotations[1]", [](Arguments& a) { a.camRotations[1].setZero(); });
}

TEST(Misuse, NoncentralAdapterRefusesWrongFocalLengthsWeightsAndFeatures) {
  NoncentralHybridAdapter adapter = Arguments().adapter();
  for (const std::size_t count : {0, 1, 3}) {
    const std::vector<double> wrong(count, 1);
    expectRefused("count", "focalLengths", [&] { adapter.setRigFocalLengths(wrong); });
    if (count == 0) continue;  // no weights: all equal
    expectRefused("count", "weights2d2d", [&] { adapter.setWeights(wrong, {}); });
    expectRefused("count", "weights2d3d", [&] { adapter.setWeights({}, wrong); });
    const std::vector<int> wrongFeatures(count, 1);
    expectRefused("count", "features2d2d", [&] { adapter.setFeatures(wrongFeatures, {}); });
    expectRefused("count", "features2d3d", [&] { adapter.setFeatures({}, wrongFeatures); });
  }
  for (const double value : notFinite()) {
    expectRefused("value", "focalLengths[1]", [&] { adapter.setRigFocalLengths({1, value}); });
    expectRefused("value", "weights2d2d[0]", [&] { adapter.setWeights({value, 1}, {}); });
    expectRefused("value", "weights2d3d[1]", [&] { adapter.setWeights({}, {1, value}); });
  }
  expectRefused("negative", "focalLengths[0]", [&] { adapter.setRigFocalLengths({-1, 1}); });
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

// Wrong calls of the bridge to OpenGV: the adapter and the problems for its sample-consensus loops.
#include <opengv/absolute_pose/NoncentralAbsoluteAdapter.hpp>
#include <opengv/relative_pose/NoncentralRelativeAdapter.hpp>

#include "Misuse.hpp"
#include "hybridgv/adapters/OpenGVHybridAdapter.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/sac_problems/hybrid_pose/HybridPoseSacProblem.hpp"
#include "hybridgv/sac_problems/hybrid_pose/MultiHybridPoseSacProblem.hpp"

namespace hybridgv {
namespace test {
namespace {

using sac_problems::hybrid_pose::HybridPoseSacProblem;
using sac_problems::hybrid_pose::HybridProblemCore;
using sac_problems::hybrid_pose::MultiHybridPoseSacProblem;

// OpenGV's own lists: cameras 0 and 1 are the rig, camera 2 is the query.
struct OpenGVLists {
  opengv::bearingVectors_t rig{{0, 0, 1}, {0, 0.1, 1}}, query{{0.1, 0, 1}, {0, 0.2, 1}}, absolute{{0.3, 0, 1}, {0, 0.4, 1}};
  std::vector<int> rigCameras{0, 1}, queryCameras{2, 2}, absoluteCameras{0, 0};
  opengv::translations_t offsets{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, absoluteOffsets{{0, 0, 0}};
  opengv::rotations_t rotations{3, Eigen::Matrix3d::Identity()}, absoluteRotations{1, Eigen::Matrix3d::Identity()};
  opengv::points_t points{{1, 2, 3}, {4, 5, 6}};
  double nominalFocalLength = 800;

  void wrap() const {
    const opengv::relative_pose::NoncentralRelativeAdapter relative(rig, query, rigCameras, queryCameras, offsets, rotations);
    const opengv::absolute_pose::NoncentralAbsoluteAdapter absoluteAdapter(absolute, absoluteCameras, points, absoluteOffsets,
                                                                           absoluteRotations);
    OpenGVHybridAdapter adapter(relative, absoluteAdapter, nominalFocalLength);
  }
};

void expectWrong(const std::string& wrong, const std::string& argument, const std::function<void(OpenGVLists&)>& change) {
  OpenGVLists lists;
  EXPECT_NO_THROW(lists.wrap());
  change(lists);
  expectRefused(wrong, argument, [&] { lists.wrap(); });
}

TEST(Misuse, OpengvAdapterRefusesWhatAPinholeQueryCannotBe) {
  for (const double value : notFinite()) {
    const std::string wrong = std::to_string(value);
    for (int k = 0; k < 3; ++k) {
      expectWrong(wrong, "relative.getBearingVector2(1)", [=](OpenGVLists& l) { l.query[1][k] = value; });
      expectWrong(wrong, "absolute.getBearingVector(0)", [=](OpenGVLists& l) { l.absolute[0][k] = value; });
      expectWrong(wrong, "relative.getCamOffset2(0)", [=](OpenGVLists& l) { l.offsets[2][k] = value; });
      expectWrong(wrong, "absolute.getCamOffset(0)", [=](OpenGVLists& l) { l.absoluteOffsets[0][k] = value; });
      for (int j = 0; j < 3; ++j) {
        expectWrong(wrong, "relative.getCamRotation2(0)", [=](OpenGVLists& l) { l.rotations[2](j, k) = value; });
        expectWrong(wrong, "absolute.getCamRotation(0)", [=](OpenGVLists& l) { l.absoluteRotations[0](j, k) = value; });
      }
    }
    expectWrong(wrong, "nominalFocalLength", [=](OpenGVLists& l) { l.nominalFocalLength = value; });
  }
  for (const double value : {0.0, -800.0})
    expectWrong("focal length", "nominalFocalLength", [=](OpenGVLists& l) { l.nominalFocalLength = value; });
  for (const double z : {0.0, -1.0}) {
    expectWrong("not forward", "relative.getBearingVector2(0)", [=](OpenGVLists& l) { l.query[0][2] = z; });
    expectWrong("not forward", "absolute.getBearingVector(1)", [=](OpenGVLists& l) { l.absolute[1][2] = z; });
  }
  expectWrong("query not in the origin", "relative.getCamOffset2(0)", [](OpenGVLists& l) { l.queryCameras[0] = 1; });
}

// What the adapter does not look at itself is refused where it is used.
TEST(Misuse, NumbersOfOpengvsRigThatAreNotFiniteAreRefusedByTheSolvers) {
  for (const double value : notFinite()) {
    OpenGVLists lists;
    lists.offsets[1][0] = value;
    const opengv::relative_pose::NoncentralRelativeAdapter relative(lists.rig, lists.query, lists.rigCameras, lists.queryCameras,
                                                                    lists.offsets, lists.rotations);
    const opengv::absolute_pose::NoncentralAbsoluteAdapter absolute(lists.absolute, lists.absoluteCameras, lists.points,
                                                                    lists.absoluteOffsets, lists.absoluteRotations);
    const OpenGVHybridAdapter adapter(relative, absolute, 800);
    expectRefused(std::to_string(value), "getCamOffset(1)", [&] { hybrid_pose::optimize_nonlinear(adapter, FocalPose()); });
  }
}

TEST(Misuse, ProblemsRefuseWrongThresholdsSolversAndAdapters) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  const auto expectAllRefuse = [](const std::string& wrong, const std::string& argument,
                                  const hybrid_pose::HybridAdapterBase& data, Solver solver, double reprojection,
                                  double epipolar) {
    expectRefused(wrong, argument, [&] { HybridProblemCore(data, solver, reprojection, epipolar); });
    expectRefused(wrong, argument, [&] { HybridPoseSacProblem(data, solver, reprojection, epipolar); });
    expectRefused(wrong, argument, [&] { MultiHybridPoseSacProblem(data, solver, reprojection, epipolar); });
  };
  for (const double value : {kNaN, kInfinite, -kInfinite, 0.0, -1.0}) {
    expectAllRefuse(std::to_string(value), "maxReprojectionErrorPx", adapter, Solver::H13f, value, 1);
    expectAllRefuse(std::to_string(value), "maxEpipolarErrorPx", adapter, Solver::H13f, 1, value);
  }
  for (const Solver solver : noSolvers()) {
    const std::string value = std::to_string(static_cast<int>(solver));
    expectAllRefuse(value, "solver: no such value: " + value, adapter, solver, 1, 1);
  }
  for (const double value : {kNaN, kInfinite, 0.0, -1.0})
    expectRefused(std::to_string(value), "knownFocalLengthPx", [&] { HybridProblemCore(adapter, Solver::P3P, 1, 1, value); });
  expectRefused("missing", "knownFocalLengthPx: p3p needs it", [&] { HybridProblemCore(adapter, Solver::P3P, 1, 1); });
  expectRefused("needless", "knownFocalLengthPx: h13f estimates",
                [&] { HybridProblemCore(adapter, Solver::H13f, 1, 1, 1000.0); });
  const NoncentralHybridAdapter empty({}, {}, {}, {}, {}, {}, {});
  for (const Solver solver : allSolvers())
    expectRefused(toString(solver), "adapter", [&] { HybridProblemCore(empty, solver, 1, 1, focalLengthFor(solver, 1000)); });
  std::vector<WrongField> fields = wrongRayFields();
  const std::vector<WrongField> ofPoints = wrongPointFields();
  fields.insert(fields.end(), ofPoints.begin(), ofPoints.end());
  for (const double value : {kNaN, kInfinite, -1.0})
    fields.push_back({"rig focal length", [value](AlteredAdapter& a) { a.rigFocalLength = value; }, "getRigFocalLength(0)"});
  for (const WrongField& field : fields) {
    AlteredAdapter altered;
    field.apply(altered);
    expectAllRefuse(field.name, field.getter, altered, Solver::H13f, 1, 1);
  }
}

TEST(Misuse, ProblemsRefuseWrongIndices) {
  const NoncentralHybridAdapter adapter = goodAdapter();  // 12 + 8
  const HybridProblemCore core(adapter, Solver::H13f, 1, 1);
  HybridPoseSacProblem flat(adapter, Solver::H13f, 1, 1);
  MultiHybridPoseSacProblem multi(adapter, Solver::H13f, 1, 1);
  FocalPose model;
  std::vector<double> distances;
  std::vector<std::vector<double>> multiDistances;
  const sac_problems::hybrid_pose::CorrespondencePool pool = core.makePool({0, 12});

  for (const int index : {-1, std::numeric_limits<int>::min(), 20, std::numeric_limits<int>::max()}) {
    const std::string wrong = std::to_string(index), text = "index " + wrong;
    expectRefused(wrong, text, [&] { core.split({0, index}); });
    expectRefused(wrong, text, [&] { core.makePool({index}); });
    expectRefused(wrong, text, [&] { core.distances(model, {index}, distances); });
    expectRefused(wrong, text, [&] { core.isFlatSampleGood({0, 12, 13, index}); });
    expectRefused(wrong, text, [&] { flat.isSampleGood({0, 12, 13, index}); });
    expectRefused(wrong, text, [&] { flat.computeModelCoefficients({0, 12, 13, index}, model); });
    expectRefused(wrong, text, [&] { flat.getSelectedDistancesToModel(model, {index}, distances); });
    expectRefused(wrong, text, [&] { flat.optimizeModelCoefficients({index}, model, model); });
  }
  for (const int index : {-1, std::numeric_limits<int>::min(), 12, std::numeric_limits<int>::max()})
    for (const std::size_t list : {0u, 1u}) {
      if (list == 1 && index == 12) continue;
      std::vector<std::vector<int>> indices{{0}, {0, 1, 2}};
      indices[list][0] = index;
      const std::string wrong = std::to_string(index) + " in list " + std::to_string(list),
                        text = "index " + std::to_string(index);
      expectRefused(wrong, text, [&] { core.join(indices); });
      expectRefused(wrong, text, [&] { core.isSampleGood(indices); });
      expectRefused(wrong, text, [&] { core.computeModel(indices, pool, model); });
      expectRefused(wrong, text, [&] { core.optimize(indices, model); });
      expectRefused(wrong, text, [&] { multi.isSampleGood(indices); });
      expectRefused(wrong, text, [&] { multi.computeModelCoefficients(indices, model); });
      expectRefused(wrong, text, [&] { multi.getSelectedDistancesToModel(model, indices, multiDistances); });
      expectRefused(wrong, text, [&] { multi.optimizeModelCoefficients(indices, model, model); });
    }
  for (const std::vector<std::vector<int>>& lists : {std::vector<std::vector<int>>{}, {{0}}, {{0}, {0, 1, 2}, {}}}) {
    const std::string wrong = std::to_string(lists.size()) + " lists";
    expectRefused(wrong, "two lists", [&] { core.join(lists); });
    expectRefused(wrong, "two lists", [&] { core.isSampleGood(lists); });
    expectRefused(wrong, "two lists", [&] { core.computeModel(lists, pool, model); });
    expectRefused(wrong, "two lists", [&] { core.optimize(lists, model); });
    expectRefused(wrong, "two lists", [&] { multi.getSelectedDistancesToModel(model, lists, multiDistances); });
  }
  for (const std::vector<std::vector<int>>& sizes :
       {std::vector<std::vector<int>>{{}, {}}, {{}, {0, 1, 2}}, {{0}, {0, 1}}, {{0, 1}, {0, 1, 2}}, {{0}, {0, 1, 2, 3}}}) {
    expectRefused("sample size", "sample", [&] { core.isSampleGood(sizes); });
    expectRefused("sample size", "sample", [&] { core.computeModel(sizes, pool, model); });
  }
  expectRefused("repeated", "repeated", [&] { core.optimize({{0, 0}, {1}}, model); });
  // A repeated correspondence in a sample is a degenerate sample, which a loop may draw.
  EXPECT_FALSE(core.isSampleGood({{0}, {0, 1, 1}}));
  EXPECT_FALSE(core.computeModel({{0}, {0, 1, 1}}, pool, model));
}

TEST(Misuse, NothingAgreesWithAModelThatIsNotFinite) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  const HybridProblemCore core(adapter, Solver::H13f, 1, 1);
  std::vector<double> distances;
  for (const WrongPose& wrong : wrongPoses()) {
    core.distances(wrong.pose, {0, 12}, distances);
    for (const double distance : distances) EXPECT_TRUE(distance >= 0 && distance <= core.kMaxDistance) << wrong.name;
    if (!wrong.pose.rotation.allFinite() || !wrong.pose.position.allFinite() || !std::isfinite(wrong.pose.focalLength)) {
      EXPECT_EQ(core.countWithin(wrong.pose, core.makePool({0, 12}), 1), 0) << wrong.name;
    }
    expectRefused(wrong.name, "model", [&] { core.optimize({{0}, {1}}, wrong.pose); });
  }
  for (const double value : {kNaN, -kInfinite, -1.0})
    expectRefused(std::to_string(value), "threshold", [&] { core.countWithin(FocalPose(), core.makePool({0, 12}), value); });
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

// Wrong calls of the minimal solvers, of optimize_nonlinear and of the two errors.
#include <Eigen/Geometry>

#include "Misuse.hpp"
#include "hybrid_pose/solveSample.hpp"
#include "hybridgv/absolute_pose/methods.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/hybrid_pose/residuals.hpp"

namespace hybridgv {
namespace test {
namespace {

using hybrid_pose::HybridAdapterBase;
using MultiIndices = std::vector<std::vector<int>>;

// A public solver with one list of indices or two, as one with two.
struct PublicSolver {
  std::string name;
  int rays, points;
  bool twoLists;
  std::function<FocalPoses(const HybridAdapterBase&, const MultiIndices&)> solve;
  std::function<FocalPoses(const HybridAdapterBase&)> solveFirst;
};

// Of every public function: what its body is.
std::vector<PublicSolver> publicSolvers() {
  std::vector<PublicSolver> result;
  for (const solvers::SolverRows& problem : solvers::minimalProblems()) {
    const bool twoLists = problem.rays() > 0 && problem.points() > 0;
    const auto solve = [=](const HybridAdapterBase& adapter, const MultiIndices& indices) {
      if (twoLists) return hybrid_pose::solve(problem, adapter, indices);
      return hybrid_pose::solve(problem, adapter, indices[problem.rays() > 0 ? 0 : 1]);
    };
    const auto solveFirst = [=](const HybridAdapterBase& adapter) { return hybrid_pose::solve(problem, adapter); };
    result.push_back({problem.name(), problem.rays(), problem.points(), twoLists, solve, solveFirst});
  }
  return result;
}

std::vector<int> upTo(int count) {
  std::vector<int> indices;
  for (int i = 0; i < count; ++i) indices.push_back(i);
  return indices;
}

// All rays of goodAdapter in an order whose first ones the solver takes: some want one of another camera behind those of the first.
std::vector<int> raysFor(const PublicSolver& solver) {
  std::vector<int> rays = upTo(12);
  if (solver.name == std::string("h60")) std::rotate(rays.begin() + solver.rays - 1, rays.end() - 1, rays.end());
  return rays;
}

std::vector<int> firstOf(std::vector<int> list, int count) {
  list.resize(static_cast<std::size_t>(count));
  return list;
}

TEST(Misuse, SolversRefuseWrongIndices) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  for (const PublicSolver& solver : publicSolvers()) {
    const MultiIndices good{firstOf(raysFor(solver), solver.rays), upTo(solver.points)};
    EXPECT_NO_THROW(solver.solve(adapter, good)) << solver.name;
    const auto available = {static_cast<int>(adapter.getNumberCorrespondences2d2d()),
                            static_cast<int>(adapter.getNumberCorrespondences2d3d())};
    for (std::size_t list = 0; list < 2; ++list) {
      if (good[list].empty()) continue;
      const std::string argument = solver.twoLists ? "indices[" + std::to_string(list) + "]" : "indices";
      const auto expectWrong = [&](const std::string& what, const std::vector<int>& indices) {
        MultiIndices wrong = good;
        wrong[list] = indices;
        expectRefused(solver.name + ", " + argument + " " + what, argument, [&] { solver.solve(adapter, wrong); });
      };
      expectWrong("empty", {});
      expectWrong("too few", upTo(static_cast<int>(good[list].size()) - 1));
      for (std::size_t place = 0; place < good[list].size(); ++place) {
        const int size = *(available.begin() + list);
        for (const int index : {-1, std::numeric_limits<int>::min(), size, std::numeric_limits<int>::max()}) {
          std::vector<int> indices = good[list];
          indices[place] = index;
          expectWrong("with " + std::to_string(index), indices);
        }
        for (std::size_t other = 0; other < place; ++other) {
          std::vector<int> indices = good[list];
          indices[place] = indices[other];
          expectWrong("repeated", indices);
        }
      }
    }
    if (!solver.twoLists) continue;
    for (const MultiIndices& lists : {MultiIndices{}, MultiIndices{good[0]}, MultiIndices{good[0], good[1], {}}})
      expectRefused(solver.name + " with " + std::to_string(lists.size()) + " lists", "indices",
                    [&] { solver.solve(adapter, lists); });
  }
}

// More indices than a solver needs are no error: the first ones are used.
TEST(Misuse, SolversUseTheFirstOfTooManyIndices) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  for (const PublicSolver& solver : publicSolvers()) {
    const FocalPoses expected = solver.solve(adapter, {firstOf(raysFor(solver), solver.rays), upTo(solver.points)});
    const FocalPoses poses = solver.solve(adapter, {raysFor(solver), upTo(8)});
    ASSERT_EQ(poses.size(), expected.size()) << solver.name;
    for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].position, expected[i].position) << solver.name;
  }
}

TEST(Misuse, SolversRefuseAdaptersWithTooFewCorrespondences) {
  const NoncentralHybridAdapter empty({}, {}, {}, {}, {}, {}, {});
  Random random(testSeed() + 801);
  for (const PublicSolver& solver : publicSolvers()) {
    expectRefused(solver.name, "indices", [&] { solver.solveFirst(empty); });
    if (solver.rays > 0) {
      const NoncentralHybridAdapter few = makeAdapter(makeMinimalProblem(random, {solver.rays - 1}, solver.points));
      expectRefused(solver.name, "indices", [&] { solver.solveFirst(few); });
    }
    if (solver.points > 0) {
      const NoncentralHybridAdapter few = makeAdapter(makeMinimalProblem(random, {solver.rays}, solver.points - 1));
      expectRefused(solver.name, "indices", [&] { solver.solveFirst(few); });
    }
  }
}

TEST(Misuse, H60RefusesOtherWaysToShareRays) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  for (const std::vector<int>& rays : {std::vector<int>{0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 10, 11}})
    expectRefused("h60", "indices: h60 needs 5 rays of one rig camera", [&] { hybrid_pose::h60(adapter, 1000, {rays, {}}); });
}

TEST(Misuse, SolversRefuseFocalLengthsThatAreNotPositiveAndFinite) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  for (const double value : {kNaN, kInfinite, -kInfinite, 0.0, -1.0}) {
    const std::string name = std::to_string(value);
    expectRefused("p3p " + name, "focalLength", [&] { absolute_pose::p3p(adapter, value); });
    expectRefused("p3p " + name, "focalLength", [&] { absolute_pose::p3p(adapter, value, {0, 1, 2}); });
    expectRefused("h22 " + name, "focalLength", [&] { hybrid_pose::h22(adapter, value); });
  }
}

TEST(Misuse, SolversRefuseNumbersThatAreNotFinite) {
  for (const PublicSolver& solver : publicSolvers()) {
    std::vector<WrongField> fields;
    if (solver.rays > 0) fields = wrongRayFields();
    const std::vector<WrongField> ofPoints = wrongPointFields();
    if (solver.points > 0) fields.insert(fields.end(), ofPoints.begin(), ofPoints.end());
    for (const WrongField& field : fields) {
      AlteredAdapter adapter;
      field.apply(adapter);
      expectRefused(solver.name + ", " + field.name, field.getter, [&] { solver.solveFirst(adapter); });
    }
  }
}

TEST(Misuse, OptimizeNonlinearRefusesWrongArguments) {
  const NoncentralHybridAdapter adapter = goodAdapter();
  const FocalPose start;
  const auto optimize = [&](const MultiIndices& indices) { hybrid_pose::optimize_nonlinear(adapter, indices, start); };
  EXPECT_NO_THROW(optimize({{}, {}}));
  for (const MultiIndices& lists : {MultiIndices{}, MultiIndices{{0}}, MultiIndices{{0}, {0}, {0}}})
    expectRefused(std::to_string(lists.size()) + " lists", "indices", [&] { optimize(lists); });
  for (const int index : {-1, std::numeric_limits<int>::min(), 12, std::numeric_limits<int>::max()}) {
    expectRefused("ray " + std::to_string(index), "indices[0]", [&] { optimize({{0, index}, {0}}); });
    expectRefused("point " + std::to_string(index), "indices[1]", [&] { optimize({{0}, {0, index}}); });
  }
  expectRefused("repeated ray", "indices[0]", [&] { optimize({{1, 2, 1}, {0}}); });
  expectRefused("repeated point", "indices[1]", [&] { optimize({{0}, {0, 1, 2, 3, 4, 5, 6, 7, 3}}); });
  for (const WrongPose& wrong : wrongPoses())
    expectRefused(wrong.name, "initial", [&] { hybrid_pose::optimize_nonlinear(adapter, wrong.pose); });
  std::vector<WrongField> fields = wrongRayFields();
  const std::vector<WrongField> ofPoints = wrongPointFields();
  fields.insert(fields.end(), ofPoints.begin(), ofPoints.end());
  for (const WrongField& field : fields) {
    AlteredAdapter altered;
    field.apply(altered);
    expectRefused(field.name, field.getter, [&] { hybrid_pose::optimize_nonlinear(altered, start); });
  }
  for (const double value : {kNaN, kInfinite, -1.0}) {
    AlteredAdapter altered;
    altered.rigFocalLength = value;
    expectRefused("rig focal length " + std::to_string(value), "getRigFocalLength(0)",
                  [&] { hybrid_pose::optimize_nonlinear(altered, start); });
  }
}

// The errors answer every number that is not finite by infinity, an outlier for any threshold.
TEST(Misuse, ResidualsOfNumbersThatAreNotFiniteAreInfinite) {
  Random random(testSeed() + 802);
  const FocalPose query = cameraLookingAtOrigin(random, 20, 1000), map = cameraLookingAtOrigin(random, 20, 1000);
  const Eigen::Vector3d image = project(query, Eigen::Vector3d::Zero()).homogeneous(), point = Eigen::Vector3d::Zero();
  const Eigen::Vector3d bearing(0, 0, 1);
  const auto reprojection = [&](const FocalPose& pose, const Eigen::Vector3d& p, const Eigen::Vector3d& x) {
    EXPECT_EQ(hybrid_pose::reprojectionError(pose, p, x), kInfinite);
  };
  const auto sampson = [&](const FocalPose& pose, const Eigen::Vector3d& p, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                           const Eigen::Matrix3d& r,
                           double g) { EXPECT_EQ(hybrid_pose::sampsonError(pose, p, b, c, r, g), kInfinite); };
  ASSERT_LT(hybrid_pose::reprojectionError(query, image, point), 1);
  ASSERT_LT(hybrid_pose::sampsonError(query, image, bearing, map.position, map.rotation, 1000), 1);

  for (const double value : notFinite()) {
    SCOPED_TRACE(value);
    for (int k = 0; k < 3; ++k) {
      SCOPED_TRACE(k);
      const auto with = [&](Eigen::Vector3d v) {
        v[k] = value;
        return v;
      };
      reprojection(query, with(image), point);
      reprojection(query, image, with(point));
      sampson(query, with(image), bearing, map.position, map.rotation, 1000);
      sampson(query, image, with(bearing), map.position, map.rotation, 1000);
      sampson(query, image, bearing, with(map.position), map.rotation, 1000);
      for (int j = 0; j < 3; ++j) {
        Eigen::Matrix3d rotation = map.rotation;
        rotation(j, k) = value;
        sampson(query, image, bearing, map.position, rotation, 1000);
      }
    }
    sampson(query, image, bearing, map.position, map.rotation, value);
    EXPECT_EQ(hybrid_pose::reprojectionError(query, value, image, point), kInfinite);
    EXPECT_EQ(hybrid_pose::sampsonError(query, value, image, bearing, map.position, map.rotation, 1000), kInfinite);
    expectRefused("distortion", "initialDistortion", [&] { hybrid_pose::optimize_nonlinear(goodAdapter(), FocalPose(), value); });
  }
  for (const WrongPose& wrong : wrongPoses()) {
    FocalPose pose = query;  // the wrong number in an otherwise good pose
    for (int k = 0; k < 3; ++k) {
      if (!std::isfinite(wrong.pose.position[k])) pose.position[k] = wrong.pose.position[k];
      for (int j = 0; j < 3; ++j)
        if (!std::isfinite(wrong.pose.rotation(j, k))) pose.rotation(j, k) = wrong.pose.rotation(j, k);
    }
    if (!std::isfinite(wrong.pose.focalLength)) pose.focalLength = wrong.pose.focalLength;
    if (pose.position.allFinite() && pose.rotation.allFinite() && std::isfinite(pose.focalLength)) continue;
    SCOPED_TRACE(wrong.name);
    reprojection(pose, image, point);
    sampson(pose, image, bearing, map.position, map.rotation, 1000);
  }
}

TEST(Misuse, UnknownSolverNamesAreRefused) {
  for (const char* name : {"", "H13F", "h13f ", "p5p", "sixpt_onefocal"})
    expectRefused(name, "solver", [&] { solverFromString(name); });
  for (const Solver solver : noSolvers()) {
    const std::string value = std::to_string(static_cast<int>(solver));
    expectRefused(value, "solver: no such value: " + value, [&] { toString(solver); });
  }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

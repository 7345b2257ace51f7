// H51f [5] and sixpt_onefocal: the same six epipolar constraints, with and without a point that fixes the scale.
#include <gtest/gtest.h>

#include <functional>

#include "FocalPoseNear.hpp"
#include "GoldenProblems.hpp"
#include "OneCentreProblems.hpp"

namespace hybridgv {
namespace test {
namespace {

class OneCentre : public testing::TestWithParam<OneCentreKind> {
 protected:
  OneCentreScene scene(Random& random) const { return {random, GetParam()}; }
};

INSTANTIATE_TEST_SUITE_P(, OneCentre, testing::Values(OneCentreKind::FiveRaysOnePoint, OneCentreKind::SixRays),
                         [](const auto& info) {
                           return info.param == OneCentreKind::FiveRaysOnePoint ? "FiveRaysOnePoint" : "SixRays";
                         });

constexpr double kRecovered = 1e-6;
constexpr double kSmallResidual = 1e-5;  // [px]

// What the contract says of every list of solutions.
void expectValid(const MinimalProblem& problem, const FocalPoses& solutions, const char* where, std::uint64_t index) {
  EXPECT_LE(solutions.size(), 9u) << where << " " << index;
  EXPECT_TRUE(areDistinct(solutions, 1e-9)) << where << " " << index;
  for (const FocalPose& pose : solutions) {
    EXPECT_LT(largestResidual(problem, pose, problem.points.size()), kSmallResidual)
        << where << " " << index << ", f " << pose.focalLength;
    if (problem.points.empty()) {
      EXPECT_NEAR((pose.position - problem.rays[0].centre).norm(), 1, 1e-12) << where << " " << index;
    }
  }
}

// Every solution of one list is in the other.
void expectContains(const FocalPoses& all, const FocalPoses& some, double tolerance, std::uint64_t index) {
  for (const FocalPose& pose : some)
    EXPECT_TRUE(hasFocalPoseNear(all, pose, tolerance)) << "problem " << index << ", f " << pose.focalLength;
}

TEST_P(OneCentre, FindsTheTruth) {
  constexpr std::uint64_t kCount = 5000;
  int recovered = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    Random random(testSeed(), i);
    const MinimalProblem problem = scene(random).problem();
    const FocalPoses solutions = solveOneCentre(problem);
    expectValid(problem, solutions, "generic", i);
    recovered += distanceToNearest(solutions, problem.truth) < kRecovered;
  }
  EXPECT_GE(recovered, kCount - 2);
}

TEST_P(OneCentre, SolvesAwkwardCases) {
  constexpr std::uint64_t kCount = 2000;
  for (const OneCentreAwkwardCase& test : oneCentreAwkwardCases()) {
    int failures = 0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      Random random(testSeed() + 1, i);
      const MinimalProblem problem = makeOneCentreProblem(random, GetParam(), test);
      const FocalPoses solutions = solveOneCentre(problem);
      expectValid(problem, solutions, test.name, i);
      failures += !(distanceToNearest(solutions, problem.truth) < kRecovered);
    }
    EXPECT_LE(failures, test.failuresAllowed) << test.name;
  }
}

// An independent method: Newton's iteration on the six epipolar constraints in rotation, baseline and log f, from random starts.
class MultiStart {
 public:
  explicit MultiStart(const MinimalProblem& problem) {
    for (const solvers::RayMatch& ray : problem.rays) add(ray.u, ray.v, ray.direction);
    for (const solvers::PointMatch& match : problem.points)
      add(match.u, match.v, (match.point - problem.rays[0].centre).normalized());
  }
  // True if it converged; R: calibrated camera -> query, t: its centre in the query's frame up to scale.
  bool run(Random& random, Eigen::Matrix3d& rotation, Eigen::Vector3d& t, double& f) const {
    rotation = random.rotation();
    t = random.direction();
    f = std::exp(random.uniform(-2, 2));
    for (int iteration = 0; iteration < 40; ++iteration) {
      const Vector6 r = residuals(rotation, t, f);
      Eigen::Matrix<double, 6, 6> jacobian;
      for (int i = 0; i < 6; ++i) {
        Vector6 step = Vector6::Zero();
        step[i] = 1e-7;
        Eigen::Matrix3d movedRotation = rotation;
        Eigen::Vector3d movedT = t;
        double movedF = f;
        move(step, movedRotation, movedT, movedF);
        jacobian.col(i) = (residuals(movedRotation, movedT, movedF) - r) / 1e-7;
      }
      Vector6 step = -jacobian.partialPivLu().solve(r);
      const double length = step.norm();
      if (!std::isfinite(length)) return false;
      if (length > 0.5) step *= 0.5 / length;
      move(step, rotation, t, f);
      if (length < 1e-10) return f > 1e-2 && f < 1e2;
    }
    return false;
  }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  void add(double u, double v, const Eigen::Vector3d& direction) {
    image_[count_] = Eigen::Vector3d(u / kImageScale, v / kImageScale, 1);
    direction_[count_++] = direction;
  }
  Vector6 residuals(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& t, double f) const {
    Vector6 r;
    for (int k = 0; k < 6; ++k) {
      const Eigen::Vector3d p(image_[k][0], image_[k][1], f);
      r[k] = p.normalized().dot(t.cross(rotation * direction_[k]));
    }
    return r;
  }
  static void move(const Vector6& step, Eigen::Matrix3d& rotation, Eigen::Vector3d& t, double& f) {
    const Eigen::Vector3d turn = step.head<3>();
    if (turn.norm() > 0) rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * rotation;
    const Eigen::Vector3d e1 = t.unitOrthogonal(), e2 = t.cross(e1);
    t = (t + step[3] * e1 + step[4] * e2).normalized();
    f *= std::exp(step[5]);
  }

 public:
  static constexpr double kImageScale = 1000;

 private:
  Eigen::Vector3d image_[6], direction_[6];
  int count_ = 0;
};

TEST(SixRays, FindsEverySolutionThatNewtonFindsFromRandomStarts) {
  int compared = 0;
  for (std::uint64_t i = 0; i < 30; ++i) {
    Random random(testSeed() + 2, i);
    const MinimalProblem problem = OneCentreScene(random, OneCentreKind::SixRays).problem();
    const FocalPoses solutions = solveOneCentre(problem);
    const MultiStart newton(problem);
    for (int start = 0; start < 200; ++start) {
      Eigen::Matrix3d rotation;
      Eigen::Vector3d t;
      double f = 1;
      if (!newton.run(random, rotation, t, f)) continue;
      for (double sign : {-1.0, 1.0}) {
        FocalPose pose;
        pose.rotation = rotation.transpose();
        pose.position = problem.rays[0].centre - sign * (pose.rotation * t);
        pose.focalLength = f * MultiStart::kImageScale;
        if (!(largestResidual(problem, pose, 0) < 1e-3)) continue;
        ++compared;
        EXPECT_TRUE(hasFocalPoseNear(solutions, pose, 1e-5)) << "problem " << i << ", f " << pose.focalLength;
      }
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(H51fOneCentre, FindsTheRecordedSolutions) {
  const std::vector<GoldenProblem> golden = readGoldenProblems("h51f_5.txt");
  if (golden.empty()) GTEST_SKIP() << "no recorded problems in " << HYBRIDGV_GOLDEN_DIR;
  std::size_t expected = 0, found = 0;
  for (std::size_t i = 0; i < golden.size(); ++i) {
    const FocalPoses solutions = solveOneCentre(golden[i].problem);
    expectValid(golden[i].problem, solutions, "golden", i);
    expected += golden[i].solutions.size();
    for (const FocalPose& solution : golden[i].solutions) found += distanceToNearest(solutions, solution) < 1e-5;
  }
  EXPECT_EQ(found, expected);
}

// The two lists hold the same solutions; `problem` is for the message.
void expectSame(const FocalPoses& a, const FocalPoses& b, std::uint64_t problem) {
  EXPECT_EQ(a.size(), b.size()) << "problem " << problem;
  expectContains(a, b, kRecovered, problem);
  expectContains(b, a, kRecovered, problem);
}

constexpr std::uint64_t kInvarianceCount = 200;

TEST_P(OneCentre, OrderOfTheRaysDoesNotMatter) {
  for (std::uint64_t i = 0; i < kInvarianceCount; ++i) {
    Random random(testSeed() + 3, i);
    const MinimalProblem problem = scene(random).problem();
    MinimalProblem permuted = problem;
    for (std::size_t k = permuted.rays.size() - 1; k > 0; --k)
      std::swap(permuted.rays[k], permuted.rays[static_cast<std::size_t>(random.index(static_cast<int>(k) + 1))]);
    expectSame(solveOneCentre(problem), solveOneCentre(permuted), i);
  }
}

TEST_P(OneCentre, ImageScaleOnlyScalesTheFocalLength) {
  for (double scale : {1e-3, 0.1, 30.0, 1e3})
    for (std::uint64_t i = 0; i < kInvarianceCount; ++i) {
      Random random(testSeed() + 4, i);
      const MinimalProblem problem = scene(random).problem();
      MinimalProblem scaled = problem;
      for (solvers::RayMatch& ray : scaled.rays) {
        ray.u *= scale;
        ray.v *= scale;
      }
      for (solvers::PointMatch& match : scaled.points) {
        match.u *= scale;
        match.v *= scale;
      }
      FocalPoses expected = solveOneCentre(problem);
      for (FocalPose& pose : expected) pose.focalLength *= scale;
      expectSame(expected, solveOneCentre(scaled), i);
    }
}

TEST_P(OneCentre, SimilarityOfTheRigMovesThePosesAlong) {
  for (double scale : {1e-3, 1.0, 1e4})
    for (std::uint64_t i = 0; i < kInvarianceCount; ++i) {
      Random random(testSeed() + 5, i);
      const MinimalProblem problem = scene(random).problem();
      const Eigen::Matrix3d rotation = random.rotation();
      const Eigen::Vector3d shift = scale * random.vector(-100, 100);
      const auto map = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d { return scale * (rotation * point) + shift; };
      MinimalProblem moved = problem;
      for (solvers::RayMatch& ray : moved.rays) {
        ray.centre = map(ray.centre);
        ray.direction = rotation * ray.direction;
      }
      for (solvers::PointMatch& match : moved.points) match.point = map(match.point);
      const FocalPoses solutions = solveOneCentre(problem), movedSolutions = solveOneCentre(moved);
      FocalPoses expected = solutions;
      for (FocalPose& pose : expected) pose.rotation = rotation * pose.rotation;
      expectSame(expected, movedSolutions, i);
      if (GetParam() == OneCentreKind::SixRays) continue;  // its baseline is always 1
      for (const FocalPose& pose : solutions) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const FocalPose& other : movedSolutions) nearest = std::min(nearest, (other.position - map(pose.position)).norm());
        EXPECT_LT(nearest, 1e-5 * scale) << "problem " << i;
      }
    }
}

TEST_P(OneCentre, RollOfTheQueryTurnsOnlyItsRotation) {
  for (std::uint64_t i = 0; i < kInvarianceCount; ++i) {
    Random random(testSeed() + 6, i);
    const MinimalProblem problem = scene(random).problem();
    const double angle = random.uniform(0, 2 * Random::kPi), c = std::cos(angle), s = std::sin(angle);
    MinimalProblem rolled = problem;
    const auto roll = [&](double& u, double& v) {
      const double u0 = u;
      u = c * u0 - s * v;
      v = s * u0 + c * v;
    };
    for (solvers::RayMatch& ray : rolled.rays) roll(ray.u, ray.v);
    for (solvers::PointMatch& match : rolled.points) roll(match.u, match.v);
    FocalPoses expected = solveOneCentre(problem);
    Eigen::Matrix3d rotation;
    rotation << c, s, 0, -s, c, 0, 0, 0, 1;
    for (FocalPose& pose : expected) pose.rotation = pose.rotation * rotation;
    expectSame(expected, solveOneCentre(rolled), i);
  }
}

TEST_P(OneCentre, DegenerateSamplesGiveNothing) {
  using Change = std::function<void(MinimalProblem&)>;
  const std::pair<const char*, Change> cases[] = {
      {"two equal correspondences", [](MinimalProblem& p) { p.rays[1] = p.rays[0]; }},
      {"all correspondences equal", [](MinimalProblem& p) { std::fill(p.rays.begin(), p.rays.end(), p.rays[0]); }},
      {"all image points at the principal point",
       [](MinimalProblem& p) {
         for (solvers::RayMatch& ray : p.rays) ray.u = ray.v = 0;
         for (solvers::PointMatch& match : p.points) match.u = match.v = 0;
       }},
      {"all image points equal",
       [](MinimalProblem& p) {
         for (solvers::RayMatch& ray : p.rays) {
           ray.u = p.rays[0].u;
           ray.v = p.rays[0].v;
         }
         for (solvers::PointMatch& match : p.points) {
           match.u = p.rays[0].u;
           match.v = p.rays[0].v;
         }
       }},
      {"all directions equal",
       [](MinimalProblem& p) {
         for (solvers::RayMatch& ray : p.rays) ray.direction = p.rays[0].direction;
         for (solvers::PointMatch& match : p.points) match.point = p.rays[0].centre + 3 * p.rays[0].direction;
       }},
      {"query at the common centre",
       [](MinimalProblem& p) {
         FocalPose query = p.truth;
         query.position = p.rays[0].centre;
         query.rotation.col(2) = -query.position.normalized();
         query.rotation.col(0) = query.rotation.col(2).unitOrthogonal();
         query.rotation.col(1) = query.rotation.col(2).cross(query.rotation.col(0));
         for (solvers::RayMatch& ray : p.rays) ray = makeRayMatch(query, ray.centre + 20 * ray.direction, ray.centre, 0);
         for (solvers::PointMatch& match : p.points) match = makePointMatch(query, match.point);
       }},
  };
  for (const auto& test : cases)
    for (std::uint64_t i = 0; i < 100; ++i) {
      Random random(testSeed() + 7, i);
      MinimalProblem problem = scene(random).problem();
      test.second(problem);
      EXPECT_TRUE(solveOneCentre(problem).empty()) << test.first << " " << i;
    }
}

TEST_P(OneCentre, SixCoplanarPointsGiveNothing) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Random random(testSeed() + 8, i);
    OneCentreScene coplanar = scene(random);
    coplanar.flatten(6, 0);
    EXPECT_TRUE(solveOneCentre(coplanar.problem()).empty()) << i;
  }
}

// Nothing is determined, or hardly; whatever comes back must be finite and satisfy the equations.
TEST_P(OneCentre, HardSamplesGiveValidSolutionsOrNone) {
  using Change = std::function<void(MinimalProblem&, Random&)>;
  const std::pair<const char*, Change> cases[] = {
      {"two equal image points", [](MinimalProblem& p, Random&) { p.rays[1].u = p.rays[0].u, p.rays[1].v = p.rays[0].v; }},
      {"two image points at the principal point",
       [](MinimalProblem& p, Random&) { p.rays[0].u = p.rays[0].v = p.rays[1].u = p.rays[1].v = 0; }},
      {"two equal directions", [](MinimalProblem& p, Random&) { p.rays[1].direction = p.rays[0].direction; }},
      {"image points on a line through the principal point",
       [](MinimalProblem& p, Random&) {
         for (solvers::RayMatch& ray : p.rays) ray.v = 2 * ray.u;
         for (solvers::PointMatch& match : p.points) match.v = 2 * match.u;
       }},
      {"unrelated data",
       [](MinimalProblem& p, Random& random) {
         for (solvers::RayMatch& ray : p.rays) {
           ray.direction = random.direction();
           ray.u = random.uniform(-500, 500);
           ray.v = random.uniform(-500, 500);
         }
       }},
      {"unrelated data of extreme scale",
       [](MinimalProblem& p, Random& random) {
         const double scale = std::pow(10.0, random.uniform(-100, 100));
         for (solvers::RayMatch& ray : p.rays) {
           ray.u *= scale;
           ray.v *= scale;
         }
         for (solvers::PointMatch& match : p.points) {
           match.u *= scale;
           match.v *= scale;
         }
       }},
  };
  for (const auto& test : cases)
    for (std::uint64_t i = 0; i < 300; ++i) {
      Random random(testSeed() + 9, i);
      MinimalProblem problem = scene(random).problem();
      test.second(problem, random);
      double size = 0;
      for (const solvers::RayMatch& ray : problem.rays) size = std::max({size, std::abs(ray.u), std::abs(ray.v)});
      for (const FocalPose& pose : solveOneCentre(problem))
        EXPECT_LT(largestResidual(problem, pose, problem.points.size()), 1e-7 * std::max(size, 1.0)) << test.first << " " << i;
    }
}

}  // namespace
}  // namespace test
}  // namespace hybridgv

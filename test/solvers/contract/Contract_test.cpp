// What every minimal solver promises for data in general position (MinimalSolver.hpp).
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "EquationCheck.hpp"
#include "SolverCases.hpp"

namespace hybridgv {
namespace test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kExtent = 20;  // size of the scenes
constexpr double kSame = 1e-6;  // two poses that differ by less are one

// Largest of the differences of rotation [rad], focal length (relative) and position (in units of `extent`).
double difference(const FocalPose& a, const FocalPose& b, double extent) {
  return std::max(poseDistance(a, b), (a.position - b.position).norm() / extent);
}

double distanceToNearest(const FocalPoses& poses, const FocalPose& pose, double extent) {
  double best = std::numeric_limits<double>::infinity();
  for (const FocalPose& other : poses) best = std::min(best, difference(other, pose, extent));
  return best;
}

// How many poses of each set the other lacks.
long countUnmatched(const FocalPoses& a, const FocalPoses& b, double extent) {
  const auto isAbsentFrom = [extent](const FocalPoses& set) {
    return [&set, extent](const FocalPose& pose) { return !(distanceToNearest(set, pose, extent) < kSame); };
  };
  return std::count_if(a.begin(), a.end(), isAbsentFrom(b)) + std::count_if(b.begin(), b.end(), isAbsentFrom(a));
}

// A change of the problem, and what it does to every solution.
struct Change {
  std::function<void(MinimalProblem&)> ofProblem = [](MinimalProblem&) {};
  std::function<FocalPose(const FocalPose&)> ofPose = [](const FocalPose& pose) { return pose; };
  double ofExtent = 1;
};

class Contract : public testing::TestWithParam<SolverCase> {
 protected:
  static std::uint64_t problems() { return GetParam().problems(200, 50); }
  static MinimalProblem problem(std::uint64_t i) {
    Random random(testSeed() + 700, i);
    return makeMinimalProblem(random, GetParam().raysPerCamera, GetParam().points);
  }

  // The true pose as the solver returns it.
  static FocalPose truth(const MinimalProblem& problem) {
    FocalPose pose = problem.truth;
    if (GetParam().isUpToScale) {
      const Vector3d& centre = problem.rays[0].centre;
      pose.position = centre + (pose.position - centre).normalized();
    }
    return pose;
  }

  // The solutions of the changed problem are the changed solutions of the problem; or at least the true one is.
  static void expectInvariance(std::uint64_t stream, bool ofAllSolutions,
                               const std::function<Change(Random&, const MinimalProblem&)>& makeChange) {
    long lost = 0;
    for (std::uint64_t i = 0; i < problems(); ++i) {
      Random random(testSeed() + stream, i);
      const MinimalProblem original = problem(i);
      const Change change = makeChange(random, original);
      MinimalProblem changed = original;
      change.ofProblem(changed);
      const FocalPoses found = GetParam().solutions(changed);
      const double extent = GetParam().isUpToScale ? 1 : kExtent * change.ofExtent;
      lost += !(distanceToNearest(found, change.ofPose(truth(original)), extent) < kSame);
      if (!ofAllSolutions) continue;
      FocalPoses expected = GetParam().solutions(original);
      for (FocalPose& pose : expected) pose = change.ofPose(pose);
      lost += countUnmatched(found, expected, extent);
    }
    EXPECT_LE(lost, GetParam().followsPaths ? 2 : 0);
  }
};

template <class ChangeImagePoint>
void forAllImagePoints(MinimalProblem& problem, const ChangeImagePoint& change) {
  for (solvers::RayMatch& ray : problem.rays) change(ray.u, ray.v);
  for (solvers::PointMatch& match : problem.points) change(match.u, match.v);
}

TEST_P(Contract, ExactDataAreRecovered) {
  int lost = 0;
  std::vector<double> errors;
  for (std::uint64_t i = 0; i < problems(); ++i) {
    const MinimalProblem example = problem(i);
    errors.push_back(distanceToNearest(GetParam().solutions(example), truth(example), kExtent));
    lost += !(errors.back() < 1e-8);
  }
  EXPECT_LE(lost, GetParam().followsPaths ? 1 : 0);
  std::nth_element(errors.begin(), errors.begin() + static_cast<long>(problems() / 2), errors.end());
  EXPECT_LT(errors[problems() / 2], 1e-13);
}

TEST_P(Contract, SolutionsSatisfyTheEquationsAndAreDifferent) {
  for (std::uint64_t i = 0; i < problems(); ++i) {
    const MinimalProblem example = problem(i);
    const EquationCheck equations(example.rays, example.points, GetParam().exactCoordinates);
    const FocalPoses poses = GetParam().solutions(example);
    for (const FocalPose& pose : poses) {
      EXPECT_EQ(equations.violation(pose), "") << i;
      EXPECT_LT(largestResidual(example, pose, GetParam().exactCoordinates / 2), 1e-6) << i;
      for (const FocalPose& other : poses) EXPECT_TRUE(&pose == &other || difference(pose, other, kExtent) > 1e-7) << i;
    }
  }
}

TEST_P(Contract, OrderOfCorrespondencesDoesNotMatter) {
  const auto shuffle = [](Random& random, auto& list, int count) {
    for (int k = count; k > 1; --k)
      std::swap(list[static_cast<std::size_t>(k - 1)], list[static_cast<std::size_t>(random.index(k))]);
  };
  expectInvariance(701, true, [&](Random& random, const MinimalProblem&) {
    Change change;
    change.ofProblem = [&random, &shuffle](MinimalProblem& problem) {
      shuffle(random, problem.rays, static_cast<int>(problem.rays.size()));
      shuffle(random, problem.points, GetParam().exchangeablePoints);
    };
    return change;
  });
}

TEST_P(Contract, SimilarityOfTheRigsFrameMovesThePosition) {
  for (const double scale : {1e-6, 0.3, 1e6}) {
    SCOPED_TRACE(scale);
    expectInvariance(702, true, [&](Random& random, const MinimalProblem& original) {
      const Matrix3d turn = random.rotation();
      const Vector3d shift = scale * random.vector(-100, 100);
      const auto move = [=](const Vector3d& x) { return Vector3d(scale * (turn * x) + shift); };
      Change change;
      change.ofExtent = scale;
      change.ofProblem = [=](MinimalProblem& problem) {
        for (solvers::RayMatch& ray : problem.rays) {
          ray.centre = move(ray.centre);
          ray.direction = turn * ray.direction;
        }
        for (solvers::PointMatch& match : problem.points) match.point = move(match.point);
      };
      change.ofPose = [=](const FocalPose& pose) {
        FocalPose result = pose;
        result.rotation = turn * pose.rotation;
        result.position = move(pose.position);
        if (GetParam().isUpToScale) {  // still at distance 1 from the centre
          const Vector3d& centre = original.rays[0].centre;
          result.position = move(centre) + turn * (pose.position - centre);
        }
        return result;
      };
      return change;
    });
  }
}

TEST_P(Contract, ScaleOfTheImageScalesTheFocalLength) {
  for (const double scale : {1e-6, 1e-3, 7.0, 1e6}) {
    SCOPED_TRACE(scale);
    expectInvariance(703, true, [scale](Random&, const MinimalProblem&) {
      Change change;
      change.ofProblem = [scale](MinimalProblem& problem) {
        forAllImagePoints(problem, [scale](double& u, double& v) { u *= scale, v *= scale; });
        problem.truth.focalLength *= scale;
      };
      change.ofPose = [scale](const FocalPose& pose) {
        FocalPose result = pose;
        result.focalLength *= scale;
        return result;
      };
      return change;
    });
  }
}

TEST_P(Contract, RotationAboutTheOpticalAxisRotatesTheQuery) {
  expectInvariance(704, GetParam().usesAllOfImage, [](Random& random, const MinimalProblem&) {
    const double angle = random.uniform(0, 2 * Random::kPi), c = std::cos(angle), s = std::sin(angle);
    Change change;
    change.ofProblem = [c, s](MinimalProblem& problem) {
      forAllImagePoints(problem, [c, s](double& u, double& v) {
        const double turned = c * u - s * v;
        v = s * u + c * v;
        u = turned;
      });
    };
    change.ofPose = [c, s](const FocalPose& pose) {
      Matrix3d roll;
      roll << c, -s, 0, s, c, 0, 0, 0, 1;
      FocalPose result = pose;
      result.rotation = pose.rotation * roll.transpose();
      return result;
    };
    return change;
  });
}

// To first order the error is proportional to the noise: what rounding adds is invisible beside a ten-millionth of a pixel.
TEST_P(Contract, ErrorGrowsInProportionToTheNoise) {
  // Rays alone bind the scale more loosely.
  const std::size_t most = GetParam().points > 0 || GetParam().isUpToScale ? 90 : 85;
  for (const double sigma : {1e-7, 1e-5, 1e-3, 0.1, 1.0}) {
    SCOPED_TRACE(sigma);
    std::vector<double> errors;
    for (std::uint64_t i = 0; i < problems(); ++i) {
      Random random(testSeed() + 705, i);
      MinimalProblem example = problem(i);
      forAllImagePoints(example, [&](double& u, double& v) { u += sigma * random.normal(), v += sigma * random.normal(); });
      errors.push_back(distanceToNearest(GetParam().solutions(example), truth(example), kExtent) / sigma);
    }
    std::sort(errors.begin(), errors.end());
    const double median = errors[problems() / 2];
    EXPECT_GT(median, 0.01);  // per pixel, at a focal length of some 1000 pixels
    EXPECT_LT(median, 0.25);
    EXPECT_LT(errors[problems() * most / 100], 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, Contract, testing::ValuesIn(solverCases()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace test
}  // namespace hybridgv

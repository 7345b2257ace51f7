// Adapters of a user's own that change their answers, count absurdly or contradict themselves.
#include "correspondences/readCorrespondence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "CheckArguments.hpp"
#include "HybridScene.hpp"
#include "correspondences/CorrespondenceArrays.hpp"
#include "hybridgv/absolute_pose/methods.hpp"
#include "hybridgv/hybrid_pose/methods.hpp"
#include "hybridgv/relative_pose/methods.hpp"
#include "hybridgv/sac/HybridRansac.hpp"
#include "hybridgv/sac_problems/hybrid_pose/HybridProblemCore.hpp"

namespace hybridgv {
namespace {

using sac_problems::hybrid_pose::HybridProblemCore;

test::HybridScene makeScene(std::uint64_t stream) {
  test::Random random(test::testSeed(), stream);
  test::SceneOptions options;
  options.rays = options.points = 40;
  options.imageNoise = 0.5;
  options.outlierShareRays = options.outlierSharePoints = 0.2;
  return test::makeHybridScene(random, options);
}

void expectRefused(const std::string& name, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "accepted, expected a message about " << name;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
  }
}

// Counts how often each getter is asked about each correspondence.
class CountingAdapter : public NoncentralHybridAdapter {
 public:
  using NoncentralHybridAdapter::NoncentralHybridAdapter;
  explicit CountingAdapter(const NoncentralHybridAdapter& data) : NoncentralHybridAdapter(data) {}

  Eigen::Vector3d getImagePoint2d2d(std::size_t i) const override {
    count("image2d2d", i);
    return NoncentralHybridAdapter::getImagePoint2d2d(i);
  }
  Eigen::Vector3d getBearingVector(std::size_t i) const override {
    count("bearing", i);
    return NoncentralHybridAdapter::getBearingVector(i);
  }
  Eigen::Matrix3d getCamRotation(std::size_t i) const override {
    count("rotation", i);
    return NoncentralHybridAdapter::getCamRotation(i);
  }
  Eigen::Vector3d getCamOffset(std::size_t i) const override {
    count("offset", i);
    return NoncentralHybridAdapter::getCamOffset(i);
  }
  double getWeight2d2d(std::size_t i) const override {
    count("weight2d2d", i);
    return NoncentralHybridAdapter::getWeight2d2d(i);
  }
  double getWeight2d3d(std::size_t i) const override {
    count("weight2d3d", i);
    return NoncentralHybridAdapter::getWeight2d3d(i);
  }
  Eigen::Vector3d getPoint(std::size_t i) const override {
    count("point", i);
    return NoncentralHybridAdapter::getPoint(i);
  }
  std::size_t getNumberCorrespondences2d2d() const override {
    count("number2d2d", 0);
    return NoncentralHybridAdapter::getNumberCorrespondences2d2d();
  }
  std::size_t getNumberCorrespondences2d3d() const override {
    count("number2d3d", 0);
    return NoncentralHybridAdapter::getNumberCorrespondences2d3d();
  }

  void expectEachAtMostOnce() const {
    for (const auto& entry : times_) EXPECT_EQ(entry.second, 1) << entry.first.first << " " << entry.first.second;
  }

 private:
  void count(const char* getter, std::size_t index) const { ++times_[{getter, index}]; }
  mutable std::map<std::pair<std::string, std::size_t>, int> times_;
};

TEST(ReadCorrespondence, EveryGetterIsAskedOnceForACorrespondence) {
  const NoncentralHybridAdapter data = makeScene(901).adapter();
  const std::pair<const char*, std::function<void(const CountingAdapter&)>> calls[] = {
      {"hybridRansac", [](const CountingAdapter& a) { sac::hybridRansac(a); }},
      {"optimize_nonlinear", [](const CountingAdapter& a) { hybrid_pose::optimize_nonlinear(a, FocalPose()); }},
      {"problem", [](const CountingAdapter& a) { HybridProblemCore(a, Solver::H51f, 4, 2); }},
      {"h51f", [](const CountingAdapter& a) { hybrid_pose::h51f(a); }},
      {"p4pf", [](const CountingAdapter& a) { absolute_pose::p4pf(a); }}};
  for (const auto& call : calls) {
    SCOPED_TRACE(call.first);
    const CountingAdapter adapter(data);
    call.second(adapter);
    adapter.expectEachAtMostOnce();
  }
}

// Another thread of the user appends to or removes from what the adapter holds.
class ChangingAdapter : public NoncentralHybridAdapter {
 public:
  ChangingAdapter(const NoncentralHybridAdapter& data, std::ptrdiff_t step) : NoncentralHybridAdapter(data), step_(step) {}
  std::size_t getNumberCorrespondences2d2d() const override {
    return changed(NoncentralHybridAdapter::getNumberCorrespondences2d2d());
  }
  std::size_t getNumberCorrespondences2d3d() const override {
    return changed(NoncentralHybridAdapter::getNumberCorrespondences2d3d());
  }

 private:
  // Starts in the middle, so that every answer is one that the adapter can keep at that moment.
  std::size_t changed(std::size_t all) const {
    const std::ptrdiff_t count = 20 + step_ * calls_++;
    return static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(std::max<std::ptrdiff_t>(count, 0), static_cast<std::ptrdiff_t>(all)));
  }
  std::ptrdiff_t step_;
  mutable std::ptrdiff_t calls_ = 0;
};

TEST(ReadCorrespondence, CountsThatChangeDuringACallDoNoHarm) {
  const NoncentralHybridAdapter data = makeScene(902).adapter();
  for (const std::ptrdiff_t step : {5, -5}) {
    const ChangingAdapter adapter(data, step);
    const sac::HybridRansacResult result = sac::hybridRansac(adapter);
    EXPECT_EQ(result.inliers2d2d.size(), 20u);
    EXPECT_EQ(result.inliers2d3d.size(), static_cast<std::size_t>(20 + step));
    const ChangingAdapter forProblem(data, step);
    const HybridProblemCore core(forProblem, Solver::H13f, 4, 2);
    EXPECT_EQ(core.size()[0], 20);
    EXPECT_EQ(core.size()[1], 20 + step);
    const ChangingAdapter forOptimization(data, step);
    EXPECT_NO_THROW(hybrid_pose::optimize_nonlinear(forOptimization, FocalPose()));
  }
}

class AbsurdAdapter : public NoncentralHybridAdapter {
 public:
  AbsurdAdapter(const NoncentralHybridAdapter& data, std::size_t rays, std::size_t points)
      : NoncentralHybridAdapter(data), rays_(rays), points_(points) {}
  std::size_t getNumberCorrespondences2d2d() const override { return rays_; }
  std::size_t getNumberCorrespondences2d3d() const override { return points_; }

 private:
  std::size_t rays_, points_;
};

TEST(ReadCorrespondence, AbsurdCountsAreRefused) {
  const NoncentralHybridAdapter data = makeScene(903).adapter();
  for (const std::size_t count : {std::size_t{1} << 31, std::size_t{1} << 32, std::numeric_limits<std::size_t>::max()})
    for (const bool ofRays : {true, false}) {
      const AbsurdAdapter adapter(data, ofRays ? count : 40, ofRays ? 40 : count);
      const std::string name = ofRays ? "getNumberCorrespondences2d2d" : "getNumberCorrespondences2d3d";
      expectRefused(name, [&] { sac::hybridRansac(adapter); });
      expectRefused(name, [&] { hybrid_pose::optimize_nonlinear(adapter, FocalPose()); });
      expectRefused(name, [&] { HybridProblemCore(adapter, Solver::H13f, 4, 2); });
      expectRefused(name, [&] { hybrid_pose::h13f(adapter); });
    }
  // Each can be counted, their sum cannot.
  const std::size_t half = std::size_t{1} << 30;
  expectRefused("flat indices", [&] { HybridProblemCore(AbsurdAdapter(data, half, half), Solver::H13f, 4, 2); });
}

class TurnedAdapter : public NoncentralHybridAdapter {
 public:
  TurnedAdapter(const NoncentralHybridAdapter& data, const Eigen::Matrix3d& change)
      : NoncentralHybridAdapter(data), change_(change) {}
  Eigen::Matrix3d getCamRotation(std::size_t i) const override { return NoncentralHybridAdapter::getCamRotation(i) * change_; }

 private:
  Eigen::Matrix3d change_;
};

TEST(ReadCorrespondence, ARotationIsOneToWithinTheToleranceHoweverItIsTested) {
  test::Random random(test::testSeed(), 906);
  for (const double size : {0., 1e-12, 1e-8, 9e-8, 1.1e-7, 3e-7, 1e-6, 3e-6, 1e-3})
    for (int i = 0; i < 200; ++i) {
      Eigen::Matrix3d matrix = random.rotation();
      for (int k = 0; k < 9; ++k) matrix.data()[k] += random.uniform(-size, size);
      if (i % 4 == 0) matrix.col(i % 3) *= -1;
      const double error = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
      EXPECT_EQ(isRotation(matrix), error < 1e-6 && matrix.determinant() > 0) << size;
    }
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  for (int k = 0; k < 9; ++k)
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      Eigen::Matrix3d damaged = matrix;
      damaged.data()[k] = value;
      EXPECT_FALSE(isRotation(damaged));
    }
}

TEST(ReadCorrespondence, ACamRotationThatIsNoRotationIsRefused) {
  const NoncentralHybridAdapter data = makeScene(904).adapter();
  const Eigen::Matrix3d scaled = 3 * Eigen::Matrix3d::Identity(), mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  for (const Eigen::Matrix3d& change : {scaled, mirror}) {
    const TurnedAdapter adapter(data, change);
    expectRefused("getCamRotation(", [&] { sac::hybridRansac(adapter); });
    expectRefused("getCamRotation(", [&] { hybrid_pose::optimize_nonlinear(adapter, FocalPose()); });
    expectRefused("getCamRotation(0)", [&] { HybridProblemCore(adapter, Solver::H13f, 4, 2); });
    expectRefused("getCamRotation(0)", [&] { hybrid_pose::h51f(adapter); });
    expectRefused("getCamRotation(0)", [&] { relative_pose::sixpt_onefocal(adapter); });
  }
  const Eigen::Matrix3d sevenDigits = Eigen::Matrix3d::Identity() * (1 + 1e-7);
  EXPECT_NO_THROW(hybrid_pose::h51f(TurnedAdapter(data, sevenDigits)));
}

// One index for all rays, or one for each: the centres decide.
class IndexedAdapter : public NoncentralHybridAdapter {
 public:
  IndexedAdapter(const NoncentralHybridAdapter& data, bool oneForAll) : NoncentralHybridAdapter(data), oneForAll_(oneForAll) {}
  int getCamIndex(std::size_t i) const override { return oneForAll_ ? 0 : static_cast<int>(i); }

 private:
  bool oneForAll_;
};

TEST(ReadCorrespondence, WrongCameraIndicesDoNotMatter) {
  const test::HybridScene scene = makeScene(905);
  const NoncentralHybridAdapter data = scene.adapter();
  // A sample with outliers may have no solution.
  int first = 0;
  const auto sample = [&] { return std::vector<std::vector<int>>{{first, first + 1, first + 2, first + 3, first + 4}, {first}}; };
  FocalPoses expected = hybrid_pose::h51f(data, sample());
  for (; expected.empty() && first < 30; expected = hybrid_pose::h51f(data, sample())) ++first;
  ASSERT_FALSE(expected.empty());
  for (const bool oneForAll : {true, false}) {
    const IndexedAdapter adapter(data, oneForAll);
    const FocalPoses poses = hybrid_pose::h51f(adapter, sample());
    ASSERT_EQ(poses.size(), expected.size());
    for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].position, expected[i].position);
    EXPECT_NO_THROW(relative_pose::sixpt_onefocal(adapter, {0, 5, 10, 15, 20, 25}));
    const sac::HybridRansacResult result = sac::hybridRansac(adapter);
    EXPECT_TRUE(result.success) << toString(result.failureReason);
    EXPECT_LT((result.pose.position - scene.truth.position).norm(), 0.5);
  }
}

// Sees how many threads read it at a time.
class WatchingAdapter : public NoncentralHybridAdapter {
 public:
  WatchingAdapter(const NoncentralHybridAdapter& data, bool allowsConcurrentReads)
      : NoncentralHybridAdapter(data), allows_(allowsConcurrentReads) {}
  bool allowsConcurrentReads() const override { return allows_; }
  Eigen::Vector3d getPoint(std::size_t i) const override {
    const int inside = ++inside_;
    for (int most = most_; inside > most && !most_.compare_exchange_weak(most, inside);) continue;
    if (allows_ && i < 3000) std::this_thread::yield();
    --inside_;
    return NoncentralHybridAdapter::getPoint(i);
  }
  int mostAtATime() const { return most_; }

 private:
  bool allows_;
  mutable std::atomic<int> inside_{0}, most_{0};
};

NoncentralHybridAdapter manyCorrespondences() {
  test::Random random(test::testSeed(), 905);
  test::SceneOptions options;
  options.rays = 3000;
  options.points = 5000;
  options.imageNoise = 1;
  options.outlierShareRays = options.outlierSharePoints = 0.2;
  return test::makeHybridScene(random, options).adapter();
}

sac::HybridRansacResult runWithThreads(const hybrid_pose::HybridAdapterBase& adapter, int threads) {
  sac::HybridRansacOptions options;
  options.threads = threads;
  return sac::hybridRansac(adapter, options);
}

TEST(ReadCorrespondence, OneThreadAtATimeUnlessTheAdapterAllowsMore) {
  const NoncentralHybridAdapter data = manyCorrespondences();
  EXPECT_TRUE(data.allowsConcurrentReads());
  const sac::HybridRansacResult alone = runWithThreads(data, 1);
  ASSERT_TRUE(alone.success);
  for (const bool allows : {false, true}) {
    const WatchingAdapter adapter(data, allows);
    const sac::HybridRansacResult result = runWithThreads(adapter, 4);
    EXPECT_EQ(result.pose.position, alone.pose.position) << allows;
    EXPECT_EQ(result.covariance, alone.covariance) << allows;
    if (!allows) {
      EXPECT_EQ(adapter.mostAtATime(), 1);
    }
  }
}

// A derived class may have getters of which the base knows nothing.
TEST(ReadCorrespondence, DerivedAdaptersAreReadByOneThreadUnlessTheySayOtherwise) {
  const NoncentralHybridAdapter data = manyCorrespondences();
  EXPECT_FALSE(CountingAdapter(data).allowsConcurrentReads());
  EXPECT_TRUE(WatchingAdapter(data, true).allowsConcurrentReads());
}

class FaultyAdapter : public NoncentralHybridAdapter {
 public:
  explicit FaultyAdapter(const NoncentralHybridAdapter& data) : NoncentralHybridAdapter(data) {}
  bool allowsConcurrentReads() const override { return true; }
  Eigen::Vector3d getPoint(std::size_t i) const override {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return i % 50 == 7 ? Eigen::Vector3d(nan, 0, 0) : NoncentralHybridAdapter::getPoint(i);
  }
};

TEST(ReadCorrespondence, TheSameFaultIsReportedWhateverTheNumberOfThreads) {
  const FaultyAdapter adapter(manyCorrespondences());
  const auto message = [&](int threads) -> std::string {
    try {
      runWithThreads(adapter, threads);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string expected = message(1);
  EXPECT_NE(expected.find("getPoint"), std::string::npos) << expected;
  for (int round = 0; round < 20; ++round) EXPECT_EQ(message(2 + round % 3), expected);
}

}  // namespace
}  // namespace hybridgv

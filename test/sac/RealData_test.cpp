// hybridRansac on real sparse models: every photo in turn is left out of its map and localized against the rest.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace {

struct Errors {
  double focalPercent, rotationDeg;
};

Errors errorsOf(const NoncentralHybridAdapter& adapter, const FocalPose& reference) {
  const sac::HybridRansacResult result = sac::hybridRansac(adapter);
  if (!result.success) return {1e9, 1e9};
  const double halfSine = std::min(1.0, (result.pose.rotation - reference.rotation).norm() / std::sqrt(8.0));
  return {100 * std::abs(result.pose.focalLength / reference.focalLength - 1), 2 * std::asin(halfSine) * 180 / M_PI};
}

NoncentralHybridAdapter pointsOnly(const NoncentralHybridAdapter& adapter) {
  std::vector<Eigen::Vector3d> imagePoints, points;
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i)
    imagePoints.push_back(adapter.getImagePoint2d3d(i)), points.push_back(adapter.getPoint(i));
  return {{}, {}, {}, {}, {}, imagePoints, points};
}

class RealModel : public testing::Test {
 protected:
  // Localizes every registered photo; `hybrid` and `points2d3d` are the errors with all matches and with the 2D-3D ones alone.
  void localizeAll(const std::string& file, double outlierShare) {
    const std::string path = std::string(HYBRIDGV_REALDATA_DIR) + "/" + file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
    const sfm::SparseModel model = sfm::readModel(path);
    for (std::size_t i = 0; i < model.images.size(); ++i) {
      if (!model.images[i].registered) continue;
      const sfm::LocalizationProblem problem = sfm::injectOutliers(sfm::makeLocalizationProblem(model, i), outlierShare, i);
      hybrid.push_back(errorsOf(problem.adapter, *problem.reference));
      points2d3d.push_back(errorsOf(pointsOnly(problem.adapter), *problem.reference));
    }
  }
  int within(double focalPercent, double rotationDeg) const {
    return static_cast<int>(std::count_if(hybrid.begin(), hybrid.end(), [&](const Errors& e) {
      return e.focalPercent <= focalPercent && e.rotationDeg <= rotationDeg;
    }));
  }
  int hybridNotWorse() const {
    int count = 0;
    for (std::size_t i = 0; i < hybrid.size(); ++i) count += hybrid[i].focalPercent <= points2d3d[i].focalPercent;
    return count;
  }
  static double medianFocal(std::vector<Errors> errors) {
    std::sort(errors.begin(), errors.end(), [](const Errors& a, const Errors& b) { return a.focalPercent < b.focalPercent; });
    return errors[errors.size() / 2].focalPercent;
  }

  std::vector<Errors> hybrid, points2d3d;
};

TEST_F(RealModel, BalbianelloWithAThirdOfTheMatchesWrong) {
  localizeAll("balbianello/Balbianello.out", 0.3);
  if (IsSkipped()) return;
  EXPECT_EQ(hybrid.size(), 5u);
  EXPECT_EQ(within(1, 0.5), 5);
}

TEST_F(RealModel, KermitGainsFromRaysInNearlyEveryPhoto) {
  localizeAll("kermit/bundle.out", 0);
  if (IsSkipped()) return;
  EXPECT_EQ(hybrid.size(), 9u);
  EXPECT_GE(within(2, 1), 8);
  EXPECT_GE(hybridNotWorse(), 7);
}

TEST_F(RealModel, KermitWithHalfOfTheMatchesWrong) {
  localizeAll("kermit/bundle.out", 0.5);
  if (IsSkipped()) return;
  EXPECT_LT(medianFocal(hybrid), medianFocal(points2d3d));
}

TEST_F(RealModel, Crane) {
  localizeAll("crane", 0);
  if (IsSkipped()) return;
  EXPECT_EQ(hybrid.size(), 8u);
  EXPECT_GE(within(1, 0.5), 7);
}

}  // namespace
}  // namespace hybridgv

#include "hybridgv/types.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "hybridgv/detail/format.hpp"
#include "misuse/Misuse.hpp"

namespace hybridgv {
namespace {

TEST(Solver, NamesAreTheInverseOfEachOther) {
  for (const Solver solver : allSolvers()) EXPECT_EQ(solverFromString(toString(solver)), solver);
}

TEST(Solver, AllAreTheEnumeratorsInTheirOrder) {
  const std::vector<Solver> all = allSolvers();
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(static_cast<std::size_t>(all[i]), i);
  for (const Solver solver : {Solver::P4Pf, Solver::P35Pf, Solver::H13f, Solver::H32f, Solver::H51f, Solver::H70f, Solver::P3P,
                              Solver::H22, Solver::H41, Solver::H60})
    EXPECT_TRUE(std::count(all.begin(), all.end(), solver)) << static_cast<int>(solver);
}

TEST(Solver, UnknownNameListsTheValidOnes) {
  try {
    solverFromString("h99f");
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("h99f"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("p35pf"), std::string::npos);
  }
}

TEST(Version, OfTheHeadersIsThatOfTheLibrary) { EXPECT_STREQ(version(), HYBRIDGV_VERSION_STRING); }

TEST(FocalPose, TransformationIsRotationAndPosition) {
  FocalPose pose;
  pose.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  pose.position << 1, 2, 3;
  const Eigen::Matrix<double, 3, 4> transformation = pose.transformation();
  EXPECT_EQ(Eigen::Matrix3d(transformation.leftCols<3>()), pose.rotation);
  EXPECT_EQ(Eigen::Vector3d(transformation.col(3)), pose.position);
}

// A point of the rig is seen at the same place whichever way the pose is written.
TEST(FocalPose, CamFromWorldIsTheInverseTransformation) {
  FocalPose pose;
  pose.rotation = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized())).toRotationMatrix();
  pose.position << 1, 2, -3;
  const CamFromWorld inverse = pose.camFromWorld();
  const Eigen::Vector3d point(0.4, -1.5, 6);
  EXPECT_LT((inverse.rotation * point + inverse.translation - pose.rotation.transpose() * (point - pose.position)).norm(), 1e-14);
}

TEST(FocalPose, ThereAndBackFromCamFromWorld) {
  const Eigen::Matrix3d rotation = (Eigen::AngleAxisd(2, Eigen::Vector3d(-1, 0.3, 2).normalized())).toRotationMatrix();
  const Eigen::Vector3d translation(-4, 0.2, 7);
  const FocalPose pose = FocalPose::fromCamFromWorld(rotation, translation, 812.5);
  EXPECT_EQ(pose.focalLength, 812.5);
  EXPECT_EQ(pose.camFromWorld().rotation, rotation);
  EXPECT_LT((pose.camFromWorld().translation - translation).norm(), 1e-14);
  EXPECT_LT((rotation * pose.position + translation).norm(), 1e-14);  // the centre is the origin of the query's frame
}

TEST(FocalPose, FromCamFromWorldRefusesWhatIsNoPose) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const auto make = [](const Eigen::Matrix3d& R, const Eigen::Vector3d& t, double f) {
    return [=] { FocalPose::fromCamFromWorld(R, t, f); };
  };
  Eigen::Matrix3d notANumber = identity;
  notANumber(1, 2) = test::kNaN;
  test::expectRefused("3 I", "worldToCamera: must be a rotation matrix, is [3, 0, 0; 0, 3, 0; 0, 0, 3]",
                      make(3 * identity, zero, 1));
  test::expectRefused("-I", "worldToCamera", make(-identity, zero, 1));
  test::expectRefused("NaN", "worldToCamera", make(notANumber, zero, 1));
  test::expectRefused("NaN", "translation: must be finite, is (0, nan, 0)", make(identity, {0, test::kNaN, 0}, 1));
  for (double f : {0.0, -1e-9, test::kNaN, test::kInfinite}) {
    const std::string shown = detail::format(f);
    test::expectRefused(shown, "focalLength: must be positive and finite, is " + shown, make(identity, zero, f));
  }
}

}  // namespace
}  // namespace hybridgv

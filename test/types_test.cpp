#include "hybridgv/types.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace hybridgv {
namespace {

TEST(Solver, NamesAreTheInverseOfEachOther) {
  for (const Solver solver : allSolvers()) EXPECT_EQ(solverFromString(toString(solver)), solver);
}

TEST(Solver, AllAreTheEnumeratorsInTheirOrder) {
  const std::vector<Solver> all = allSolvers();
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(static_cast<std::size_t>(all[i]), i);
  for (const Solver solver : {Solver::P4Pf, Solver::P35Pf, Solver::H13f, Solver::H32f, Solver::H51f})
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

}  // namespace
}  // namespace hybridgv

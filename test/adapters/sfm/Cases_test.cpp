// A folder of files as users have them (HYBRIDGV_CASES_DIR), each with its right result; skipped where that folder is absent. The
// same kinds of faults, made here, are in MendedFiles_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"
#include "hybridgv/adapters/sfm/ModelFiles.hpp"
#include "hybridgv/sac/HybridRansac.hpp"

namespace hybridgv {
namespace sfm {
namespace {

const std::string kFolder = HYBRIDGV_CASES_DIR;

class Cases : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(kFolder)) GTEST_SKIP() << "no folder " << kFolder;
  }
};

// Every image with an image plane is left out in turn and localized.
void expectFocalErrorsBelow(const SparseModel& model, double percent, std::size_t first = 0) {
  for (std::size_t i = first; i < model.images.size(); ++i) {
    if (!model.images[i].registered) continue;
    const LocalizationProblem problem = makeLocalizationProblem(model, i);
    const sac::HybridRansacResult result = sac::hybridRansac(problem.adapter, {});
    ASSERT_TRUE(result.success) << problem.imageName;
    EXPECT_LT(std::abs(result.pose.focalLength / problem.reference->focalLength - 1) * 100, percent) << problem.imageName;
  }
}

SparseModel readCase(const std::string& name, const std::vector<Mend>& mends) {
  ReadReport report;
  SparseModel model = readModel(kFolder + "/" + name, {}, &report);
  for (std::size_t i = 0; i < kMendCount; ++i)
    EXPECT_EQ(report.counts[i] > 0, std::count(mends.begin(), mends.end(), static_cast<Mend>(i)) > 0)
        << name << ": " << toString(static_cast<Mend>(i));
  return model;
}

TEST_F(Cases, NvmOriginAtCornerIsCorrected) {
  expectFocalErrorsBelow(readCase("nvm_origin_at_corner.nvm", {Mend::OriginOfImagePositions}), 0.2);
}

TEST_F(Cases, FisheyeMapsServePhonePhotos) { expectFocalErrorsBelow(readCase("camera_opencv_fisheye", {}), 1, 5); }

TEST_F(Cases, FullOpenCvMapsServePhonePhotos) { expectFocalErrorsBelow(readCase("camera_full_opencv", {}), 1, 5); }

TEST_F(Cases, TracksThatNameARemovedImage) {
  expectFocalErrorsBelow(readCase("track_names_removed_image", {Mend::TrackOfMissingImage}), 1);
}

TEST_F(Cases, TracksWithWrongObservationNumbers) {
  const SparseModel model =
      readCase("track_observation_numbers_wrong", {Mend::TrackWithWrongNumber, Mend::ObservationNotInTrack});
  expectFocalErrorsBelow(model, 0.7);
}

TEST_F(Cases, ProjectFolder) { expectFocalErrorsBelow(readCase("project_folder", {}), 0.7); }

TEST_F(Cases, BundlerViewInACameraWithoutPose) {
  expectFocalErrorsBelow(readCase("bundler_view_in_camera_without_pose.out", {Mend::TrackOfUnregisteredImage}), 1);
}

TEST_F(Cases, BundlerOneInfinitePoint) {
  expectFocalErrorsBelow(readCase("bundler_one_infinite_point.out", {Mend::PointNotFinite}), 0.7);
}

TEST_F(Cases, NvmWithMatrices) { expectFocalErrorsBelow(readCase("nvm_r9t.nvm", {}), 0.7); }

TEST_F(Cases, NamesInLatin1) { expectFocalErrorsBelow(readCase("names_latin1", {}), 1); }

TEST_F(Cases, WhatIsNoMapIsRefusedWithWords) {
  for (const auto& [name, words] : {std::make_pair("not_a_map.json", "JSON"), std::make_pair("empty.out", "the file is empty")}) {
    EXPECT_FALSE(isProblemFile(kFolder + "/" + name));
    try {
      readModel(kFolder + "/" + name);
      ADD_FAILURE() << name;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace sfm
}  // namespace hybridgv

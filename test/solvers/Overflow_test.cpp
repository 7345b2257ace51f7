// Data near the largest double: whatever is returned is finite.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hybridgv/absolute_pose/methods.hpp"
#include "hybridgv/adapters/NoncentralHybridAdapter.hpp"

namespace hybridgv {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

// Found by the fuzzer: a pose of this sample has a focal length beyond the largest double.
TEST(Overflow, PosesAreFinite) {
  const double huge = 1.1282369829523429e306;
  const NoncentralHybridAdapter adapter(
      {}, {}, {}, {}, {}, Vectors{{348.6935987385065, 280.4840684679563, 1}, {-huge, 4.7e-5, 1}, {1e-200, -huge, 1}, {0, 0, 1}},
      Vectors{{-724.9462577456243, -3.9141207902030537, 1e-200},
              {-725.323154305343, -3.9141207902030537, 1e-200},
              {-4.768371582031246e-05, 1.042663852061283e-309, 0},
              {0, 0, 0}});
  for (const FocalPose& pose : absolute_pose::p4pf(adapter)) {
    EXPECT_TRUE(pose.rotation.allFinite() && pose.position.allFinite());
    EXPECT_TRUE(std::isfinite(pose.focalLength)) << pose.focalLength;
  }
}

}  // namespace
}  // namespace hybridgv

// 5. A map on disk: every image of a COLMAP, Bundler or NVM model in turn is the query image, localized against the others.
//    usage: 05_colmap_map [MAP]
#include <hybridgv/adapters/sfm/LocalizationProblem.hpp>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/sac/HybridRansac.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
  const hybridgv::sfm::SparseModel map = hybridgv::sfm::readModel(argc > 1 ? argv[1] : HYBRIDGV_DEFAULT_MAP);
  for (std::size_t i = 0; i < map.images.size(); ++i) {
    if (!map.images[i].registered) continue;
    // Leave-one-out: the query image's own observations are taken out of the map before its points are triangulated.
    const hybridgv::sfm::LocalizationProblem problem = hybridgv::sfm::makeLocalizationProblem(map, i);
    const hybridgv::sac::HybridRansacResult result = hybridgv::sac::hybridRansac(problem.adapter);
    if (!result.success) {
      std::printf("%-20s not localized: %s\n", problem.imageName.c_str(), toString(result.failureReason));
      continue;
    }
    std::printf("%-20s focal length %8.2f px (the map says %8.2f), %3d 2D-2D and %3d 2D-3D inliers", problem.imageName.c_str(),
                result.pose.focalLength, problem.reference->focalLength, result.numberInliers2d2d, result.numberInliers2d3d);
    const hybridgv::CamFromWorld query = result.pose.camFromWorld();  // the pair that COLMAP's images.txt holds
    std::printf(", translation %.3f %.3f %.3f\n", query.translation[0], query.translation[1], query.translation[2]);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}

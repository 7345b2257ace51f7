#include "sac_problems/hybrid_pose/CopiedCorrespondences.hpp"

#include "correspondences/readCorrespondence.hpp"

namespace hybridgv {
namespace sac_problems {
namespace hybrid_pose {

// The solvers and the sampling ask whether rays share a centre: a camera is its centre here.
static void numberByCentre(std::vector<correspondences::RayMatch>& rays) {
  std::vector<Eigen::Vector3d> centres;
  for (correspondences::RayMatch& ray : rays) {
    std::size_t camera = 0;
    while (camera < centres.size() && centres[camera] != ray.centre) ++camera;
    if (camera == centres.size()) centres.push_back(ray.centre);
    ray.camera = static_cast<int>(camera);
  }
}

CopiedCorrespondences::CopiedCorrespondences(const HybridAdapterBase& adapter) {
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d2d(); ++i) {
    rays_.push_back(correspondences::readRay(adapter, static_cast<int>(i)));
    bearingVectors_.push_back(adapter.getBearingVector(i));
    camRotations_.push_back(adapter.getCamRotation(i));
    rigFocalLengths_.push_back(adapter.getRigFocalLength(i));
    weights2d2d_.push_back(adapter.getWeight2d2d(i));
  }
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i) {
    points_.push_back(correspondences::readPoint(adapter, static_cast<int>(i)));
    weights2d3d_.push_back(adapter.getWeight2d3d(i));
  }
  numberByCentre(rays_);
}

}  // namespace hybrid_pose
}  // namespace sac_problems
}  // namespace hybridgv

// 2. Data that you already hold in OpenGV's adapters: wrapped, not copied by hand, and solved by gp3p (focal length known) and by
//    H13f (unknown) side by side.
#include <hybridgv/adapters/OpenGVHybridAdapter.hpp>
#include <hybridgv/hybrid_pose/methods.hpp>

#include <cstdio>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#include <opengv/relative_pose/NoncentralRelativeAdapter.hpp>

int main() {
  // The query is at (0.5, -0.2, -1) and looks along +z. Its true focal length is 1.1 times the one that its bearing vectors were
  // formed with (900 px).
  const opengv::translation_t position(0.5, -0.2, -1);
  const double nominal = 900, truth = 990;
  const auto bearing = [&](const opengv::point_t& point) {
    const opengv::point_t y = point - position;
    return opengv::bearingVector_t(truth * y[0] / y[2], truth * y[1] / y[2], nominal).normalized();
  };
  const opengv::points_t points{{-1, -1, 6}, {1.5, -0.5, 5}, {0.3, 1.2, 7}};
  const opengv::bearingVectors_t queryOfPoints{bearing(points[0]), bearing(points[1]), bearing(points[2])};
  const opengv::point_t fourth(1, 0.5, 6);

  // OpenGV's adapters: viewpoint 1 is the rig (camera 0, at (2, 0, 0)), viewpoint 2 the query (camera 1, in its own origin).
  const opengv::translations_t offsets{{2, 0, 0}, {0, 0, 0}};
  const opengv::rotations_t rotations(2, opengv::rotation_t::Identity());
  const opengv::bearingVectors_t rigRays{(fourth - offsets[0]).normalized()}, queryOfRays{bearing(fourth)};
  const std::vector<int> rigCameras{0}, queryCameras{1};
  opengv::relative_pose::NoncentralRelativeAdapter relative(rigRays, queryOfRays, rigCameras, queryCameras, offsets, rotations);
  opengv::absolute_pose::CentralAbsoluteAdapter absolute(queryOfPoints, points);

  // [readme]
  const hybridgv::OpenGVHybridAdapter adapter(relative, absolute, /*nominalFocalLength=*/900);
  for (const hybridgv::FocalPose& pose : hybridgv::hybrid_pose::h13f(adapter)) {
    const opengv::transformation_t transformation = pose.transformation();  // [rotation | position], as gp3p returns it
    std::printf("H13f  position %7.4f %7.4f %7.4f, focal length %.2f px\n", transformation(0, 3), transformation(1, 3),
                transformation(2, 3), pose.focalLength);
  }
  // [readme]
  for (const opengv::transformation_t& transformation : opengv::absolute_pose::gp3p(absolute))
    std::printf("gp3p  position %7.4f %7.4f %7.4f, focal length assumed %.2f px\n", transformation(0, 3), transformation(1, 3),
                transformation(2, 3), nominal);
}

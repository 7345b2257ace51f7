// The minimal solvers on arrays.
#include <hybridgv/absolute_pose/methods.hpp>
#include <hybridgv/adapters/NoncentralHybridAdapter.hpp>
#include <hybridgv/hybrid_pose/methods.hpp>
#include <hybridgv/relative_pose/methods.hpp>

#include <algorithm>

#include "Module.hpp"
#include "Values.hpp"

namespace hybridgv {
namespace python {
namespace {

Vectors imagePointsOf(const char* name, const py::object& points) {
  const DoubleArray rows = rowsOf(name, points, 2);
  Vectors result;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) result.emplace_back(rows.data()[2 * i], rows.data()[2 * i + 1], 1);
  return result;
}

struct Points {
  Vectors images, positions;
};

Points pointsOf(const py::object& points2D, const py::object& points3D) {
  Points points{imagePointsOf("points2D", points2D), vectorsOf(rowsOf("points3D", points3D, 3))};
  checkCount("points3D", static_cast<py::ssize_t>(points.positions.size()), "points2D",
             static_cast<py::ssize_t>(points.images.size()));
  return points;
}

struct Rays {
  Vectors images, directions, origins;
};

Rays raysOf(const py::object& points2D, const py::object& directions, const py::object& origins) {
  Rays rays{imagePointsOf("points2D_rays", points2D), vectorsOf(rowsOf("ray_directions", directions, 3)),
            vectorsOf(rowsOf("ray_origins", origins, 3))};
  const auto count = static_cast<py::ssize_t>(rays.images.size());
  checkCount("ray_directions", static_cast<py::ssize_t>(rays.directions.size()), "points2D_rays", count);
  checkCount("ray_origins", static_cast<py::ssize_t>(rays.origins.size()), "points2D_rays", count);
  return rays;
}

// Rays with equal origins share a camera.
NoncentralHybridAdapter adapterOf(const Rays& rays, const Points& points) {
  Vectors centres;
  std::vector<int> cameras;
  for (const Eigen::Vector3d& origin : rays.origins) {
    const auto found = std::find(centres.begin(), centres.end(), origin);
    cameras.push_back(static_cast<int>(found - centres.begin()));
    if (found == centres.end()) centres.push_back(origin);
  }
  const std::vector<Eigen::Matrix3d> rotations(centres.size(), Eigen::Matrix3d::Identity());
  return {rays.images, rays.directions, cameras, centres, rotations, points.images, points.positions};
}

template <class Solve>
py::list solve(const NoncentralHybridAdapter& adapter, const Solve& solver) {
  FocalPoses poses;
  {
    const py::gil_scoped_release release;
    poses = solver(adapter);
  }
  py::list list;
  for (const FocalPose& pose : poses) list.append(tupleOf(pose));
  return list;
}

using PointSolver = FocalPoses (*)(const hybrid_pose::HybridAdapterBase&);

void addPointSolver(py::module_& module, const char* name, PointSolver solver) {
  const auto call = [solver](const py::object& points2D, const py::object& points3D) {
    return solve(adapterOf({}, pointsOf(points2D, points3D)), solver);
  };
  module.def(name, call, py::arg("points2D"), py::arg("points3D"));
}

void addHybridSolver(py::module_& module, const char* name, PointSolver solver) {
  const auto call = [solver](const py::object& points2D, const py::object& points3D, const py::object& points2DRays,
                             const py::object& directions, const py::object& origins) {
    return solve(adapterOf(raysOf(points2DRays, directions, origins), pointsOf(points2D, points3D)), solver);
  };
  module.def(name, call, py::arg("points2D"), py::arg("points3D"), py::arg("points2D_rays"), py::arg("ray_directions"),
             py::arg("ray_origins"));
}

void addRaySolver(py::module_& module, const char* name, PointSolver solver) {
  const auto call = [solver](const py::object& points2DRays, const py::object& directions, const py::object& origins) {
    return solve(adapterOf(raysOf(points2DRays, directions, origins), {}), solver);
  };
  module.def(name, call, py::arg("points2D_rays"), py::arg("ray_directions"), py::arg("ray_origins"));
}

py::list p3p(const py::object& points2D, const py::object& points3D, double focalLength) {
  const auto solver = [focalLength](const NoncentralHybridAdapter& adapter) { return absolute_pose::p3p(adapter, focalLength); };
  return solve(adapterOf({}, pointsOf(points2D, points3D)), solver);
}

using CalibratedSolver = FocalPoses (*)(const hybrid_pose::HybridAdapterBase&, double);

void addCalibratedHybridSolver(py::module_& module, const char* name, CalibratedSolver solver) {
  const auto call = [solver](const py::object& points2D, const py::object& points3D, const py::object& points2DRays,
                             const py::object& directions, const py::object& origins, double focalLength) {
    return solve(adapterOf(raysOf(points2DRays, directions, origins), pointsOf(points2D, points3D)),
                 [=](const NoncentralHybridAdapter& adapter) { return solver(adapter, focalLength); });
  };
  module.def(name, call, py::arg("points2D"), py::arg("points3D"), py::arg("points2D_rays"), py::arg("ray_directions"),
             py::arg("ray_origins"), py::arg("focal_length"));
}

void addCalibratedRaySolver(py::module_& module, const char* name, CalibratedSolver solver) {
  const auto call = [solver](const py::object& points2DRays, const py::object& directions, const py::object& origins,
                             double focalLength) {
    return solve(adapterOf(raysOf(points2DRays, directions, origins), {}),
                 [=](const NoncentralHybridAdapter& adapter) { return solver(adapter, focalLength); });
  };
  module.def(name, call, py::arg("points2D_rays"), py::arg("ray_directions"), py::arg("ray_origins"), py::arg("focal_length"));
}

}  // namespace

void addSolvers(py::module_& module) {
  addPointSolver(module, "p4pf", &absolute_pose::p4pf);
  addPointSolver(module, "p35pf", &absolute_pose::p35pf);
  module.def("p3p", &p3p, py::arg("points2D"), py::arg("points3D"), py::arg("focal_length"));
  addHybridSolver(module, "h13f", &hybrid_pose::h13f);
  addHybridSolver(module, "h32f", &hybrid_pose::h32f);
  addHybridSolver(module, "h51f", &hybrid_pose::h51f);
  addCalibratedHybridSolver(module, "h22", &hybrid_pose::h22);
  addCalibratedHybridSolver(module, "h41", &hybrid_pose::h41);
  addCalibratedRaySolver(module, "h60", &hybrid_pose::h60);
  addCalibratedRaySolver(module, "fivept", &relative_pose::fivept);
  addRaySolver(module, "h70f", &hybrid_pose::h70f);
  addRaySolver(module, "sixpt_onefocal", &relative_pose::sixpt_onefocal);
}

}  // namespace python
}  // namespace hybridgv

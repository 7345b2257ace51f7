#include "Options.hpp"

#include <pybind11/stl.h>

#include <functional>
#include <stdexcept>

namespace hybridgv {
namespace python {
namespace {

using sfm::QueryOptions;

// An option: its names in Python and in the library, how it is set and read.
struct OptionRow {
  std::string name, nameInLibrary;
  std::function<void(QueryOptions&, const py::object&)> set;
  std::function<py::object(QueryOptions&)> get;
};

template <class T>
OptionRow row(const char* name, const char* nameInLibrary, T& (*place)(QueryOptions&)) {
  return {name, nameInLibrary, [place](QueryOptions& o, const py::object& value) { place(o) = value.cast<T>(); },
          [place](QueryOptions& o) { return py::cast(place(o)); }};
}

// A row of an option that has the same name in both.
#define HYBRIDGV_OPTION(T, name, path, member) row<T>(name, #member, [](QueryOptions& o) -> T& { return o.path member; })

sac::Scoring scoringOf(const std::string& name) {
  if (name == "msac") return sac::Scoring::Msac;
  if (name == "inlier_count") return sac::Scoring::InlierCount;
  throw std::invalid_argument("option 'scoring' must be 'msac' or 'inlier_count', is '" + name + "'");
}

sac::Sampling samplingOf(const std::string& name) {
  if (name == "quality_ordered") return sac::Sampling::QualityOrdered;
  if (name == "uniform") return sac::Sampling::Uniform;
  throw std::invalid_argument("option 'sampling' must be 'quality_ordered' or 'uniform', is '" + name + "'");
}

// {name: weight}, or a list of names that have equal weights.
std::vector<sac::SolverPrior> solversOf(const py::object& value) {
  std::vector<sac::SolverPrior> solvers;
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [name, prior] : value.cast<py::dict>())
      solvers.push_back({solverFromString(name.cast<std::string>()), prior.cast<double>()});
  } else {
    for (const std::string& name : value.cast<std::vector<std::string>>()) solvers.push_back({solverFromString(name), 1.0});
  }
  return solvers;
}

py::object dictOf(const std::vector<sac::SolverPrior>& solvers) {
  py::dict dict;
  for (const sac::SolverPrior& solver : solvers) dict[toString(solver.solver)] = solver.prior;
  return std::move(dict);
}

std::optional<FocalPose> poseOf(const py::object& pose) {
  if (pose.is_none()) return std::nullopt;
  FocalPose result;
  result.rotation = matrixOf("initial_pose.rotation", pose.attr("rotation"));
  result.position = vectorOf("initial_pose.position", pose.attr("position"));
  result.focalLength = pose.attr("focal_length").cast<double>();
  return result;
}

// The options that are no numbers.
void addNamedOptions(std::vector<OptionRow>& rows) {
  rows.push_back({"scoring", "scoring",
                  [](QueryOptions& o, const py::object& v) { o.ransac.scoring = scoringOf(v.cast<std::string>()); },
                  [](QueryOptions& o) { return py::str(o.ransac.scoring == sac::Scoring::Msac ? "msac" : "inlier_count"); }});
  rows.push_back(
      {"sampling", "sampling",
       [](QueryOptions& o, const py::object& v) { o.ransac.sampling = samplingOf(v.cast<std::string>()); },
       [](QueryOptions& o) { return py::str(o.ransac.sampling == sac::Sampling::Uniform ? "uniform" : "quality_ordered"); }});
  rows.push_back({"solvers", "solvers",
                  [](QueryOptions& o, const py::object& v) {
                    if (!v.is_none()) o.ransac.solvers = solversOf(v);
                  },
                  [](QueryOptions& o) { return dictOf(o.ransac.solvers); }});
  rows.push_back(
      {"initial_pose", "initialPose", [](QueryOptions& o, const py::object& v) { o.ransac.initialPose = poseOf(v); },
       [](QueryOptions& o) { return o.ransac.initialPose ? py::object(tupleOf(*o.ransac.initialPose)) : py::none(); }});
}

std::vector<OptionRow> makeRows() {
  std::vector<OptionRow> rows{
      HYBRIDGV_OPTION(double, "max_reproj_error", ransac., maxReprojectionErrorPx),
      HYBRIDGV_OPTION(double, "max_epipolar_error", ransac., maxEpipolarErrorPx),
      HYBRIDGV_OPTION(double, "success_probability", ransac., successProbability),
      HYBRIDGV_OPTION(int, "min_iterations", ransac., minIterations),
      HYBRIDGV_OPTION(int, "max_iterations", ransac., maxIterations),
      HYBRIDGV_OPTION(double, "time_budget", ransac., timeBudgetSeconds),
      HYBRIDGV_OPTION(double, "max_focal_length_deviation", ransac., maxFocalLengthDeviation),
      HYBRIDGV_OPTION(double, "min_focal_length", ransac., minFocalLength),
      HYBRIDGV_OPTION(double, "max_focal_length", ransac., maxFocalLength),
      HYBRIDGV_OPTION(double, "principal_point_deviation", ransac., principalPointDeviationPx),
      HYBRIDGV_OPTION(double, "image_radius", ransac., imageRadiusPx),
      HYBRIDGV_OPTION(double, "distortion_scale", ransac., distortionScale),
      HYBRIDGV_OPTION(double, "distortion_evidence", ransac., distortionEvidence),
      HYBRIDGV_OPTION(std::vector<double>, "distortion_hypotheses", ransac., distortionHypotheses),
      HYBRIDGV_OPTION(bool, "local_optimization", ransac., localOptimization),
      HYBRIDGV_OPTION(bool, "final_optimization", ransac., finalOptimization),
      HYBRIDGV_OPTION(std::uint64_t, "seed", ransac., seed),
      HYBRIDGV_OPTION(int, "threads", ransac., threads),
      HYBRIDGV_OPTION(bool, "radial", , estimateDistortion),
      HYBRIDGV_OPTION(double, "prior_deviation", , priorDeviation),
      HYBRIDGV_OPTION(int, "min_inliers", , minInliers),
      HYBRIDGV_OPTION(double, "min_inlier_share", , minInlierShare),
      HYBRIDGV_OPTION(double, "min_parallax_deg", matches., minParallaxDeg),
      HYBRIDGV_OPTION(double, "max_map_reproj_error", matches., maxMapReprojectionErrorPx),
      HYBRIDGV_OPTION(bool, "rays_beside_points", matches., raysBesidePoints),
  };
  addNamedOptions(rows);
  return rows;
}

#undef HYBRIDGV_OPTION

// Never destroyed: Python may end before the library does.
const std::vector<OptionRow>& allRows() {
  static const auto* rows = new std::vector<OptionRow>(makeRows());
  return *rows;
}

const OptionRow& findRow(const std::string& name) {
  std::string names;
  for (const OptionRow& row : allRows()) {
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + row.name;
  }
  throw std::invalid_argument("there is no option '" + name + "', valid are " + names);
}

}  // namespace

QueryOptions optionsOf(const py::dict& options) {
  QueryOptions result;
  for (const auto& [key, value] : options) {
    const OptionRow& row = findRow(py::str(key).cast<std::string>());
    try {
      row.set(result, py::reinterpret_borrow<py::object>(value));
    } catch (const py::cast_error&) {
      throw std::invalid_argument("option '" + row.name + "' cannot be " + py::repr(value).cast<std::string>());
    }
  }
  return result;
}

py::dict dictOf(QueryOptions options) {
  py::dict dict;
  for (const OptionRow& row : allRows()) dict[row.name.c_str()] = row.get(options);
  return dict;
}

// (A name that is the start of another one stands behind it in the table.)
std::string withPythonNames(std::string message) {
  for (const OptionRow& row : allRows()) {
    const std::size_t place = message.find(row.nameInLibrary);
    if (place != std::string::npos) message.replace(place, row.nameInLibrary.size(), row.name);
  }
  return message;
}

}  // namespace python
}  // namespace hybridgv

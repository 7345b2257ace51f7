#include "Localize.hpp"

#include <hybridgv/adapters/sfm/ransacOptions.hpp>

#include <algorithm>
#include <stdexcept>

#include "LocalizeArguments.hpp"
#include "LocalizeQueries.hpp"
#include "LocalizeTable.hpp"
#include "common/CommandLine.hpp"
#include "common/ProgressBar.hpp"

namespace program {
namespace {

using hybridgv::FocalPose;
using hybridgv::NoncentralHybridAdapter;
using hybridgv::sac::HybridRansacOptions;
using hybridgv::sfm::LocalizationProblem;

Localization localize(const NoncentralHybridAdapter& adapter, const std::optional<FocalPose>& reference,
                      const HybridRansacOptions& options) {
  Localization localization{hybridRansac(adapter, options), {}};
  if (!reference || !localization.result.success) return localization;
  FocalPose pose = localization.result.pose;
  pose.focalLength = localization.result.simpleRadialFocalLength;  // as the map's programs mean it
  localization.error = poseError(pose, *reference);
  return localization;
}

NoncentralHybridAdapter pointsOnly(const NoncentralHybridAdapter& adapter) {
  std::vector<Eigen::Vector3d> imagePoints, points;
  for (std::size_t i = 0; i < adapter.getNumberCorrespondences2d3d(); ++i) {
    imagePoints.push_back(adapter.getImagePoint2d3d(i));
    points.push_back(adapter.getPoint(i));
  }
  return {{}, {}, {}, {}, {}, imagePoints, points};
}

Row localizeBothWays(LocalizationProblem problem, const LocalizeArguments& arguments) {
  if (arguments.outlierShare > 0) problem = injectOutliers(problem, arguments.outlierShare, arguments.ransac.seed);
  HybridRansacOptions options = ransacOptions(problem, arguments.ransac);
  if (arguments.queryCamera == "pinhole") options.queryCamera = hybridgv::sac::QueryCamera::Pinhole;
  if (arguments.focalLength == "prior" && problem.reference) options.focalLengthPriorPx = problem.reference->focalLength;
  HybridRansacOptions p35pf = options;
  p35pf.solvers = {{options.knownFocalLengthPx ? hybridgv::Solver::P3P : hybridgv::Solver::P35Pf, 1.0}};
  const Localization hybrid = localize(problem.adapter, problem.reference, options);
  const Localization reference = localize(pointsOnly(problem.adapter), problem.reference, p35pf);
  return {std::move(problem), hybrid, reference};
}

// A page shows one map.
void checkPage(const LocalizeArguments& arguments, const std::vector<Query>& queries) {
  const auto isOfThatMap = [&](const Query& query) { return query.map && query.map == queries.front().map; };
  if (arguments.page.areWanted() && !std::all_of(queries.begin(), queries.end(), isOfThatMap))
    throw std::invalid_argument("--html_path and --ply_path show the images of one map");
}

void run(const LocalizeArguments& arguments) {
  const std::vector<Query> queries = collectQueries(arguments);
  if (queries.empty()) throw std::invalid_argument("nothing to localize");
  checkPage(arguments, queries);
  std::vector<hybridgv::report::ReportedImage> reported;
  ProgressBar progress(queries.size(), !arguments.quiet);
  Summary hybrid, pointsOnly;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    progress.show(i);
    const Row row = localizeBothWays(queries[i].make(), arguments);
    if (arguments.page.areWanted())
      addImage(reported, hybridgv::report::reportedImage(*queries[i].map, queries[i].image, row.problem, row.hybrid.result));
    hybrid.add(row.hybrid);
    pointsOnly.add(row.pointsOnly);
    progress.clear();
    if (!arguments.json && i == 0) printHeader();
    if (arguments.json)
      printJson(row);
    else
      printRow(row);
    flushOutput();
  }
  if (arguments.page.areWanted()) writePageFiles(arguments.page, *queries.front().map, reported);
  if (arguments.json) return;
  hybrid.print("hybrid");
  pointsOnly.print("2D-3D only");
  flushOutput();
}

}  // namespace

int runLocalize(std::vector<std::string> arguments) {
  LocalizeArguments parsed;
  const int exitCode = parseLocalize(std::move(arguments), parsed);
  if (exitCode >= 0) return exitCode;
  run(parsed);
  return 0;
}

}  // namespace program

#include "RegistratorArguments.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "ColmapOptions.hpp"
#include "common/CommandLine.hpp"

namespace program {
namespace {

bool isThreads(int value) { return value == -1 || value > 0; }

void addPaths(CLI::App& app, RegistratorArguments& a, std::string& project) {
  app.add_option("--database_path", a.database, "COLMAP's database with the features and matches of all images")->required();
  app.add_option("--input_path", a.input, "the map: a folder with COLMAP's model (cameras, images, points3D)")->required();
  app.add_option("--output_path", a.output, "folder for the map with the new images; may be the same as the input");
  app.add_option("--image_list_path", a.imageList,
                 "file with the names of the images to register, one a line; - is the standard input (default: all images of the "
                 "database that the map lacks)");
  app.add_option("--project_path", project, "COLMAP's project file: key=value lines, [Mapper] before its options");
  app.add_option("--output_type", a.outputType, "files of the new map, binary or text")
      ->check(CLI::IsMember({"BIN", "TXT"}))
      ->capture_default_str();
  app.add_option("--results_path", a.results, "also write the poses to this file: NAME QW QX QY QZ TX TY TZ a line");
  app.add_option("--json_path", a.json, "also write one JSON object per image and line; - is the standard output");
  addPageOptions(app, a.page);
}

void addMapperOptions(CLI::App& app, RegistratorArguments& a, int& minMatches, int& threads) {
  addNumber(app, "--Mapper.min_num_matches", minMatches, "matches that a pair of images needs", "an integer, not negative",
            isNotNegativeInteger);
  addSwitch(app, "--Mapper.ignore_watermarks", a.queries.ignoreWatermarks, "leave out pairs that share a watermark only");
  addNumber(app, "--Mapper.abs_pose_max_error", a.registration.localization.ransac.maxReprojectionErrorPx,
            "inlier threshold of 2D-3D matches [px]", "positive and finite", isPositive);
  addNumber(app, "--max_epipolar_error", a.registration.localization.ransac.maxEpipolarErrorPx,
            "inlier threshold of 2D-2D matches, Sampson error [px]", "positive and finite", isPositive);
  addNumber(app, "--Mapper.abs_pose_min_num_inliers", a.registration.localization.minInliers,
            "inliers of both kinds that an image needs", "an integer, not negative", isNotNegativeInteger);
  addNumber(app, "--Mapper.abs_pose_min_inlier_ratio", a.registration.localization.minInlierShare,
            "share of inliers that an image needs", "from 0 to 1", isShare);
  addSwitch(app, "--Mapper.abs_pose_refine_focal_length", a.registration.estimateFocalLength,
            "find the focal length; 0: the cameras of the database are right");
  addSwitch(app, "--Mapper.abs_pose_refine_extra_params", a.registration.localization.estimateDistortion,
            "find the lens distortion");
  addNumber(app, "--Mapper.min_focal_length_ratio", a.registration.minFocalRatio,
            "smallest focal length, of the image's longer side", "positive and finite", isPositive);
  addNumber(app, "--Mapper.max_focal_length_ratio", a.registration.maxFocalRatio,
            "largest focal length, of the image's longer side", "positive and finite", isPositive);
  addNumber(app, "--Mapper.max_extra_param", a.registration.maxDistortion, "largest distortion |k1|", "positive and finite",
            isPositive);
  addNumber(app, "--Mapper.num_threads", threads, "threads, -1 = all cores", "-1 (all cores) or a positive integer", isThreads);
}

void addOwnOptions(CLI::App& app, RegistratorArguments& a, std::string& matches) {
  app.add_option("--matches", matches, "the verified matches (two_view_geometries) or the raw ones (matches)")
      ->check(CLI::IsMember({"two_view_geometries", "matches"}))
      ->capture_default_str();
  addNumber(app, "--principal_point_deviation", a.registration.localization.ransac.principalPointDeviationPx,
            "how far principal points may be off, standard deviation [px]: allowed for in those of the results",
            "finite and not negative", isNotNegative);
  addSwitch(app, "--radial", a.registration.localization.estimateDistortion, "the same as --Mapper.abs_pose_refine_extra_params");
  addSwitch(app, "--same_camera", a.queries.useCamerasOfMap, "images whose camera the map has are taken with it as it is");
  addSwitch(app, "--require_all", a.requireAll, "exit with code 3 if an image was not registered");
  addSeed(app, "--seed", a.registration.localization.ransac.seed, "seed of everything random");
  app.add_flag("--quiet", a.quiet, "no table, no progress bar, no notes");
}

// Empty, or what does not fit together.
std::string findContradiction(const RegistratorArguments& a) {
  namespace fs = std::filesystem;
  if (a.output.empty() && a.results.empty() && a.json.empty() && !a.page.areWanted())
    return "--output_path is required (or --results_path, --json_path, --html_path, --ply_path)";
  if (!(a.registration.minFocalRatio < a.registration.maxFocalRatio))
    return "--Mapper.min_focal_length_ratio must be below --Mapper.max_focal_length_ratio";
  if (!a.output.empty() && a.outputType == "TXT" && fs::exists(fs::path(a.output) / "images.bin"))
    return "--output_type TXT: " + a.output + " holds a binary model, which would hide the one in text";
  return findContradiction(a.page);
}

}  // namespace

int parseRegistrator(std::vector<std::string> arguments, RegistratorArguments& parsed) {
  CLI::App app{
      "Registers images of a COLMAP database in a map whose images they match, with unknown focal length and distortion, from "
      "2D-2D and\n"
      "2D-3D matches together. Takes the options of COLMAP's image_registrator; options of COLMAP that mean nothing here are "
      "accepted.\n",
      "hybridgv image_registrator"};
  std::string project, matches = "two_view_geometries";
  int minMatches = static_cast<int>(parsed.queries.minMatches), threads = -1;
  parsed.registration.localization.minInliers = 30;
  parsed.registration.localization.minInlierShare = 0.25;
  addPaths(app, parsed, project);
  addMapperOptions(app, parsed, minMatches, threads);
  addOwnOptions(app, parsed, matches);
  app.footer(
      "Exit codes: 0 success, 1 a file cannot be read or written, 2 wrong usage, 3 --require_all and an image was not "
      "registered,\n"
      "130 interrupted (what was registered until then is written; the same command on the output continues).");
  insertProjectFile(arguments);
  const std::vector<std::string> unused = takeUnusedOptions(arguments);
  const int exitCode = parse(app, std::move(arguments));
  if (exitCode >= 0) return exitCode;
  if (!parsed.quiet)
    for (const std::string& name : unused) std::fprintf(stderr, "hybridgv: not used: --%s\n", name.c_str());
  parsed.registration.threads = std::max(threads, 0);
  parsed.queries.minMatches = static_cast<std::size_t>(minMatches);
  if (matches == "matches") parsed.queries.table = hybridgv::sfm::MatchTable::Raw;
  const std::string contradiction = findContradiction(parsed);
  if (contradiction.empty()) return -1;
  std::fprintf(stderr, "hybridgv: %s\n", contradiction.c_str());
  return kWrongUsage;
}

}  // namespace program

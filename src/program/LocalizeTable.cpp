#include "LocalizeTable.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "common/CommandLine.hpp"
#include "common/Statistics.hpp"

namespace program {
namespace {

using hybridgv::FocalPose;
using hybridgv::NoncentralHybridAdapter;
using hybridgv::sac::HybridRansacResult;
using Json = nlohmann::ordered_json;

constexpr std::size_t kNameWidth = 13;

std::string share(int inliers, std::size_t all) { return std::to_string(inliers) + "/" + std::to_string(all); }

void printErrors(const std::optional<PoseError>& error) {
  if (error)
    std::printf(" %5.2f %5.3f %7.4f", error->focalPercent, error->rotationDeg, error->position);
  else
    std::printf(" %5s %5s %7s", "-", "-", "-");
}

// k1, its deviation, and what the map says.
void printDistortion(const Row& row) {
  const HybridRansacResult& result = row.hybrid.result;
  if (result.success)
    std::printf(" %6.3f %5.3f", result.simpleRadialK1, result.simpleRadialK1StandardDeviation);
  else
    std::printf(" %6s %5s", "-", "-");
  if (row.problem.referenceK1)
    std::printf(" %6.3f", *row.problem.referenceK1);
  else
    std::printf(" %6s", "-");
}

// Of the 2D-3D matches alone: the error, or without a reference the focal length.
void printPointsOnly(const Localization& localization) {
  if (!localization.result.success)
    std::printf(" failed\n");
  else if (localization.error)
    std::printf(" %6.2f\n", localization.error->focalPercent);
  else
    std::printf(" %6.0f\n", localization.result.simpleRadialFocalLength);
}

void printFocalLength(const HybridRansacResult& result) {
  if (result.success)
    std::printf(" %6.1f", result.simpleRadialFocalLength);
  else
    std::printf(" %6s", "failed");
}

Json toJson(const Localization& localization) {
  const HybridRansacResult& result = localization.result;
  Json json{{"success", result.success}};
  if (!result.success) json["failure_reason"] = toString(result.failureReason);
  if (result.success) {
    const FocalPose& pose = result.pose;
    json["focal_length_px"] = result.simpleRadialFocalLength;
    json["focal_length_std_px"] = result.focalLengthStandardDeviation;
    json["radial_k"] = result.simpleRadialK1;
    json["radial_k_std"] = result.simpleRadialK1StandardDeviation;
    json["rotation_query_to_rig"] = std::vector<double>(pose.rotation.data(), pose.rotation.data() + 9);  // column by column
    json["position"] = std::vector<double>(pose.position.data(), pose.position.data() + 3);
  }
  json["inliers_2d2d"] = result.numberInliers2d2d;
  json["inliers_2d3d"] = result.numberInliers2d3d;
  json["iterations"] = result.iterations;
  if (localization.error) {
    json["focal_error_percent"] = localization.error->focalPercent;
    json["rotation_error_deg"] = localization.error->rotationDeg;
    json["position_error"] = localization.error->position;
  }
  json["seconds"] = result.seconds;
  return json;
}

}  // namespace

void printHeader() {
  std::printf("%-13s %6s | %6s %5s %5s %5s %7s %6s %5s %6s %7s %7s | %s\n", "", "", "hybrid", "", "", "", "", "", "", "",
              "inliers", "inliers", "2D-3D");
  std::printf("%-13s %6s | %6s %5s %5s %5s %7s %6s %5s %6s %7s %7s | %6s\n", "query", "f ref", "f px", "+- px", "df %", "dR",
              "dpos", "k1", "+-", "k1 ref", "2D-2D", "2D-3D", "df %");
}

void printRow(const Row& row) {
  const HybridRansacResult& hybrid = row.hybrid.result;
  const NoncentralHybridAdapter& adapter = row.problem.adapter;
  std::printf("%-13s", shortened(row.problem.imageName, kNameWidth).c_str());
  if (row.problem.reference)
    std::printf(" %6.1f |", row.problem.reference->focalLength);
  else
    std::printf(" %6s |", "-");
  printFocalLength(hybrid);
  if (hybrid.success)
    std::printf(" %5.1f", hybrid.focalLengthStandardDeviation);
  else
    std::printf(" %5s", "-");
  printErrors(row.hybrid.error);
  printDistortion(row);
  std::printf(" %7s %7s |", share(hybrid.numberInliers2d2d, adapter.getNumberCorrespondences2d2d()).c_str(),
              share(hybrid.numberInliers2d3d, adapter.getNumberCorrespondences2d3d()).c_str());
  printPointsOnly(row.pointsOnly);
}

void printJson(const Row& row) {
  Json json{{"query", row.problem.imageName},
            {"matches_2d2d", row.problem.adapter.getNumberCorrespondences2d2d()},
            {"matches_2d3d", row.problem.adapter.getNumberCorrespondences2d3d()}};
  if (row.problem.reference) json["reference_focal_length_px"] = row.problem.reference->focalLength;
  if (row.problem.referenceK1) json["reference_radial_k"] = *row.problem.referenceK1;
  json["hybrid"] = toJson(row.hybrid);
  json["points_only"] = toJson(row.pointsOnly);
  // Names need not be UTF-8, of which JSON consists.
  std::printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

void Summary::add(const Localization& localization) {
  ++queries_;
  if (localization.result.success) ++successes_;
  milliseconds_.push_back(1e3 * localization.result.seconds);
  if (!localization.error) return;
  focal_.push_back(std::abs(localization.error->focalPercent));
  rotation_.push_back(localization.error->rotationDeg);
  position_.push_back(localization.error->position);
}

void Summary::print(const char* name) const {
  std::printf("%-10s localized %d of %d", name, successes_, queries_);
  if (!focal_.empty())
    std::printf("; medians: f %.3f %%, rotation %.4f deg, position %.5f", median(focal_), median(rotation_), median(position_));
  std::printf(", %.2f ms\n", median(milliseconds_));
}

}  // namespace program

#include "LocalizationJson.hpp"

#include <nlohmann/json.hpp>

#include "poseNumbers.hpp"

namespace program {
namespace {

using Json = nlohmann::ordered_json;
using hybridgv::sfm::LeftOut;
using hybridgv::sfm::QueryLocalization;

Json start(const std::string& name, bool success, const std::string& reason) {
  Json json{{"schema", "hybridgv/localization/1"}, {"query", name}, {"success", success}};
  if (!success) json["failure_reason"] = reason;
  return json;
}

void addPose(const QueryLocalization& localization, Json& json) {
  const std::array<double, 7> pose = poseNumbers(localization.result.pose);
  const hybridgv::sfm::Camera& camera = localization.camera;
  json["camera"] = {
      {"model", toString(camera.model)}, {"width", camera.width}, {"height", camera.height}, {"params", camera.parameters}};
  json["focal_length_px"] = focalLength(camera);
  json["focal_length_std_px"] = localization.result.focalLengthStandardDeviation;
  json["radial_k"] = localization.k1;
  json["radial_k_std"] = localization.k1StandardDeviation;
  json["qvec_wxyz"] = std::vector<double>(pose.begin(), pose.begin() + 4);
  json["tvec"] = std::vector<double>(pose.begin() + 4, pose.end());
  const Eigen::Vector3d& centre = localization.result.pose.position;
  json["center"] = std::vector<double>(centre.data(), centre.data() + 3);
}

Json leftOut(const LeftOut& l) {
  return {{"images_not_in_map", l.imagesNotInMap},
          {"images_that_differ", l.imagesThatDiffer},
          {"pairs_with_few_matches", l.pairsWithFewMatches},
          {"pairs_unverified", l.unverifiedPairs},
          {"pairs_watermark", l.watermarkPairs},
          {"pairs_damaged", l.pairsDamaged},
          {"indices_out_of_range", l.indicesOutOfRange},
          {"keypoints_not_usable", l.keypointsNotUsable}};
}

// Names need not be UTF-8, of which JSON consists.
std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string toJsonLine(const hybridgv::sfm::SparseModel& map, const QueryLocalization& localization) {
  const hybridgv::sac::HybridRansacResult& result = localization.result;
  Json json = start(localization.problem.imageName, localization.success, localization.reason);
  if (localization.success) addPose(localization, json);
  json["matches_2d3d"] = localization.problem.adapter.getNumberCorrespondences2d3d();
  json["matches_2d2d"] = localization.problem.adapter.getNumberCorrespondences2d2d();
  json["inliers_2d3d"] = result.numberInliers2d3d;
  json["inliers_2d2d"] = result.numberInliers2d2d;
  json["pairs"] = Json::array();
  for (const hybridgv::sfm::PairReport& pair : localization.pairs)
    json["pairs"].push_back({{"image", map.images[pair.image].name},
                             {"matches", pair.matches},
                             {"inliers_2d3d", pair.inliers2d3d},
                             {"inliers_2d2d", pair.inliers2d2d}});
  json["left_out"] = leftOut(localization.problem.leftOut);
  json["iterations"] = result.iterations;
  json["seconds"] = result.seconds;
  return dumped(json);
}

std::string toJsonLine(const std::string& name, const std::string& reason) { return dumped(start(name, false, reason)); }

}  // namespace program

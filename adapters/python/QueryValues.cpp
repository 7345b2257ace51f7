#include "QueryValues.hpp"

#include <pybind11/stl.h>

#include <numeric>

#include "Values.hpp"

namespace hybridgv {
namespace python {
namespace {

py::array_t<long long> arrayOfIndices(const std::vector<std::size_t>& indices) {
  py::array_t<long long> array(static_cast<py::ssize_t>(indices.size()));
  long long* value = array.mutable_data();
  for (const std::size_t index : indices) *value++ = static_cast<long long>(index);
  return array;
}

py::array_t<bool> wholeMask(const std::vector<char>& mask, std::size_t count) {
  std::vector<std::size_t> all(mask.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return maskOf(mask, all, count);
}

void addCorrespondences(const sfm::SparseModel& map, const sfm::QueryLocalization& localization, py::dict& dict) {
  const sfm::LocalizationProblem& problem = localization.problem;
  std::vector<std::size_t> ids;
  for (const std::size_t point : problem.points2d3d) ids.push_back(static_cast<std::size_t>(map.points[point].id));
  py::list names;
  for (std::size_t i = 0; i < problem.keypoints2d2d.size(); ++i)
    names.append(map.images[problem.rigImages[static_cast<std::size_t>(problem.adapter.getCamIndex(i))]].name);
  dict["keypoint_idxs"] = arrayOfIndices(problem.keypoints2d3d);
  dict["point3D_ids"] = arrayOfIndices(ids);
  dict["keypoint_idxs_rays"] = arrayOfIndices(problem.keypoints2d2d);
  dict["image_names_rays"] = names;
  dict["inlier_mask"] = wholeMask(localization.result.inliers2d3d, problem.keypoints2d3d.size());
  dict["inlier_mask_rays"] = wholeMask(localization.result.inliers2d2d, problem.keypoints2d2d.size());
}

py::list pairsOf(const sfm::SparseModel& map, const sfm::QueryLocalization& localization) {
  py::list pairs;
  for (const sfm::PairReport& report : localization.pairs) {
    py::dict pair;
    pair["image"] = map.images[report.image].name;
    pair["matches"] = report.matches;
    pair["inliers_points"] = report.inliers2d3d;
    pair["inliers_rays"] = report.inliers2d2d;
    pairs.append(pair);
  }
  return pairs;
}

py::dict dictOf(const sfm::LeftOut& leftOut) {
  py::dict dict;
  dict["images_not_in_map"] = leftOut.imagesNotInMap;
  dict["images_that_differ"] = leftOut.imagesThatDiffer;
  dict["pairs_with_few_matches"] = leftOut.pairsWithFewMatches;
  dict["pairs_unverified"] = leftOut.unverifiedPairs;
  dict["pairs_watermark"] = leftOut.watermarkPairs;
  dict["pairs_damaged"] = leftOut.pairsDamaged;
  dict["indices_out_of_range"] = leftOut.indicesOutOfRange;
  dict["keypoints_not_usable"] = leftOut.keypointsNotUsable;
  return dict;
}

}  // namespace

py::dict dictOf(const sfm::SparseModel& map, const sfm::QueryImage& query, const sfm::QueryLocalization& localization) {
  py::dict dict = dictOf(localization.result);
  dict["name"] = query.name;
  dict["success"] = localization.success;
  dict["failure_reason"] = localization.success ? py::object(py::none()) : py::str(localization.reason);
  if (localization.success) {
    dict["focal_length"] = focalLength(localization.camera);
    dict["k1"] = localization.k1;
    dict["k1_std"] = localization.k1StandardDeviation;
  }
  dict["camera"] = dictOf(localization.camera);
  dict["distortion_is_lost"] = localization.distortionIsLost;
  dict["pairs"] = pairsOf(map, localization);
  dict["left_out"] = dictOf(localization.problem.leftOut);
  dict["notes"] = py::cast(query.notes);
  addCorrespondences(map, localization, dict);
  return dict;
}

}  // namespace python
}  // namespace hybridgv

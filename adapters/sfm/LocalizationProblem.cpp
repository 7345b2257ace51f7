#include "hybridgv/adapters/sfm/LocalizationProblem.hpp"

#include <algorithm>
#include <cmath>

#include "CameraModels.hpp"
#include "CheckArguments.hpp"
#include "MapViews.hpp"
#include "QueryCamera.hpp"

namespace hybridgv {
namespace sfm {
namespace {

// What a match says of a keypoint.
struct Vote {
  std::size_t keypoint, point;  // kNoPoint: the observation has none
  std::size_t image, observation;
  double score;
};

// One correspondence of the query, before the rig cameras are numbered.
struct RayMatch {
  Eigen::Vector3d imagePoint, bearing;
  std::size_t image, point, keypoint;
  double weight;
};
struct PointMatch {
  Eigen::Vector3d imagePoint, position;
  std::size_t point, keypoint;
  double weight;
};
struct Matches {
  std::vector<RayMatch> rays;
  std::vector<PointMatch> points;
};

// The point, of which `image` says that observation is an image.
std::size_t pointOf(const SparseModel& map, std::size_t image, std::size_t observation) {
  const std::size_t point = map.images[image].observations[observation].point;
  if (point != Observation::kNoPoint && point >= map.points.size())
    throwInvalid(modelElement("images", image), "there is no point " + std::to_string(point));
  return point;
}

// The matches by keypoint, those of one keypoint in the order of the images.
std::vector<Vote> votesOf(const SparseModel& map, const QueryImage& query, LeftOut& leftOut) {
  std::vector<Vote> votes;
  for (std::size_t i = 0; i < query.matches.size(); ++i) {
    const ImageMatches& matches = query.matches[i];
    const std::string name = "query.matches[" + std::to_string(i) + "]";
    if (matches.image >= map.images.size()) throwInvalid(name, "there is no image " + std::to_string(matches.image));
    if (!matches.scores.empty() && matches.scores.size() != matches.pairs.size())
      throwInvalid(name, "has " + std::to_string(matches.pairs.size()) + " pairs and " + std::to_string(matches.scores.size()) +
                             " scores");
    if (!map.images[matches.image].registered) {
      ++leftOut.imagesNotInMap;
      continue;
    }
    checkPose(map, matches.image);
    for (std::size_t k = 0; k < matches.pairs.size(); ++k) {
      const auto [keypoint, observation] = matches.pairs[k];
      if (keypoint >= query.keypoints.size() || observation >= map.images[matches.image].observations.size())
        ++leftOut.indicesOutOfRange;
      else
        votes.push_back({keypoint, pointOf(map, matches.image, observation), matches.image, observation,
                         matches.scores.empty() ? 1 : matches.scores[k]});
    }
  }
  std::stable_sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.keypoint < b.keypoint; });
  return votes;
}

PointLimits limitsOf(const LocalizationProblemOptions& options) {
  checkNotNegative("options.minParallaxDeg", options.minParallaxDeg);
  checkNotNegative("options.maxMapReprojectionErrorPx", options.maxMapReprojectionErrorPx);
  return {options.minParallaxDeg * std::acos(-1.0) / 180, options.maxMapReprojectionErrorPx};
}

// Makes the correspondences of a query, keypoint by keypoint.
class Matcher {
 public:
  // `withheld` is the query itself if it is an image of the map.
  Matcher(const SparseModel& map, const QueryImage& query, std::size_t withheld, const LocalizationProblemOptions& options)
      : map_(map),
        query_(query),
        withheld_(withheld),
        camera_(query.camera, query.knowledge),
        limits_(limitsOf(options)),
        certainPoints_(withheld == kNoImage ? options.certainPoints.get() : nullptr),
        raysBesidePoints_(options.raysBesidePoints),
        raysOnly_(options.raysOnly),
        leftOut_(query.leftOut) {}

  Matches match() {
    const std::vector<Vote> votes = votesOf(map_, query_, leftOut_);
    for (auto first = votes.begin(); first != votes.end();) {
      const auto end = std::find_if(first, votes.end(), [&](const Vote& v) { return v.keypoint != first->keypoint; });
      const Keypoint& keypoint = query_.keypoints[first->keypoint];
      const bool isFinite = std::isfinite(keypoint.x) && std::isfinite(keypoint.y);
      if (const auto imagePoint = isFinite ? camera_.imagePoint(keypoint.x, keypoint.y) : std::nullopt)
        addKeypoint(*imagePoint, {first, end});
      else
        ++leftOut_.keypointsNotUsable;
      first = end;
    }
    return std::move(matches_);
  }

  const LeftOut& leftOut() const { return leftOut_; }

 private:
  void addKeypoint(const Eigen::Vector3d& imagePoint, const std::vector<Vote>& votes) {
    std::vector<char> isSettled(votes.size());
    bool hasPoint = false;
    for (std::size_t i = 0; i < votes.size(); ++i) {
      const std::size_t point = votes[i].point;
      if (point == Observation::kNoPoint || isSettled[i] != 0) continue;
      const auto isSame = [&](const Vote& v) { return v.point == point; };
      if (std::find_if(votes.begin(), votes.end(), isSame) - votes.begin() != static_cast<std::ptrdiff_t>(i)) continue;
      const std::optional<Eigen::Vector3d> position = certainPositionOf(point);
      if (!position) continue;
      hasPoint = true;
      double weight = 0;  // votes times mean score
      for (std::size_t k = 0; k < votes.size(); ++k) {
        if (!isSame(votes[k])) continue;
        isSettled[k] = 1;
        weight += votes[k].score;
      }
      matches_.points.push_back({imagePoint, *position, point, votes[i].keypoint, weight});
    }
    for (std::size_t i = 0; i < votes.size(); ++i)
      if (!hasPoint || (raysBesidePoints_ && isSettled[i] == 0)) addRay(imagePoint, votes[i]);
  }

  std::optional<Eigen::Vector3d> certainPositionOf(std::size_t point) const {
    if (raysOnly_) return std::nullopt;
    if (certainPoints_ == nullptr) return certainPosition(map_, point, withheld_, limits_);
    return (*certainPoints_)[point] != 0 ? std::optional<Eigen::Vector3d>(map_.points[point].position) : std::nullopt;
  }

  void addRay(const Eigen::Vector3d& imagePoint, const Vote& vote) {
    if (const std::optional<MapRay> ray = mapRay(map_, vote.image, map_.images[vote.image].observations[vote.observation]))
      matches_.rays.push_back({imagePoint, ray->bearing, vote.image, vote.point, vote.keypoint, vote.score});
  }

  const SparseModel& map_;
  const QueryImage& query_;
  const std::size_t withheld_;
  const QueryCamera camera_;
  const PointLimits limits_;
  const std::vector<char>* certainPoints_;  // null: not known yet
  const bool raysBesidePoints_, raysOnly_;
  LeftOut leftOut_;
  Matches matches_;
};

// The images of the map that are cameras of the rig, ascending.
std::vector<std::size_t> rigOf(const Matches& matches) {
  std::vector<std::size_t> rig;
  for (const RayMatch& match : matches.rays) rig.push_back(match.image);
  std::sort(rig.begin(), rig.end());
  rig.erase(std::unique(rig.begin(), rig.end()), rig.end());
  return rig;
}

std::vector<int> featuresOf(const std::vector<std::size_t>& keypoints) {
  std::vector<int> features(keypoints.size());
  std::transform(keypoints.begin(), keypoints.end(), features.begin(), [](std::size_t k) { return static_cast<int>(k); });
  return features;
}

LocalizationProblem toProblem(const SparseModel& model, const Matches& matches) {
  std::vector<std::size_t> rig = rigOf(matches);
  NoncentralHybridAdapter::Vectors centres, imagePoints2d2d, bearings, imagePoints2d3d, positions;
  NoncentralHybridAdapter::Matrices rotations;
  std::vector<int> camIndices;
  std::vector<double> focalLengths, weights2d2d, weights2d3d;
  std::vector<std::size_t> points2d2d, points2d3d, keypoints2d2d, keypoints2d3d;
  for (const std::size_t image : rig) {
    centres.push_back(model.images[image].position);
    rotations.push_back(model.images[image].rotation);
    focalLengths.push_back(focalLength(cameraOf(model, image)));
  }
  for (const RayMatch& match : matches.rays) {
    imagePoints2d2d.push_back(match.imagePoint);
    bearings.push_back(match.bearing);
    camIndices.push_back(static_cast<int>(std::lower_bound(rig.begin(), rig.end(), match.image) - rig.begin()));
    points2d2d.push_back(match.point);
    keypoints2d2d.push_back(match.keypoint);
    weights2d2d.push_back(match.weight);
  }
  for (const PointMatch& match : matches.points) {
    imagePoints2d3d.push_back(match.imagePoint);
    positions.push_back(match.position);
    points2d3d.push_back(match.point);
    keypoints2d3d.push_back(match.keypoint);
    weights2d3d.push_back(match.weight);
  }
  NoncentralHybridAdapter adapter(imagePoints2d2d, bearings, camIndices, centres, rotations, imagePoints2d3d, positions);
  adapter.setRigFocalLengths(focalLengths);
  adapter.setWeights(weights2d2d, weights2d3d);
  adapter.setFeatures(featuresOf(keypoints2d2d), featuresOf(keypoints2d3d));
  const std::vector<bool> none2d2d(points2d2d.size()), none2d3d(points2d3d.size());
  LocalizationProblem problem{
      "", adapter, std::nullopt, std::move(rig), std::move(points2d2d), std::move(points2d3d), none2d2d, none2d3d, {}, {}, {}};
  problem.keypoints2d2d = std::move(keypoints2d2d);
  problem.keypoints2d3d = std::move(keypoints2d3d);
  return problem;
}

LocalizationProblem makeProblem(const SparseModel& map, const QueryImage& query, std::size_t withheld,
                                const LocalizationProblemOptions& options) {
  if (options.certainPoints && options.certainPoints->size() != map.points.size())
    throwInvalid("options.certainPoints", "are " + std::to_string(options.certainPoints->size()) + ", the map has " +
                                              std::to_string(map.points.size()) + " points");
  Matcher matcher(map, query, withheld, options);
  LocalizationProblem problem = toProblem(map, matcher.match());
  problem.imageName = query.name;
  problem.leftOut = matcher.leftOut();
  problem.isUndistorted = query.knowledge == CameraKnowledge::Known;
  problem.imageWidth = query.camera.width;
  problem.imageHeight = query.camera.height;
  return problem;
}

// An image that sees a point twice counts with the observation that the track names first.
bool isFirstOfTrack(const Point& point, std::size_t image, std::size_t observation) {
  const auto sees = [&](const TrackElement& e) { return e.image == image; };
  const auto first = std::find_if(point.track.begin(), point.track.end(), sees);
  return first != point.track.end() && first->observation == observation;
}

// The first of the track that another image sees.
const TrackElement* firstSeenByOthers(const SparseModel& model, std::size_t point, std::size_t query) {
  for (const TrackElement& e : model.points[point].track) {
    if (e.image >= model.images.size() || e.observation >= model.images[e.image].observations.size())
      throwInvalid(modelElement("points", point), "the track names an observation that does not exist");
    const Image& image = model.images[e.image];
    if (e.image != query && image.registered && mapRay(model, e.image, image.observations[e.observation])) return &e;
  }
  return nullptr;
}

// An image of the map with what it shares with the others as its matches: every point once, with the first other image that sees it.
QueryImage takeOut(const SparseModel& model, std::size_t index, bool undistort) {
  const Image& image = model.images[index];
  QueryImage query;
  query.id = image.id;
  query.name = image.name;
  query.camera = cameraOf(model, index);
  query.knowledge = undistort || !mapsAPlane(query.camera.model) ? CameraKnowledge::Known : CameraKnowledge::Unknown;
  if (query.knowledge == CameraKnowledge::Unknown) forgetCalibration(query.camera);
  std::vector<ImageMatches> matches(model.images.size());
  for (std::size_t i = 0; i < image.observations.size(); ++i) {
    const Observation& o = image.observations[i];
    query.keypoints.push_back({o.x, o.y});
    const std::size_t point = pointOf(model, index, i);
    if (point == Observation::kNoPoint) continue;
    checkObservation(index, o);
    if (!isFirstOfTrack(model.points[point], index, i)) continue;
    const TrackElement* other = firstSeenByOthers(model, point, index);
    if (other == nullptr) continue;
    matches[other->image].pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(other->observation)});
  }
  for (std::size_t i = 0; i < matches.size(); ++i) {
    matches[i].image = i;
    if (!matches[i].pairs.empty()) query.matches.push_back(std::move(matches[i]));
  }
  return query;
}

}  // namespace

std::shared_ptr<const std::vector<char>> findCertainPoints(const SparseModel& map, const LocalizationProblemOptions& options) {
  const PointLimits limits = limitsOf(options);
  std::vector<char> isCertain(map.points.size());
  for (std::size_t i = 0; i < isCertain.size(); ++i) isCertain[i] = certainPosition(map, i, kNoImage, limits) ? 1 : 0;
  return std::make_shared<const std::vector<char>>(std::move(isCertain));
}

LocalizationProblem makeLocalizationProblem(const SparseModel& map, const QueryImage& query,
                                            const LocalizationProblemOptions& options) {
  return makeProblem(map, query, kNoImage, options);
}

LocalizationProblem makeLocalizationProblem(const SparseModel& model, std::size_t imageIndex,
                                            const LocalizationProblemOptions& options) {
  if (imageIndex >= model.images.size())
    throwInvalid("imageIndex", std::to_string(imageIndex) + " is outside the " + std::to_string(model.images.size()) + " images");
  const Image& query = model.images[imageIndex];
  const std::string name = "image " + std::to_string(imageIndex) + " (" + query.name + ")";
  if (!query.registered) throwInvalid("imageIndex", name + " has no pose");
  const Camera& camera = cameraOf(model, imageIndex);
  if (!hasImagePlane(camera.model))
    throwInvalid("imageIndex", name + " has the camera model " + toString(camera.model) + " without an image plane");
  checkPose(model, imageIndex);
  LocalizationProblem problem = makeProblem(model, takeOut(model, imageIndex, options.undistortQuery), imageIndex, options);
  problem.reference = FocalPose{query.rotation, query.position, focalLength(camera)};
  if (!problem.isUndistorted) problem.referenceK1 = firstDistortion(camera);
  return problem;
}

}  // namespace sfm
}  // namespace hybridgv

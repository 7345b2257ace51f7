// An image taken out of an exact sparse model, with its matches to the others.
#pragma once

#include <utility>

#include "SfmScene.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace test {

struct QueryScene {
  sfm::SparseModel map;  // without the image
  sfm::QueryImage query;
  FocalPose truth;
};

// Takes the features of `image` out of the map's tracks; points that nobody else sees stay without a track. The image itself stays
// in the map as one that is not registered, so that indices are kept.
inline void forgetImage(sfm::SparseModel& map, std::size_t image) {
  for (sfm::Point& point : map.points) {
    std::vector<sfm::TrackElement> track;
    for (const sfm::TrackElement& e : point.track)
      if (e.image != image) track.push_back(e);
    point.track = std::move(track);
  }
  map.images[image].registered = false;
  map.images[image].observations.clear();
}

// A query of `image`, whose features match those of all other images that see the same point.
inline QueryScene makeQuery(sfm::SparseModel map, std::size_t index) {
  const sfm::Image image = map.images[index];
  QueryScene scene;
  scene.query.id = image.id;
  scene.query.name = image.name;
  scene.query.camera = map.cameras[image.camera];
  scene.truth = {image.rotation, image.position, sfm::focalLength(scene.query.camera)};
  std::vector<sfm::ImageMatches> matches(map.images.size());
  for (std::size_t i = 0; i < image.observations.size(); ++i) {
    const sfm::Observation& o = image.observations[i];
    scene.query.keypoints.push_back({o.x, o.y});
    if (o.point == sfm::Observation::kNoPoint) continue;
    for (const sfm::TrackElement& e : map.points[o.point].track)
      if (e.image != index)
        matches[e.image].pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(e.observation)});
  }
  for (std::size_t i = 0; i < matches.size(); ++i) {
    matches[i].image = i;
    if (!matches[i].pairs.empty()) scene.query.matches.push_back(std::move(matches[i]));
  }
  forgetImage(map, index);
  scene.map = std::move(map);
  return scene;
}

}  // namespace test
}  // namespace hybridgv

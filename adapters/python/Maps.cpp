// Maps: sparse models in arrays and files, and query images against them.
#include <pybind11/stl.h>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>

#include <algorithm>
#include <map>
#include <mutex>
#include <stdexcept>
#include <unordered_map>

#include "Module.hpp"
#include "Options.hpp"
#include "QueryValues.hpp"
#include "Values.hpp"

namespace hybridgv {
namespace python {
namespace {

using sfm::Observation;
using sfm::SparseModel;

constexpr long long kNoPointId = -1;

std::array<std::uint8_t, 3> colourOf(const double* values) {
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t k = 0; k < 3; ++k) colour[k] = static_cast<std::uint8_t>(std::clamp(values[k], 0.0, 255.0));
  return colour;
}

// A map made of arrays; tracks follow from what the images say.
class ModelMaker {
 public:
  void addPoints(const py::object& ids, const py::object& positions, const py::object& colours) {
    const IndexArray idArray = indicesOf("point3D_ids", ids, 0);
    const Vectors points = vectorsOf(rowsOf("points", positions, 3));
    const DoubleArray colourArray = rowsOf("colors", colours, 3);
    checkCount("points", static_cast<py::ssize_t>(points.size()), "point3D_ids", idArray.size());
    checkCount("colors", colourArray.shape(0), "point3D_ids", idArray.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      sfm::Point point;
      point.id = static_cast<std::uint64_t>(idArray.data()[i]);
      point.position = points[i];
      point.colour = colourOf(colourArray.data() + 3 * i);
      if (!byId_.emplace(idArray.data()[i], i).second)
        throw std::invalid_argument("point3D_ids: " + std::to_string(idArray.data()[i]) + " is there twice");
      model_.points.push_back(point);
    }
  }

  void addCamera(std::uint32_t id, const py::tuple& parts) {
    sfm::Camera camera = cameraOf(parts);
    camera.id = id;
    cameras_[id] = model_.cameras.size();
    model_.cameras.push_back(camera);
  }

  // (id, name, camera's id, (3, 3) R, (3,) t, (K, 2) pixels, (K,) ids of points or -1)
  void addImage(const py::tuple& values) {
    sfm::Image image;
    image.id = values[0].cast<std::uint32_t>();
    image.name = values[1].cast<std::string>();
    const auto camera = cameras_.find(values[2].cast<std::uint32_t>());
    if (camera == cameras_.end()) throw std::invalid_argument("image " + image.name + ": its camera is missing");
    image.camera = camera->second;
    const FocalPose pose = FocalPose::fromCamFromWorld(matrixOf("R", values[3]), vectorOf("t", values[4]), 1);
    image.rotation = pose.rotation;
    image.position = pose.position;
    addObservations(values[5], values[6], image);
    model_.images.push_back(image);
  }

  SparseModel take() { return std::move(model_); }

 private:
  void addObservations(const py::object& pixels, const py::object& ids, sfm::Image& image) {
    const DoubleArray pixelArray = rowsOf("keypoints", pixels, 2);
    const IndexArray idArray = indicesOf("point3D_ids", ids, 0);
    checkCount("point3D_ids", idArray.size(), "keypoints", pixelArray.shape(0));
    for (py::ssize_t i = 0; i < idArray.size(); ++i) {
      Observation observation{pixelArray.data()[2 * i], pixelArray.data()[2 * i + 1], Observation::kNoPoint};
      if (idArray.data()[i] != kNoPointId) {
        const auto point = byId_.find(idArray.data()[i]);
        if (point == byId_.end())
          throw std::invalid_argument("image " + image.name + ": there is no point " + std::to_string(idArray.data()[i]));
        observation.point = point->second;
        model_.points[point->second].track.push_back({model_.images.size(), image.observations.size()});
      }
      image.observations.push_back(observation);
    }
  }

  SparseModel model_;
  std::unordered_map<long long, std::size_t> byId_;
  std::map<std::uint32_t, std::size_t> cameras_;
};

py::array_t<double> positionsOf(const SparseModel& model) {
  py::array_t<double> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(model.points.size()), 3});
  double* value = array.mutable_data();
  for (const sfm::Point& point : model.points) value = std::copy(point.position.data(), point.position.data() + 3, value);
  return array;
}

py::array_t<std::uint8_t> coloursOf(const SparseModel& model) {
  py::array_t<std::uint8_t> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(model.points.size()), 3});
  std::uint8_t* value = array.mutable_data();
  for (const sfm::Point& point : model.points) value = std::copy(point.colour.begin(), point.colour.end(), value);
  return array;
}

py::array_t<long long> idsOf(const SparseModel& model) {
  py::array_t<long long> array(static_cast<py::ssize_t>(model.points.size()));
  long long* value = array.mutable_data();
  for (const sfm::Point& point : model.points) *value++ = static_cast<long long>(point.id);
  return array;
}

// A map that does not change. Several threads may use one.
class Map {
 public:
  Map(SparseModel model, std::vector<std::string> notes) : model_(std::move(model)), notes_(std::move(notes)) {
    for (std::size_t i = 0; i < model_.images.size(); ++i)
      if (model_.images[i].registered) byName_.emplace(model_.images[i].name, i);
  }

  static std::unique_ptr<Map> read(const std::string& path, bool strict) {
    const py::gil_scoped_release release;
    sfm::ReadReport report;
    sfm::ReadOptions options;
    options.strict = strict;
    SparseModel model = sfm::readModel(path, options, &report);
    return std::make_unique<Map>(std::move(model), report.sentences());
  }

  void write(const std::string& folder, bool binary) const {
    const py::gil_scoped_release release;
    (binary ? sfm::writeColmapBinary : sfm::writeColmapText)(folder, model_);
  }

  const SparseModel& model() const { return model_; }
  const std::vector<std::string>& notes() const { return notes_; }

  // Index of a registered image.
  std::optional<std::size_t> find(const std::string& name) const {
    const auto found = byName_.find(name);
    return found == byName_.end() ? std::nullopt : std::optional<std::size_t>(found->second);
  }

  std::vector<std::size_t> registered() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < model_.images.size(); ++i)
      if (model_.images[i].registered) indices.push_back(i);
    return indices;
  }

  // Which points are certain: found once for equal options.
  std::shared_ptr<const std::vector<char>> certainPoints(const sfm::LocalizationProblemOptions& options) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::shared_ptr<const std::vector<char>>& certain = certain_[{options.minParallaxDeg, options.maxMapReprojectionErrorPx}];
    if (!certain) certain = findCertainPoints(model_, options);
    return certain;
  }

 private:
  const SparseModel model_;
  const std::vector<std::string> notes_;
  std::unordered_map<std::string, std::size_t> byName_;
  std::mutex mutex_;
  std::map<std::pair<double, double>, std::shared_ptr<const std::vector<char>>> certain_;
};

std::unique_ptr<Map> makeMap(const py::object& ids, const py::object& positions, const py::object& colours,
                             const py::dict& cameras, const py::list& images) {
  ModelMaker maker;
  maker.addPoints(ids, positions, colours);
  for (const auto& [id, parts] : cameras) maker.addCamera(id.cast<std::uint32_t>(), parts.cast<py::tuple>());
  for (const py::handle& image : images) maker.addImage(image.cast<py::tuple>());
  return std::make_unique<Map>(maker.take(), std::vector<std::string>());
}

// (id, name, camera's id, R, t, pixels, ids of points): what ModelMaker takes.
py::tuple imageOf(const SparseModel& model, const sfm::Image& image) {
  const auto count = static_cast<py::ssize_t>(image.observations.size());
  py::array_t<double> pixels(std::vector<py::ssize_t>{count, 2});
  py::array_t<long long> ids(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const Observation& observation = image.observations[static_cast<std::size_t>(i)];
    pixels.mutable_data()[2 * i] = observation.x;
    pixels.mutable_data()[2 * i + 1] = observation.y;
    ids.mutable_data()[i] =
        observation.point == Observation::kNoPoint ? kNoPointId : static_cast<long long>(model.points[observation.point].id);
  }
  const CamFromWorld pose = FocalPose{image.rotation, image.position, 1}.camFromWorld();
  return py::make_tuple(image.id, image.name, model.cameras[image.camera].id, arrayOf(pose.rotation), arrayOf(pose.translation),
                        pixels, ids);
}

sfm::ImageMatches matchesOf(std::size_t image, const py::object& pairs) {
  const IndexArray array = indicesOf("matches", pairs, 2);
  sfm::ImageMatches matches{image, {}, {}};
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    std::array<std::uint32_t, 2> pair{};
    for (std::size_t k = 0; k < 2; ++k) {
      const long long index = array.data()[2 * i + static_cast<py::ssize_t>(k)];
      if (index < 0 || index > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument("matches: " + std::to_string(index) + " is no index");
      pair[k] = static_cast<std::uint32_t>(index);
    }
    matches.pairs.push_back(pair);
  }
  return matches;
}

// Matches with images that the map does not have are counted, not used.
void addMatches(const Map& map, const py::dict& matches, const py::dict& scores, sfm::QueryImage& query) {
  for (const auto& [name, pairs] : matches) {
    const std::optional<std::size_t> image = map.find(name.cast<std::string>());
    if (!image) {
      ++query.leftOut.imagesNotInMap;
      continue;
    }
    query.matches.push_back(matchesOf(*image, py::reinterpret_borrow<py::object>(pairs)));
    if (scores.contains(name)) query.matches.back().scores = listOf(numbersOf("scores", scores[name]));
  }
}

py::dict localizeInMap(Map& map, const std::string& name, const py::object& keypoints, const py::dict& matches,
                       const py::dict& scores, const py::tuple& camera, const std::string& cameraKnowledge,
                       const py::dict& optionDict) {
  sfm::QueryOptions options = optionsOf(optionDict);
  sfm::QueryImage query;
  query.name = name;
  query.camera = cameraOf(camera);
  query.knowledge = knowledgeOf(cameraKnowledge);
  const DoubleArray pixels = rowsOf("keypoints", keypoints, 2);
  for (py::ssize_t i = 0; i < pixels.shape(0); ++i) query.keypoints.push_back({pixels.data()[2 * i], pixels.data()[2 * i + 1]});
  addMatches(map, matches, scores, query);
  std::unique_ptr<sfm::QueryLocalization> localization;
  {
    const py::gil_scoped_release release;
    options.matches.certainPoints = map.certainPoints(options.matches);
    localization = std::make_unique<sfm::QueryLocalization>(localizeQuery(map.model(), query, options));
  }
  return dictOf(map.model(), query, *localization);
}

}  // namespace

void addMaps(py::module_& module) {
  py::class_<Map>(module, "Map")
      .def_static("read", &Map::read, py::arg("path"), py::arg("strict"))
      .def_static("make", &makeMap, py::arg("point3D_ids"), py::arg("points"), py::arg("colors"), py::arg("cameras"),
                  py::arg("images"))
      .def("write", &Map::write, py::arg("path"), py::arg("binary"))
      .def("point3D_ids", [](const Map& map) { return idsOf(map.model()); })
      .def("points", [](const Map& map) { return positionsOf(map.model()); })
      .def("colors", [](const Map& map) { return coloursOf(map.model()); })
      .def("notes", [](const Map& map) { return map.notes(); })
      .def("cameras",
           [](const Map& map) {
             py::dict cameras;
             for (const sfm::Camera& camera : map.model().cameras) cameras[py::int_(camera.id)] = dictOf(camera);
             return cameras;
           })
      .def("image_names",
           [](const Map& map) {
             py::list names;
             for (const std::size_t i : map.registered()) names.append(map.model().images[i].name);
             return names;
           })
      .def(
          "image",
          [](const Map& map, const std::string& name) -> py::object {
            const std::optional<std::size_t> index = map.find(name);
            return index ? py::object(imageOf(map.model(), map.model().images[*index])) : py::none();
          },
          py::arg("name"))
      .def("localize", &localizeInMap, py::arg("name"), py::arg("keypoints"), py::arg("matches"), py::arg("scores"),
           py::arg("camera"), py::arg("camera_knowledge"), py::arg("options"));
}

}  // namespace python
}  // namespace hybridgv

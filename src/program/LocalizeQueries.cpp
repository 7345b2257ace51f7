#include "LocalizeQueries.hpp"

#include <hybridgv/adapters/sfm/ModelFiles.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "common/CommandLine.hpp"

namespace program {
namespace {

// What the reader has mended, unless --quiet.
void printReport(const hybridgv::sfm::ReadReport& report, const LocalizeArguments& arguments) {
  if (arguments.quiet) return;
  for (const std::string& sentence : report.sentences()) std::fprintf(stderr, "localize: %s\n", sentence.c_str());
}

// All images of this name, of which a map may have several; if there is none, the one whose index it is.
std::vector<std::size_t> findImages(const hybridgv::sfm::SparseModel& map, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < map.images.size(); ++i)
    if (map.images[i].name == name) found.push_back(i);
  if (!found.empty()) return found;
  std::size_t index = 0;
  const bool isNumber = CLI::detail::lexical_cast(name, index);
  if (isNumber && index < map.images.size()) return {index};
  throw std::invalid_argument("no image of the map is called " + quoted(name));
}

// A panorama has no pose with a focal length to look for.
bool canBeQuery(const hybridgv::sfm::SparseModel& map, std::size_t index, const LocalizeArguments& arguments) {
  const hybridgv::sfm::Image& image = map.images[index];
  if (!image.registered) return false;
  const hybridgv::sfm::CameraModel model = map.cameras[image.camera].model;
  if (hasImagePlane(model)) return true;
  if (!arguments.quiet)
    std::fprintf(stderr, "localize: %s is no query: %s has no image plane\n", image.name.c_str(), toString(model));
  return false;
}

std::vector<Query> queriesOfMap(const std::string& path, const LocalizeArguments& arguments,
                                const std::vector<std::string>& names) {
  hybridgv::sfm::ReadReport report;
  const auto map = std::make_shared<const hybridgv::sfm::SparseModel>(hybridgv::sfm::readModel(path, arguments.reading, &report));
  printReport(report, arguments);
  std::vector<std::size_t> images;
  for (const std::string& name : names)
    for (const std::size_t image : findImages(*map, name)) images.push_back(image);
  if (names.empty())
    for (std::size_t i = 0; i < map->images.size(); ++i)
      if (canBeQuery(*map, i, arguments)) images.push_back(i);
  std::vector<Query> queries;
  for (const std::size_t image : images)
    queries.push_back(
        {[map, image, options = arguments.matches] { return makeLocalizationProblem(*map, image, options); }, map, image});
  return queries;
}

}  // namespace

std::vector<Query> collectQueries(const LocalizeArguments& arguments) {
  std::vector<std::string> names = arguments.queries, files;
  std::vector<std::string> maps;
  for (const std::string& input : arguments.inputs) (hybridgv::sfm::isProblemFile(input) ? files : maps).push_back(input);
  if (arguments.readStandardInput)
    for (const std::string& line : readLines(std::cin)) (maps.empty() ? files : names).push_back(line);
  if (maps.empty() && !arguments.queries.empty()) throw std::invalid_argument("--query: there is no map to look for images in");
  for (const std::string& file : files)
    if (maps.empty() && !std::filesystem::exists(file))
      throw std::invalid_argument("no file is called " + quoted(file) + "; to localize an image by its name, name its map too");
  std::vector<Query> queries;
  for (const std::string& map : maps)
    for (Query& query : queriesOfMap(map, arguments, names)) queries.push_back(std::move(query));
  for (const std::string& file : files)
    queries.push_back({[file, &arguments] {
      hybridgv::sfm::ReadReport report;
      hybridgv::sfm::LocalizationProblem problem = hybridgv::sfm::readProblem(file, arguments.reading, &report);
      printReport(report, arguments);
      return problem;
    }});
  return queries;
}

}  // namespace program

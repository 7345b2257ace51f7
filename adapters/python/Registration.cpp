// register_images(): images of a COLMAP database into a map.
#include <pybind11/stl.h>
#include <hybridgv/adapters/colmap/registerImages.hpp>
#include <hybridgv/adapters/report/Page.hpp>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/adapters/sfm/addToModel.hpp>

#include <filesystem>

#include "Module.hpp"
#include "Options.hpp"
#include "QueryValues.hpp"
#include "Values.hpp"

namespace hybridgv {
namespace python {
namespace {

// What is given instead of a result for an image that could not be read.
py::object valuesOf(const sfm::SparseModel& map, const sfm::RegisteredImage& image) {
  if (image.localization) return dictOf(map, image.query, *image.localization);
  return py::str(image.failure);
}

// Without an output folder nothing is written.
py::dict registerImages(const std::string& database, const std::string& input, const std::string& output,
                        const std::optional<std::vector<std::string>>& names, const py::dict& optionDict, bool useRawMatches,
                        int minMatches, const std::string& page, const std::string& imageFolder) {
  sfm::RegistrationOptions options;
  options.localization = optionsOf(optionDict);
  options.threads = options.localization.ransac.threads;
  options.localization.ransac.threads = 1;  // several images at once instead
  sfm::DatabaseQueryOptions queryOptions;
  if (useRawMatches) queryOptions.table = sfm::MatchTable::Raw;
  if (minMatches < 0) throw std::invalid_argument("min_matches must not be negative, is " + std::to_string(minMatches));
  queryOptions.minMatches = static_cast<std::size_t>(minMatches);
  py::dict results;
  const py::gil_scoped_release release;
  const sfm::SparseModel map = sfm::readModel(input);
  sfm::DatabaseQueries queries(sfm::ColmapDatabase(database), map, queryOptions);
  sfm::SparseModel result = map;
  std::vector<report::ReportedImage> images;
  bool isInterrupted = false;
  sfm::RegistrationWatch watch;
  watch.isCancelled = [&] {
    const py::gil_scoped_acquire acquire;
    isInterrupted = isInterrupted || PyErr_CheckSignals() != 0;
    return isInterrupted;
  };
  const auto use = [&](sfm::RegisteredImage& image) {
    if (image.success()) addToModel(result, image.query, *image.localization);
    if (!page.empty()) addImage(images, reportedImage(map, image));
    const py::gil_scoped_acquire acquire;
    results[py::str(image.name)] = valuesOf(map, image);
  };
  sfm::registerImages(map, queries, names ? *names : queries.namesNotInMap(), options, use, watch);
  if (isInterrupted) {
    const py::gil_scoped_acquire acquire;
    throw py::error_already_set();
  }
  report::PageOptions pageOptions;
  pageOptions.imageFolder = imageFolder;
  if (!page.empty()) writePage(page, map, images, pageOptions);
  if (output.empty()) return results;
  std::filesystem::create_directories(output);
  sfm::writeColmapBinary(output, result);
  return results;
}

}  // namespace

void addRegistration(py::module_& module) {
  module.def("register_images", &registerImages, py::arg("database_path"), py::arg("input_path"), py::arg("output_path"),
             py::arg("image_names"), py::arg("options"), py::arg("use_raw_matches"), py::arg("min_matches"), py::arg("html_path"),
             py::arg("image_path"));
}

}  // namespace python
}  // namespace hybridgv

#include "PageFiles.hpp"

#include <filesystem>

namespace program {

void addPageOptions(CLI::App& app, PageFiles& files) {
  app.add_option("--html_path", files.html,
                 "also write a page to look at the result: the map, the localized images, their correspondences");
  app.add_option("--image_path", files.images, "folder of the query images (JPEG, PNG), for the page");
  app.add_option("--ply_path", files.ply, "also write the map's points and all cameras as a point cloud");
}

std::string findContradiction(const PageFiles& files) {
  // COLMAP's project files name the folder in any case.
  if (files.images.empty() || files.html.empty()) return {};
  return std::filesystem::is_directory(files.images) ? std::string() : "--image_path: " + quoted(files.images) + " is no folder";
}

void writePageFiles(const PageFiles& files, const hybridgv::sfm::SparseModel& map,
                    const std::vector<hybridgv::report::ReportedImage>& images) {
  hybridgv::report::PageOptions options;
  options.imageFolder = files.images;
  if (!files.html.empty()) writePage(files.html, map, images, options);
  if (!files.ply.empty()) writePly(files.ply, map, images);
}

}  // namespace program

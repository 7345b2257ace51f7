// The picture of a result: the options of the commands that draw it.
#pragma once

#include <hybridgv/adapters/report/Page.hpp>

#include <string>
#include <vector>

#include "common/CommandLine.hpp"

namespace program {

struct PageFiles {
  std::string html, images, ply;

  bool areWanted() const { return !html.empty() || !ply.empty(); }
};

void addPageOptions(CLI::App& app, PageFiles& files);

// Empty, or what does not fit together.
std::string findContradiction(const PageFiles& files);

void writePageFiles(const PageFiles& files, const hybridgv::sfm::SparseModel& map,
                    const std::vector<hybridgv::report::ReportedImage>& images);

}  // namespace program

// The query images that a page shows.
#pragma once

#include <cstddef>
#include <string>

#include "hybridgv/adapters/report/Page.hpp"

namespace hybridgv {
namespace report {

class PageImages {
 public:
  PageImages(const std::string& page, const PageOptions& options) : page_(page), options_(options) {}
  // What the page shows: a data URL, a relative link, or nothing.
  std::string addressOf(const std::string& name);

 private:
  const std::string& page_;
  const PageOptions& options_;
  std::size_t bytes_ = 0;
};

}  // namespace report
}  // namespace hybridgv

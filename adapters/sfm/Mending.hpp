// Counts what a reader mends, or refuses it.
#pragma once

#include "hybridgv/adapters/sfm/FileError.hpp"
#include "hybridgv/adapters/sfm/ReadReport.hpp"

namespace hybridgv {
namespace sfm {

class Mending {
 public:
  // `report` may be null.
  Mending(const ReadOptions& options, ReadReport* report) : options_(options), report_(report != nullptr ? *report : own_) {
    report_ = ReadReport();
  }
  Mending(const Mending&) = delete;
  Mending& operator=(const Mending&) = delete;

  // To be called before mending: counts it, and throws the error in strict mode. `error()` makes the FileError; it is called for
  // the first of a kind only, since a file may have a million.
  template <class MakeError>
  void note(Mend mend, const MakeError& error) {
    const auto kind = static_cast<std::size_t>(mend);
    if (options_.strict) throw error();
    if (report_.counts[kind]++ == 0) report_.firstPlaces[kind] = error().what();
  }

  const ReadOptions& options() const { return options_; }
  ReadReport& report() { return report_; }

 private:
  ReadOptions options_;
  ReadReport own_;
  ReadReport& report_;
};

}  // namespace sfm
}  // namespace hybridgv

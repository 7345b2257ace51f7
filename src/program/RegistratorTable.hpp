// What image_registrator prints: a row for each image, and a summary with the reasons of failures.
#pragma once

#include <hybridgv/adapters/sfm/localizeQuery.hpp>

#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace program {

class RegistratorTable {
 public:
  // `localization` is null if the image could not be read, for the reason `failure`.
  void add(const std::string& name, const hybridgv::sfm::QueryLocalization* localization, const std::string& failure);
  void note(const std::string& text) { notes_.insert(text); }
  // The row of the image that was added last, and the header before the first.
  void printLast();
  // `interruptedOf`: how many images there were to be, 0 if all had their turn.
  void printSummary(std::FILE* file, std::size_t skipped, std::size_t interruptedOf) const;

  std::size_t registered() const { return registered_; }

 private:
  std::string row_;
  bool hasHeader_ = false;
  std::size_t count_ = 0, registered_ = 0, lostDistortions_ = 0;
  std::map<std::string, std::vector<std::string>> failures_;  // names by reason
  std::set<std::string> notes_;
};

}  // namespace program

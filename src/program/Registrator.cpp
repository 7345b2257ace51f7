#include "Registrator.hpp"

#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/adapters/sfm/addToModel.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "LocalizationJson.hpp"
#include "OutputFile.hpp"
#include "RegistratorArguments.hpp"
#include "RegistratorTable.hpp"
#include "common/CommandLine.hpp"
#include "common/ProgressBar.hpp"
#include "common/parallelFor.hpp"
#include "poseNumbers.hpp"

namespace program {
namespace {

using namespace hybridgv::sfm;

volatile std::sig_atomic_t interrupted = 0;
extern "C" void interrupt(int) { interrupted = 1; }

// One image: what was found, or why there is nothing.
struct Outcome {
  std::string name, failure;
  QueryImage query;
  std::unique_ptr<QueryLocalization> localization;  // null: it could not be read

  bool success() const { return localization && localization->success; }
  std::string reason() const { return localization ? localization->reason : failure; }
};

class Registration {
 public:
  explicit Registration(const RegistratorArguments& arguments)
      : arguments_(arguments),
        options_(arguments.localization),
        map_(read()),
        queries_(ColmapDatabase(arguments.database), map_, arguments.queries),
        threads_(arguments.threads > 0 ? arguments.threads
                                       : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))) {}

  int run() {
    names_ = wanted();
    openOutputs();
    options_.estimateDistortion = arguments_.estimateDistortion;
    if (names_.size() > kFewQueries) options_.matches.certainPoints = findCertainPoints(map_, options_.matches);
    findCommonCameras();
    SparseModel result = map_;
    localizeAll(names_, "", [&](Outcome& outcome) {
      if (outcome.success()) addToModel(result, outcome.query, *outcome.localization);
      report(outcome);
    });
    finish(result);
    if (interrupted != 0) return kInterrupted;
    return arguments_.requireAll && table_.registered() < names_.size() ? kNotAll : 0;
  }

 private:
  SparseModel read() const {
    ReadReport report;
    SparseModel map = readModel(arguments_.input, {}, &report);
    if (!arguments_.quiet)
      for (const std::string& sentence : report.sentences()) std::fprintf(stderr, "hybridgv: %s\n", sentence.c_str());
    return map;
  }

  // The names of the images to register; those that the map has already are skipped, so that a run can be continued.
  std::vector<std::string> wanted() {
    const std::vector<std::string> missing = queries_.namesNotInMap();
    if (arguments_.imageList.empty()) return missing;
    const std::set<std::string> isMissing(missing.begin(), missing.end());
    std::set<std::string> seen;
    std::vector<std::string> names;
    for (const std::string& name : readList()) {
      if (queries_.database().findImage(name) == nullptr)
        throw std::runtime_error(arguments_.database + " has no image " + quoted(name));
      if (!seen.insert(name).second) continue;
      if (isMissing.count(name) != 0)
        names.push_back(name);
      else
        ++skipped_;
    }
    return names;
  }

  std::vector<std::string> readList() const {
    if (arguments_.imageList == "-") return readLines(std::cin);
    std::ifstream in(arguments_.imageList);
    if (!in) throw std::runtime_error(arguments_.imageList + ": cannot be opened");
    return readLines(in);
  }

  void openOutputs() {
    if (!arguments_.output.empty()) std::filesystem::create_directories(arguments_.output);
    if (!arguments_.results.empty()) results_ = std::make_unique<OutputFile>(arguments_.results);
    if (!arguments_.json.empty() && arguments_.json != "-") json_ = std::make_unique<OutputFile>(arguments_.json);
  }

  // Images that share a camera of which nothing is known agree on it first.
  void findCommonCameras() {
    std::map<std::uint32_t, std::vector<std::string>> byCamera;
    for (const std::string& name : names_) byCamera[queries_.database().findImage(name)->camera].push_back(name);
    std::vector<std::string> shared;
    for (const auto& [camera, names] : byCamera)
      if (names.size() > 1) shared.insert(shared.end(), names.begin(), names.end());
    std::map<std::uint32_t, std::vector<CameraEstimate>> estimates;
    localizeAll(shared, "cameras: ", [&](const Outcome& outcome) {
      if (outcome.success() && outcome.query.knowledge != CameraKnowledge::Known)
        estimates[queries_.database().findImage(outcome.name)->camera].push_back(estimateOf(*outcome.localization));
    });
    for (const auto& [camera, all] : estimates) common_[camera] = agree(all);
  }

  // Several images at once; what is done with them is done in their order, so that the number of threads does not matter.
  template <class Use>
  void localizeAll(const std::vector<std::string>& names, const char* what, const Use& use) {
    constexpr std::size_t kPerThread = 8;
    const std::size_t batch = kPerThread * static_cast<std::size_t>(threads_);
    ProgressBar progress(names.size(), !arguments_.quiet, what);
    progress_ = &progress;
    for (std::size_t first = 0; first < names.size() && interrupted == 0; first += batch) {
      std::vector<Outcome> outcomes(std::min(batch, names.size() - first));
      parallelFor(outcomes.size(), threads_, [&](std::size_t i) {
        outcomes[i] = localize(names[first + i]);
        progress.step();
      });
      for (Outcome& outcome : outcomes) use(outcome);
    }
    progress_ = nullptr;
  }

  Outcome localize(const std::string& name) {
    Outcome outcome;
    outcome.name = name;
    try {
      std::optional<CameraEstimate> common;
      {
        const std::lock_guard<std::mutex> lock(databaseMutex_);
        outcome.query = queries_.read(name);
        const auto found = common_.find(queries_.database().findImage(name)->camera);
        if (found != common_.end()) common = found->second;
      }
      localize(common, outcome);
    } catch (const std::exception& error) {  // of this image alone
      outcome.failure = error.what();
    }
    return outcome;
  }

  void localize(const std::optional<CameraEstimate>& common, Outcome& outcome) const {
    if (!arguments_.estimateFocalLength) outcome.query.knowledge = CameraKnowledge::Known;
    QueryOptions options = options_;
    const double side = static_cast<double>(std::max(outcome.query.camera.width, outcome.query.camera.height));
    if (side > 0) {
      options.ransac.minFocalLength = arguments_.minFocalRatio * side;
      options.ransac.maxFocalLength = arguments_.maxFocalRatio * side;
    }
    outcome.localization = std::make_unique<QueryLocalization>(common ? localizeQuery(map_, outcome.query, *common, options)
                                                                      : localizeQuery(map_, outcome.query, options));
    QueryLocalization& found = *outcome.localization;
    if (found.success && std::abs(found.k1) > arguments_.maxDistortion) {
      found.success = false;
      found.reason = "the distortion found is larger than --Mapper.max_extra_param";
    }
  }

  void report(const Outcome& outcome) {
    if (outcome.localization && results_ && outcome.success()) {
      std::string line = outcome.name;
      for (const double value : poseNumbers(outcome.localization->result.pose)) line += " " + inDigits(value);
      results_->write(line + "\n");
    }
    if (!arguments_.json.empty()) {
      const std::string line =
          outcome.localization ? toJsonLine(map_, *outcome.localization) : toJsonLine(outcome.name, outcome.failure);
      if (json_)
        json_->write(line + "\n");
      else
        print([&] { std::printf("%s\n", line.c_str()); });
    }
    table_.add(outcome.name, outcome.localization.get(), outcome.failure);
    for (const std::string& note : outcome.query.notes) table_.note(note);
    if (!arguments_.quiet && arguments_.json != "-") print([&] { table_.printLast(); });
  }

  template <class Print>
  void print(const Print& printIt) {
    if (progress_ != nullptr) progress_->clear();
    printIt();
    flushOutput();
  }

  void finish(const SparseModel& result) {
    if (!arguments_.output.empty())
      (arguments_.outputType == "BIN" ? writeColmapBinary : writeColmapText)(arguments_.output, result);
    if (results_) results_->commit();
    if (json_) json_->commit();
    if (!arguments_.quiet) table_.printSummary(stderr, skipped_, interrupted != 0 ? names_.size() : 0);
  }

  // So few do not meet all points of the map.
  static constexpr std::size_t kFewQueries = 20;

  const RegistratorArguments& arguments_;
  QueryOptions options_;
  const SparseModel map_;
  DatabaseQueries queries_;
  const int threads_;
  std::mutex databaseMutex_;
  std::vector<std::string> names_;
  std::size_t skipped_ = 0;
  std::map<std::uint32_t, std::optional<CameraEstimate>> common_;  // by camera of the database
  std::unique_ptr<OutputFile> results_, json_;
  ProgressBar* progress_ = nullptr;
  RegistratorTable table_;
};

}  // namespace

int runRegistrator(std::vector<std::string> arguments) {
  RegistratorArguments parsed;
  const int exitCode = parseRegistrator(std::move(arguments), parsed);
  if (exitCode >= 0) return exitCode;
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  return Registration(parsed).run();
}

}  // namespace program

#include "Registrator.hpp"

#include <hybridgv/adapters/colmap/registerImages.hpp>
#include <hybridgv/adapters/sfm/ModelFiles.hpp>
#include <hybridgv/adapters/sfm/addToModel.hpp>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>

#include "LocalizationJson.hpp"
#include "OutputFile.hpp"
#include "RegistratorArguments.hpp"
#include "RegistratorTable.hpp"
#include "common/CommandLine.hpp"
#include "common/ProgressBar.hpp"
#include "poseNumbers.hpp"

namespace program {
namespace {

using namespace hybridgv::sfm;

volatile std::sig_atomic_t interrupted = 0;
extern "C" void interrupt(int) { interrupted = 1; }

class Registration {
 public:
  explicit Registration(const RegistratorArguments& arguments)
      : arguments_(arguments), map_(read()), queries_(ColmapDatabase(arguments.database), map_, arguments.queries) {}

  int run() {
    names_ = wanted();
    openOutputs();
    SparseModel result = map_;
    registerImages(
        map_, queries_, names_, arguments_.registration,
        [&](RegisteredImage& image) {
          if (image.success()) addToModel(result, image.query, *image.localization);
          report(image);
        },
        watch());
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
    std::vector<std::string> missing = queries_.namesNotInMap();
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

  RegistrationWatch watch() {
    RegistrationWatch watch;
    watch.begin = [this](const char* pass, std::size_t count) {
      const bool isFirst = std::string(pass) == "cameras";
      progress_ = std::make_unique<ProgressBar>(count, !arguments_.quiet, isFirst ? "cameras: " : "");
    };
    watch.step = [this] { progress_->step(); };
    watch.end = [this] { progress_.reset(); };
    watch.isCancelled = [] { return interrupted != 0; };
    return watch;
  }

  void report(const RegisteredImage& outcome) {
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
    if (arguments_.page.areWanted()) addImage(reported_, reportedImage(map_, outcome));
    table_.add(outcome.name, outcome.localization.get(), outcome.failure);
    for (const std::string& note : outcome.query.notes) table_.note(note);
    if (!arguments_.quiet && arguments_.json != "-") print([&] { table_.printLast(); });
  }

  template <class Print>
  void print(const Print& printIt) {
    if (progress_) progress_->clear();
    printIt();
    flushOutput();
  }

  void finish(const SparseModel& result) {
    if (!arguments_.output.empty())
      (arguments_.outputType == "BIN" ? writeColmapBinary : writeColmapText)(arguments_.output, result);
    if (results_) results_->commit();
    if (json_) json_->commit();
    writePageFiles(arguments_.page, map_, reported_);
    if (!arguments_.quiet) table_.printSummary(stderr, skipped_, interrupted != 0 ? names_.size() : 0);
  }

  const RegistratorArguments& arguments_;
  const SparseModel map_;
  DatabaseQueries queries_;
  std::vector<std::string> names_;
  std::size_t skipped_ = 0;
  std::unique_ptr<OutputFile> results_, json_;
  std::unique_ptr<ProgressBar> progress_;
  std::vector<hybridgv::report::ReportedImage> reported_;
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

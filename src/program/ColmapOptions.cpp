#include "ColmapOptions.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "common/CommandLine.hpp"

namespace program {
namespace {

// Options of COLMAP's image_registrator, up to 4.1, that are about what is not done here: bundle adjustment, triangulation, several
// models, pictures, logging.
bool isUnused(const std::string& name) {
  static const std::vector<std::string> kNames{"random_seed",
                                               "default_random_seed",
                                               "log_to_stderr",
                                               "log_level",
                                               "log_target",
                                               "Mapper.multiple_models",
                                               "Mapper.max_num_models",
                                               "Mapper.max_model_overlap",
                                               "Mapper.min_model_size",
                                               "Mapper.extract_colors",
                                               "Mapper.image_path",
                                               "Mapper.fix_existing_images",
                                               "Mapper.fix_existing_frames",
                                               "Mapper.max_reg_trials",
                                               "Mapper.max_runtime_seconds",
                                               "Mapper.random_seed",
                                               "Mapper.constant_rigs",
                                               "Mapper.constant_cameras",
                                               "Mapper.use_prior_position",
                                               "Mapper.use_robust_loss_on_prior_position",
                                               "Mapper.prior_position_loss_scale",
                                               "Mapper.structure_less_registration_fallback",
                                               "Mapper.structure_less_registration_only"};
  static const std::vector<std::string> kBeginnings{"Mapper.ba_",       "Mapper.tri_",      "Mapper.init_",     "Mapper.filter_",
                                                    "Mapper.local_ba_", "Mapper.snapshot_", "Mapper.image_list"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end() ||
         std::any_of(kBeginnings.begin(), kBeginnings.end(), [&](const std::string& b) { return name.rfind(b, 0) == 0; });
}

// "name" of "--name" and "--name=value"; empty for anything else.
std::string optionName(const std::string& argument) {
  return argument.rfind("--", 0) == 0 ? argument.substr(2, argument.find('=') - 2) : std::string();
}

std::vector<std::string> readProjectFile(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path + ": cannot be opened");
  std::vector<std::string> options;
  std::string section;
  for (const std::string& line : readLines(in)) {
    if (line[0] == '#' || line[0] == ';') continue;
    if (line.front() == '[' && line.back() == ']') {
      section = line.substr(1, line.size() - 2) + ".";
      continue;
    }
    const std::size_t sign = line.find('=');
    if (sign == std::string::npos) throw std::runtime_error(path + ": " + quoted(line) + " is no line of a project file");
    const std::string key = line.substr(0, line.find_last_not_of(" \t", sign - 1) + 1);
    const std::size_t start = line.find_first_not_of(" \t", sign + 1);
    // The file may be one of the whole reconstruction: other programs' sections do not matter.
    const bool isOther = !section.empty() && section != "Mapper.";
    if (!isOther && start != std::string::npos) options.push_back("--" + section + key + "=" + line.substr(start));
  }
  return options;
}

}  // namespace

std::vector<std::string> takeUnusedOptions(std::vector<std::string>& arguments) {
  std::vector<std::string> kept, names;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string name = optionName(arguments[i]);
    if (!isUnused(name)) {
      kept.push_back(arguments[i]);
      continue;
    }
    names.push_back(name);
    const bool hasValue = arguments[i].find('=') != std::string::npos;
    if (!hasValue && i + 1 < arguments.size() && optionName(arguments[i + 1]).empty()) ++i;
  }
  arguments = std::move(kept);
  return names;
}

void insertProjectFile(std::vector<std::string>& arguments) {
  const auto isProject = [](const std::string& a) { return optionName(a) == "project_path"; };
  const auto place = std::find_if(arguments.begin(), arguments.end(), isProject);
  if (place == arguments.end()) return;
  const std::size_t sign = place->find('=');
  const auto next = std::next(place);
  if (sign == std::string::npos && next == arguments.end()) throw std::runtime_error("--project_path: names no file");
  const std::string path = sign == std::string::npos ? *next : place->substr(sign + 1);
  arguments.erase(place, sign == std::string::npos ? std::next(next) : next);
  for (const std::string& option : readProjectFile(path)) {
    const std::string name = optionName(option);
    const auto isGiven = [&](const std::string& a) { return optionName(a) == name; };
    if (std::none_of(arguments.begin(), arguments.end(), isGiven)) arguments.push_back(option);
  }
}

}  // namespace program

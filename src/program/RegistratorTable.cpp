#include "RegistratorTable.hpp"

#include <algorithm>

#include "common/CommandLine.hpp"

namespace program {
namespace {

constexpr std::size_t kNameWidth = 30;

// "12/40"
std::string share(int inliers, std::size_t all) { return std::to_string(inliers) + "/" + std::to_string(all); }

std::string padded(const std::string& name) {
  std::string result = shortened(name, kNameWidth);
  result.resize(std::max(result.size(), kNameWidth), ' ');
  return result;
}

// The part of a reason that does not change from image to image, for the summary.
std::string withoutNumbers(const std::string& reason) { return reason.substr(0, reason.find(" (")); }

}  // namespace

void RegistratorTable::add(const std::string& name, const hybridgv::sfm::QueryLocalization* localization,
                           const std::string& failure) {
  ++count_;
  row_ = padded(name);
  if (localization == nullptr || !localization->success) {
    const std::string& reason = localization == nullptr ? failure : localization->reason;
    failures_[withoutNumbers(reason)].push_back(name);
    row_ += "  not registered: " + reason;
    return;
  }
  ++registered_;
  lostDistortions_ += localization->distortionIsLost ? 1 : 0;
  const hybridgv::sac::HybridRansacResult& result = localization->result;
  const auto isUsed = [](const hybridgv::sfm::PairReport& pair) { return pair.inliers2d2d + pair.inliers2d3d > 0; };
  const auto images = std::count_if(localization->pairs.begin(), localization->pairs.end(), isUsed);
  char text[128];
  std::snprintf(text, sizeof text, " %9.2f %7.2f %8.4f %11s %11s %6d", focalLength(localization->camera),
                result.focalLengthStandardDeviation, localization->k1,
                share(result.numberInliers2d2d, result.inliers2d2d.size()).c_str(),
                share(result.numberInliers2d3d, result.inliers2d3d.size()).c_str(), static_cast<int>(images));
  row_ += text;
}

void RegistratorTable::printLast() {
  if (!hasHeader_)
    std::printf("%-30s %9s %7s %8s %11s %11s %6s\n", "image", "f [px]", "+-", "k1", "2D-2D in", "2D-3D in", "images");
  hasHeader_ = true;
  std::printf("%s\n", row_.c_str());
}

void RegistratorTable::printSummary(std::FILE* file, std::size_t skipped, std::size_t interruptedOf) const {
  constexpr std::size_t kMostNames = 5, kMostNotes = 20;
  std::fprintf(file, "hybridgv: registered %zu of %zu images", registered_, interruptedOf > 0 ? interruptedOf : count_);
  if (skipped > 0) std::fprintf(file, "; %zu more are in the map already", skipped);
  std::fprintf(file, "\n");
  if (interruptedOf > 0) std::fprintf(file, "hybridgv: interrupted after %zu images\n", count_);
  for (const auto& [reason, names] : failures_) {
    std::fprintf(file, "hybridgv: %zu not registered, %s:", names.size(), reason.c_str());
    for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) std::fprintf(file, " %s", names[i].c_str());
    if (names.size() > kMostNames) std::fprintf(file, " and %zu more", names.size() - kMostNames);
    std::fprintf(file, "\n");
  }
  if (lostDistortions_ > 0)
    std::fprintf(
        file,
        "hybridgv: the camera model of %zu images (SIMPLE_PINHOLE, PINHOLE) has no place for the distortion that was found: "
        "their poses are those of undistorted images; SIMPLE_RADIAL has one\n",
        lostDistortions_);
  std::size_t printed = 0;
  for (const std::string& note : notes_)
    if (printed++ < kMostNotes) std::fprintf(file, "hybridgv: %s\n", note.c_str());
  if (notes_.size() > kMostNotes) std::fprintf(file, "hybridgv: and %zu more notes\n", notes_.size() - kMostNotes);
}

}  // namespace program

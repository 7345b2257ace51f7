#include "hybridgv/adapters/colmap/registerImages.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "hybridgv/detail/format.hpp"
#include "hybridgv/detail/parallelFor.hpp"

namespace hybridgv {
namespace sfm {
namespace {

int threadsOf(const RegistrationOptions& options) {
  return options.threads > 0 ? options.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void check(const RegistrationOptions& options) {
  if (options.threads < 0)
    throw std::invalid_argument("options.threads must not be negative, is " + std::to_string(options.threads));
  if (!(options.minFocalRatio > 0 && options.minFocalRatio < options.maxFocalRatio))
    throw std::invalid_argument("options.minFocalRatio must be positive and below options.maxFocalRatio, they are " +
                                detail::format(options.minFocalRatio) + " and " + detail::format(options.maxFocalRatio));
  if (!(options.maxDistortion >= 0))
    throw std::invalid_argument("options.maxDistortion must not be negative, is " + detail::format(options.maxDistortion));
}

class Registration {
 public:
  Registration(const SparseModel& map, DatabaseQueries& queries, const RegistrationOptions& options,
               const RegistrationWatch& watch)
      : map_(map), queries_(queries), options_(options), watch_(watch), threads_(threadsOf(options)) {}

  void run(const std::vector<std::string>& names, const std::function<void(RegisteredImage&)>& use) {
    for (const std::string& name : names) cameraOf(name);
    QueryOptions& localization = options_.localization;
    if (names.size() > kFewQueries && !localization.matches.certainPoints)
      localization.matches.certainPoints = findCertainPoints(map_, localization.matches);
    findCommonCameras(names);
    localizeAll("images", names, use);
  }

 private:
  std::uint32_t cameraOf(const std::string& name) const {
    const DatabaseImage* image = queries_.database().findImage(name);
    if (image == nullptr) throw std::invalid_argument(queries_.database().path() + " has no image " + name);
    return image->camera;
  }

  // Images that share a camera of which nothing is known agree on it first.
  void findCommonCameras(const std::vector<std::string>& names) {
    std::map<std::uint32_t, std::vector<std::string>> byCamera;
    for (const std::string& name : names) byCamera[cameraOf(name)].push_back(name);
    std::vector<std::string> shared;
    for (const auto& [camera, ofCamera] : byCamera)
      if (ofCamera.size() > 1) shared.insert(shared.end(), ofCamera.begin(), ofCamera.end());
    std::map<std::uint32_t, std::vector<CameraEstimate>> estimates;
    localizeAll("cameras", shared, [&](const RegisteredImage& image) {
      if (image.success() && image.query.knowledge != CameraKnowledge::Known)
        estimates[cameraOf(image.name)].push_back(estimateOf(*image.localization));
    });
    for (const auto& [camera, all] : estimates) common_[camera] = agree(all);
  }

  // Several images at once; what is done with them is done in their order, so that the number of threads does not matter.
  template <class Use>
  void localizeAll(const char* pass, const std::vector<std::string>& names, const Use& use) {
    constexpr std::size_t kPerThread = 8;
    const std::size_t batch = kPerThread * static_cast<std::size_t>(threads_);
    if (watch_.begin) watch_.begin(pass, names.size());
    for (std::size_t first = 0; first < names.size() && !isCancelled(); first += batch) {
      std::vector<RegisteredImage> images(std::min(batch, names.size() - first));
      detail::parallelFor(images.size(), threads_, [&](std::size_t i) {
        images[i] = localize(names[first + i]);
        if (watch_.step) watch_.step();
      });
      for (RegisteredImage& image : images) use(image);
    }
    if (watch_.end) watch_.end();
  }

  bool isCancelled() const { return watch_.isCancelled && watch_.isCancelled(); }

  RegisteredImage localize(const std::string& name) {
    RegisteredImage image;
    image.name = name;
    try {
      std::optional<CameraEstimate> common;
      {
        const std::lock_guard<std::mutex> lock(databaseMutex_);
        image.query = queries_.read(name);
        const auto found = common_.find(cameraOf(name));
        if (found != common_.end()) common = found->second;
      }
      localize(common, image);
    } catch (const std::exception& error) {  // of this image alone
      image.failure = error.what();
    }
    return image;
  }

  void localize(const std::optional<CameraEstimate>& common, RegisteredImage& image) const {
    if (!options_.estimateFocalLength) image.query.knowledge = CameraKnowledge::Known;
    QueryOptions options = options_.localization;
    const double side = static_cast<double>(std::max(image.query.camera.width, image.query.camera.height));
    if (side > 0) {
      options.ransac.minFocalLength = std::max(options.ransac.minFocalLength, options_.minFocalRatio * side);
      options.ransac.maxFocalLength = std::min(options.ransac.maxFocalLength, options_.maxFocalRatio * side);
    }
    image.localization = std::make_unique<QueryLocalization>(common ? localizeQuery(map_, image.query, *common, options)
                                                                    : localizeQuery(map_, image.query, options));
    QueryLocalization& found = *image.localization;
    if (found.success && std::abs(found.k1) > options_.maxDistortion) {
      found.success = false;
      found.reason = "the distortion found is larger than " + detail::format(options_.maxDistortion);
    }
  }

  // So few do not meet all points of the map.
  static constexpr std::size_t kFewQueries = 20;

  const SparseModel& map_;
  DatabaseQueries& queries_;
  RegistrationOptions options_;
  const RegistrationWatch& watch_;
  const int threads_;
  std::mutex databaseMutex_;
  std::map<std::uint32_t, std::optional<CameraEstimate>> common_;  // by camera of the database
};

}  // namespace

bool RegisteredImage::success() const { return localization && localization->success; }

report::ReportedImage reportedImage(const SparseModel& map, const RegisteredImage& image) {
  if (image.localization) return report::reportedImage(map, image.query, *image.localization);
  report::ReportedImage failed;
  failed.name = image.name;
  failed.reason = image.failure;
  return failed;
}

void registerImages(const SparseModel& map, DatabaseQueries& queries, const std::vector<std::string>& names,
                    const RegistrationOptions& options, const std::function<void(RegisteredImage&)>& use,
                    const RegistrationWatch& watch) {
  check(options);
  Registration(map, queries, options, watch).run(names, use);
}

}  // namespace sfm
}  // namespace hybridgv

/// \file
/// \brief Localizes images of a COLMAP database against a map, many at once.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hybridgv/adapters/colmap/DatabaseQueries.hpp"
#include "hybridgv/adapters/report/Page.hpp"
#include "hybridgv/adapters/sfm/QueryImage.hpp"
#include "hybridgv/adapters/sfm/SparseModel.hpp"
#include "hybridgv/adapters/sfm/localizeQuery.hpp"
#include "hybridgv/export.hpp"

namespace hybridgv {
namespace sfm {

/// How images are registered.
struct RegistrationOptions {
  QueryOptions localization;        ///< of each image; of the focal length's bounds and the ratios below the narrower ones count
  double minFocalRatio = 0.1;       ///< smallest focal length, of the longer side of the image
  double maxFocalRatio = 10;        ///< largest focal length, of the longer side of the image
  double maxDistortion = 1;         ///< an image with a larger |k1| is not registered
  bool estimateFocalLength = true;  ///< false: the cameras of the database are right
  int threads = 0;                  ///< images localized at once; 0 = one for each processor core
};

/// One image: what was found, or why there is nothing.
struct HYBRIDGV_EXPORT RegisteredImage {
  std::string name;                                 ///< in the database
  std::string failure;                              ///< why it could not be read; else empty
  QueryImage query;                                 ///< the image with its matches
  std::unique_ptr<QueryLocalization> localization;  ///< null if it could not be read

  bool success() const;  ///< whether it was localized
};

/// For the page of a result: the image, or why it could not be read.
/// \throws std::invalid_argument if the image was localized in another map
HYBRIDGV_EXPORT report::ReportedImage reportedImage(const SparseModel& map, const RegisteredImage& image);

/// What is told while images are localized.
struct RegistrationWatch {
  /// A pass over so many images begins: over those that share a camera first ("cameras"), then over all ("images").
  std::function<void(const char* pass, std::size_t count)> begin = {};
  std::function<void()> step = {};         ///< one more image is done; called by several threads
  std::function<void()> end = {};          ///< the pass is over
  std::function<bool()> isCancelled = {};  ///< true: no further images are begun
};

/// Localizes images of a database, those of one camera of which nothing is known with a camera on which they agree() first.
///
/// \param map      that of `queries`
/// \param queries  the database
/// \param names    of images of the database
/// \param use      is given every image, in the order of the names whatever the number of threads, by the calling thread
/// \throws std::invalid_argument for options that make no sense and names that the database does not have; what is wrong with one image
///         is its `failure`
HYBRIDGV_EXPORT void registerImages(const SparseModel& map, DatabaseQueries& queries, const std::vector<std::string>& names,
                                    const RegistrationOptions& options, const std::function<void(RegisteredImage&)>& use,
                                    const RegistrationWatch& watch = {});

}  // namespace sfm
}  // namespace hybridgv

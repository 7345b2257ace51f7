#include <optional>

#include "ReaderFuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hybridgv;
  using Problem = std::optional<sfm::LocalizationProblem>;
  bool isRead = false;
  const auto read = [](const std::string& path) { return Problem(sfm::readProblem(path)); };
  const Problem problem = fuzz::readOrFileError(fuzz::writeFile(data, size), read, isRead);
  if (!isRead) return 0;
  const std::string copy = fuzz::folder().file("copy");
  sfm::writeProblem(copy, *problem);
  const sfm::LocalizationProblem again = sfm::readProblem(copy);
  if (again.adapter.getNumberCorrespondences2d2d() != problem->adapter.getNumberCorrespondences2d2d() ||
      again.adapter.getNumberCorrespondences2d3d() != problem->adapter.getNumberCorrespondences2d3d())
    fuzz::reportFault("what is written is read again");
  sfm::injectOutliers(*problem, 0.5, 1);
  return 0;
}

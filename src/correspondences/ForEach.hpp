// A loop whose turns do not depend on each other, so that threads may share it.
#pragma once

#include <functional>

namespace hybridgv {
namespace correspondences {

// Calls body(i) for i = 0 .. count-1, in any order and perhaps several at the same time. Of exceptions, that of the least i is thrown.
using ForEach = std::function<void(int count, const std::function<void(int i)>& body)>;

inline void oneByOne(int count, const std::function<void(int i)>& body) {
  for (int i = 0; i < count; ++i) body(i);
}

}  // namespace correspondences
}  // namespace hybridgv

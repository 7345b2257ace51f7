// A vector whose entries are not set when they are made. To set millions of them to 0 before they get their values takes as long as to
// set the values, and happens in one thread.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace hybridgv {
namespace correspondences {

template <class Value>
class UnsetAllocator : public std::allocator<Value> {
 public:
  template <class Other>
  struct rebind {
    using other = UnsetAllocator<Other>;
  };
  UnsetAllocator() = default;
  template <class Other>
  UnsetAllocator(const UnsetAllocator<Other>&) noexcept {}

  template <class Other>
  void construct(Other* place) {
    ::new (static_cast<void*>(place)) Other;
  }
  template <class Other, class... Arguments>
  void construct(Other* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) Other(std::forward<Arguments>(arguments)...);
  }
};

template <class Value>
using UnsetVector = std::vector<Value, UnsetAllocator<Value>>;

}  // namespace correspondences
}  // namespace hybridgv

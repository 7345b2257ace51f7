/// \file
/// \brief A loop whose rounds are shared by several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace hybridgv {
namespace detail {

/// Calls body(0) .. body(count - 1), each once, in any order. `body` must not throw.
template <class Body>
void parallelFor(std::size_t count, int threads, const Body& body) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) body(i);
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

}  // namespace detail
}  // namespace hybridgv

// Threads that share the work of a loop.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hybridgv {
namespace robust {

class WorkerPool {
 public:
  // 0: one per processor core. The calling thread is one of them.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  using Body = std::function<void(int i, std::size_t worker)>;

  std::size_t size() const { return workers_.size() + 1; }
  // Calls body(i, worker) for i = 0 .. count-1, in any order and in parallel, worker in 0 .. size()-1 being the thread that
  // calls; returns when all are done. The body must not throw.
  void forEach(int count, const Body& body);

 private:
  void work(std::size_t worker);
  void takeAll(std::size_t worker);

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const Body* body_ = nullptr;
  std::atomic<int> next_{0};
  int count_ = 0, busy_ = 0;
  unsigned round_ = 0;
  bool stop_ = false;
};

}  // namespace robust
}  // namespace hybridgv

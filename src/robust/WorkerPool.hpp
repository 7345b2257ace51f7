// Threads that share the work of a loop.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hybridgv {
namespace robust {

// How many threads to work with, where `threads` are wished for (0: one per processor core) and no more than `mostTasks` tasks are
// ever open at once. Threads beyond a few per core would only cost memory.
std::size_t numberOfWorkers(int threads, int mostTasks);

class WorkerPool {
 public:
  using StartThread = std::function<std::thread(std::function<void()>)>;
  using Body = std::function<void(int i, std::size_t worker)>;

  // The calling thread is one of the `workers` (at least 1). Where the system gives fewer threads, the pool is smaller: size().
  explicit WorkerPool(std::size_t workers);
  // The same with another way to start a thread.
  WorkerPool(std::size_t workers, const StartThread& startThread);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  std::size_t size() const { return threads_.size() + 1; }
  // Calls body(i, worker) for i = 0 .. count-1, in any order and in parallel, worker in 0 .. size()-1 being the thread that
  // calls; returns when all are done. If the body throws, no further calls are begun, and the exception of the least i that threw
  // is thrown here when those under way have ended.
  void forEach(int count, const Body& body);

 private:
  void work(std::size_t worker);
  void takeAll(std::size_t worker);
  void keepException(int i);
  void throwKeptException();

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const Body* body_ = nullptr;
  std::atomic<int> next_{0};
  int count_ = 0, busy_ = 0;
  unsigned round_ = 0;
  bool stop_ = false;
  std::exception_ptr exception_;
  int exceptionIndex_ = 0;
};

}  // namespace robust
}  // namespace hybridgv

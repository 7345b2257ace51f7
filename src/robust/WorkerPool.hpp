// Threads that share the work of a loop.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
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

// The length of the parts of a large sum or loop: some for each of a few threads, but none so short that its start counts.
inline std::size_t partLength(std::size_t size, std::size_t least) {
  constexpr std::size_t kParts = 8, kMost = 2048;
  const std::size_t length = std::min((size + kParts - 1) / kParts, kMost);
  return (length + least - 1) / least * least;
}

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
  // Calls body(i, worker) for i = 0 .. count-1, in any order and in parallel, worker in 0 .. size()-1 being the thread that calls. Returns
  // when all are done, whether or not all threads have come to take part. If the body throws, no further calls are begun, and the
  // exception of the least i that threw is thrown here when those under way have ended. Not from within a body.
  void forEach(int count, const Body& body);

  // Beside the loops, one at a time: a thread with nothing else to do takes the task up. If none has when `finishTask` is called, the caller
  // does it there. An exception of the task is thrown there, too.
  void beginTask(std::function<void()> task);
  void finishTask();
  // The same where the task is not wanted any more: it is not begun, and if it has been, its end is waited for.
  void dropTask();

 private:
  void work(std::size_t worker);
  void takeAll(std::size_t worker);
  void keepException(int i);
  void throwKeptException();
  void waitForWork(unsigned seen, std::unique_lock<std::mutex>& lock);
  void runTask(std::unique_lock<std::mutex>& lock);

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const Body* body_ = nullptr;  // null between the loops
  std::atomic<int> next_{0};
  int count_ = 0;
  // Changed under the mutex.
  std::atomic<int> busy_{0};  // threads that take part
  std::atomic<unsigned> round_{0};
  std::atomic<bool> stop_{false}, hasTask_{false};
  std::exception_ptr exception_;
  int exceptionIndex_ = 0;
  std::function<void()> task_;  // not yet begun
  bool taskIsRunning_ = false;
  std::exception_ptr taskException_;
};

// Both, at the same time if there are workers.
template <class First, class Second>
void both(WorkerPool* workers, First first, Second second) {
  if (workers == nullptr) {
    first();
    second();
  } else {
    workers->forEach(2, [&](int i, std::size_t) { i == 0 ? first() : second(); });
  }
}

// body(i) for i = 0 .. count-1, by the workers if there are any.
template <class Body>
void forAll(WorkerPool* workers, std::size_t count, Body body) {
  if (workers == nullptr)
    for (std::size_t i = 0; i < count; ++i) body(i);
  else
    workers->forEach(static_cast<int>(count), [&](int i, std::size_t) { body(static_cast<std::size_t>(i)); });
}

// body(begin, end) for the parts of 0 .. size-1, which begin at multiples of `least`.
template <class RangeBody>
void forParts(WorkerPool* workers, std::size_t size, std::size_t least, RangeBody body) {
  if (size == 0) return;
  const std::size_t length = partLength(size, least), count = (size + length - 1) / length;
  forAll(workers, count, [&](std::size_t part) { body(part * length, std::min((part + 1) * length, size)); });
}

}  // namespace robust
}  // namespace hybridgv

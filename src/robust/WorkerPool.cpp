#include "robust/WorkerPool.hpp"

#include <algorithm>
#include <utility>

namespace hybridgv {
namespace robust {
namespace {

constexpr int kMostPerCore = 4;

std::thread startThread(std::function<void()> function) { return std::thread(std::move(function)); }

}  // namespace

std::size_t numberOfWorkers(int threads, int mostTasks) {
  if (threads == 1) return 1;  // to count the cores takes longer than many a sample
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int wished = threads > 0 ? threads : cores;
  return static_cast<std::size_t>(std::max(1, std::min({wished, kMostPerCore * cores, mostTasks})));
}

WorkerPool::WorkerPool(std::size_t workers) : WorkerPool(workers, &startThread) {}

WorkerPool::WorkerPool(std::size_t workers, const StartThread& startThread) {
  threads_.reserve(workers - 1);  // nothing but the start of a thread may fail while threads wait
  try {
    for (std::size_t worker = 1; worker < workers; ++worker) threads_.push_back(startThread([this, worker] { work(worker); }));
  } catch (const std::exception&) {
    // The system gives no more threads: those there are do the work, with the same results.
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::forEach(int count, const Body& body) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    body_ = &body;
    count_ = count;
    next_ = 0;
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  start_.notify_all();
  takeAll(0);
  {
    std::unique_lock<std::mutex> lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
  }
  throwKeptException();
}

void WorkerPool::takeAll(std::size_t worker) {
  for (int i = next_++; i < count_; i = next_++) {
    try {
      (*body_)(i, worker);
    } catch (...) {
      keepException(i);
      next_ = count_;
    }
  }
}

// Indices are taken in increasing order: whichever fails first, all smaller ones are under way. So the least one that throws does
// not depend on the threads.
void WorkerPool::keepException(int i) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (exception_ && exceptionIndex_ < i) return;
  exception_ = std::current_exception();
  exceptionIndex_ = i;
}

void WorkerPool::throwKeptException() {
  if (!exception_) return;
  const std::exception_ptr exception = std::exchange(exception_, nullptr);
  std::rethrow_exception(exception);
}

void WorkerPool::work(std::size_t worker) {
  unsigned seen = 0;
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
    }
    takeAll(worker);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace robust
}  // namespace hybridgv

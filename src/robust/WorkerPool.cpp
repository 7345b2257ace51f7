#include "robust/WorkerPool.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace hybridgv {
namespace robust {
namespace {

constexpr int kMostPerCore = 4;

// To wake a thread that sleeps takes longer than many a loop, and the next loop as a rule follows soon. So a thread first waits awake,
// but no longer than this.
constexpr std::chrono::microseconds kAwake{50};

template <class Condition>
void waitAwake(Condition isMet) {
  const auto end = std::chrono::steady_clock::now() + kAwake;
  while (!isMet() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

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
  if (threads_.empty() || count <= 1) {
    for (int i = 0; i < count; ++i) body(i, 0);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    body_ = &body;
    count_ = count;
    next_ = 0;
    ++round_;
  }
  start_.notify_all();
  takeAll(0);
  waitAwake([this] { return busy_ == 0; });
  {
    std::unique_lock<std::mutex> lock(mutex_);
    done_.wait(lock, [this] { return busy_ == 0; });
    body_ = nullptr;
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

void WorkerPool::beginTask(std::function<void()> task) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    task_ = std::move(task);
    hasTask_ = true;
  }
  start_.notify_one();
}

void WorkerPool::finishTask() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (task_) runTask(lock);
  done_.wait(lock, [this] { return !taskIsRunning_; });
  if (const std::exception_ptr exception = std::exchange(taskException_, nullptr)) std::rethrow_exception(exception);
}

void WorkerPool::dropTask() {
  std::unique_lock<std::mutex> lock(mutex_);
  task_ = nullptr;
  hasTask_ = false;
  done_.wait(lock, [this] { return !taskIsRunning_; });
  taskException_ = nullptr;
}

void WorkerPool::runTask(std::unique_lock<std::mutex>& lock) {
  const std::function<void()> task = std::exchange(task_, nullptr);
  hasTask_ = false;
  taskIsRunning_ = true;
  lock.unlock();
  std::exception_ptr exception;
  try {
    task();
  } catch (...) {
    exception = std::current_exception();
  }
  lock.lock();
  taskException_ = exception;
  taskIsRunning_ = false;
  done_.notify_one();
}

void WorkerPool::waitForWork(unsigned seen, std::unique_lock<std::mutex>& lock) {
  waitAwake([&] { return stop_ || round_ != seen || hasTask_; });
  lock.lock();
  start_.wait(lock, [&] { return stop_ || round_ != seen || hasTask_; });
}

void WorkerPool::work(std::size_t worker) {
  std::unique_lock<std::mutex> lock(mutex_, std::defer_lock);
  for (unsigned seen = 0;;) {
    waitForWork(seen, lock);
    if (stop_) return;
    if (round_ != seen) {
      seen = round_;
      if (body_ == nullptr) {  // too late
        lock.unlock();
        continue;
      }
      ++busy_;
      lock.unlock();
      takeAll(worker);
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    } else {
      runTask(lock);
    }
    lock.unlock();
  }
}

}  // namespace robust
}  // namespace hybridgv

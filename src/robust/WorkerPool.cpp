#include "robust/WorkerPool.hpp"

#include <algorithm>

namespace hybridgv {
namespace robust {

WorkerPool::WorkerPool(int threads) {
  const int wanted = threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (int i = 1; i < wanted; ++i) workers_.emplace_back([this, i] { work(static_cast<std::size_t>(i)); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::forEach(int count, const Body& body) {
  if (workers_.empty()) {
    for (int i = 0; i < count; ++i) body(i, 0);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    body_ = &body, count_ = count, next_ = 0;
    busy_ = static_cast<int>(workers_.size());
    ++round_;
  }
  start_.notify_all();
  takeAll(0);
  std::unique_lock<std::mutex> lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void WorkerPool::takeAll(std::size_t worker) {
  for (int i = next_++; i < count_; i = next_++) (*body_)(i, worker);
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

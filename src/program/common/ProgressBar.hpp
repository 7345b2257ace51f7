// A bar on the terminal's standard error, drawn only if there is a terminal.
#pragma once

#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>

class ProgressBar {
 public:
  // `what` stands before it.
  ProgressBar(std::size_t count, bool enabled, std::string what = {})
      : count_(count), enabled_(enabled && count > 0 && isatty(STDERR_FILENO)), what_(std::move(what)) {}
  ~ProgressBar() { clear(); }

  // Another one is done; may be called from several threads.
  void step() { show(++done_); }
  void show(std::size_t done) {
    constexpr std::size_t kWidth = 40;
    if (!enabled_) return;
    const std::size_t filled = kWidth * done / count_;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (drawn_ && filled == filled_ && done != count_ && count_ > 10 * kWidth) return;  // nothing that one could see
    drawn_ = true;
    filled_ = filled;
    std::fprintf(stderr, "\r%s[%s%s] %zu/%zu", what_.c_str(), std::string(filled, '#').c_str(),
                 std::string(kWidth - filled, ' ').c_str(), done, count_);
  }
  // Wipes it before other output.
  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (drawn_) std::fprintf(stderr, "\r\033[K");
    drawn_ = false;
  }

 private:
  const std::size_t count_;
  const bool enabled_;
  const std::string what_;
  std::atomic<std::size_t> done_{0};
  std::size_t filled_ = 0;
  bool drawn_ = false;
  std::mutex mutex_;
};

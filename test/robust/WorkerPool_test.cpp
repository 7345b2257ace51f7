#include "robust/WorkerPool.hpp"

#include <gtest/gtest.h>

#include <climits>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace hybridgv {
namespace {

using robust::numberOfWorkers;
using robust::WorkerPool;

void expectEveryIndexOnce(WorkerPool& pool, int count) {
  std::vector<std::atomic<int>> taken(static_cast<std::size_t>(count));
  pool.forEach(count, [&](int i, std::size_t worker) {
    EXPECT_LT(worker, pool.size());
    ++taken[static_cast<std::size_t>(i)];
  });
  for (const auto& times : taken) EXPECT_EQ(times, 1);
}

TEST(WorkerPool, EveryIndexIsTakenOnceWhateverTheNumberOfThreads) {
  for (const std::size_t workers : {1, 2, 3, 5, 20}) {
    WorkerPool pool(workers);
    EXPECT_EQ(pool.size(), workers);
    for (const int count : {0, 1, 3, 1000}) expectEveryIndexOnce(pool, count);
  }
}

// A way to start threads of which `started` succeed.
WorkerPool::StartThread failingAfter(int started) {
  return [left = started](std::function<void()> function) mutable {
    if (left-- == 0) throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
    return std::thread(std::move(function));
  };
}

TEST(WorkerPool, WorksWithTheThreadsThereAreWhereOneCannotBeStarted) {
  for (const int started : {0, 1, 2, 7}) {
    WorkerPool pool(64, failingAfter(started));
    EXPECT_EQ(pool.size(), static_cast<std::size_t>(started) + 1);
    for (int round = 0; round < 100; ++round) expectEveryIndexOnce(pool, 50);
  }
}

// Fails for the indices that are multiples of 7, from 14 on.
void failSometimes(int i) {
  if (i >= 14 && i % 7 == 0) throw std::runtime_error("index " + std::to_string(i));
}

TEST(WorkerPool, AnExceptionOfTheBodyReachesTheCallerAndThePoolGoesOn) {
  for (const std::size_t workers : {1, 2, 4}) {
    WorkerPool pool(workers);
    for (int round = 0; round < 200; ++round) {
      try {
        pool.forEach(1000, [](int i, std::size_t) { failSometimes(i); });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "index 14") << "the same one for any number of threads";
      }
      expectEveryIndexOnce(pool, 20);
    }
  }
}

TEST(WorkerPool, AnExceptionInAnyThreadReachesTheCaller) {
  WorkerPool pool(4);
  const std::thread::id caller = std::this_thread::get_id();
  for (const bool inCaller : {true, false})
    for (int round = 0; round < 50; ++round) {
      std::atomic<bool> thrown{false};
      const auto body = [&](int, std::size_t worker) {
        EXPECT_EQ(worker == 0, std::this_thread::get_id() == caller);
        if ((worker == 0) == inCaller) {
          thrown = true;
          throw std::bad_alloc();
        }
        while (!thrown) std::this_thread::yield();  // so that the other kind of thread gets an index
      };
      EXPECT_THROW(pool.forEach(1000, body), std::bad_alloc);
    }
  expectEveryIndexOnce(pool, 1000);
}

TEST(WorkerPool, ATaskIsDoneOnceBesideTheLoops) {
  for (const std::size_t workers : {1, 2, 4}) {
    WorkerPool pool(workers);
    for (int round = 0; round < 200; ++round) {
      std::atomic<int> done{0};
      pool.beginTask([&] { ++done; });
      if (round % 2 == 0) expectEveryIndexOnce(pool, 20);
      pool.finishTask();
      EXPECT_EQ(done, 1);
    }
    pool.finishTask();  // there is none
  }
}

TEST(WorkerPool, ALoopDoesNotWaitForTheTask) {
  WorkerPool pool(2);
  std::atomic<bool> loopIsDone{false}, waited{false};
  pool.beginTask([&] {
    while (!loopIsDone) std::this_thread::yield();
    waited = true;
  });
  expectEveryIndexOnce(pool, 50);
  loopIsDone = true;
  pool.finishTask();
  EXPECT_TRUE(waited);
}

TEST(WorkerPool, AnExceptionOfTheTaskIsThrownWhereItIsFinished) {
  for (const std::size_t workers : {1, 3}) {
    WorkerPool pool(workers);
    for (int round = 0; round < 50; ++round) {
      pool.beginTask([] { throw std::bad_alloc(); });
      expectEveryIndexOnce(pool, 20);
      EXPECT_THROW(pool.finishTask(), std::bad_alloc);
      pool.finishTask();
    }
  }
}

TEST(WorkerPool, ADroppedTaskIsNotUnderWayAfterwards) {
  for (const std::size_t workers : {1, 2}) {
    WorkerPool pool(workers);
    for (int round = 0; round < 200; ++round) {
      std::atomic<int> running{0};
      pool.beginTask([&] {
        ++running;
        std::this_thread::yield();
        --running;
      });
      pool.dropTask();
      EXPECT_EQ(running, 0);
    }
    pool.beginTask([] { throw std::bad_alloc(); });
    pool.dropTask();
    pool.finishTask();
  }
}

TEST(WorkerPool, PartsCoverTheWholeAndBeginAtMultiples) {
  WorkerPool pool(3);
  for (robust::WorkerPool* workers : {static_cast<WorkerPool*>(nullptr), &pool})
    for (const std::size_t size : {0, 1, 63, 64, 65, 1000, 20000}) {
      std::vector<std::atomic<int>> taken(size);
      robust::forParts(workers, size, 64, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 64, 0u);
        EXPECT_LT(begin, end);
        for (std::size_t i = begin; i < end; ++i) ++taken[i];
      });
      for (const auto& times : taken) EXPECT_EQ(times, 1);
    }
}

TEST(WorkerPool, NumberOfWorkersHasABound) {
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  EXPECT_EQ(numberOfWorkers(0, 1000), cores);
  EXPECT_EQ(numberOfWorkers(1, 1000), 1u);
  EXPECT_EQ(numberOfWorkers(2, 1000), 2u);
  EXPECT_EQ(numberOfWorkers(2, 1), 1u);
  EXPECT_LE(numberOfWorkers(INT_MAX, INT_MAX), 8 * cores);
}

}  // namespace
}  // namespace hybridgv

// Processor time: unlike the time on the clock, it does not count what other programs take of the machine.
#pragma once

#include <time.h>

inline double secondsOf(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
// Of all threads of this program together.
inline double processorSeconds() { return secondsOf(CLOCK_PROCESS_CPUTIME_ID); }
// Of the calling thread.
inline double threadSeconds() { return secondsOf(CLOCK_THREAD_CPUTIME_ID); }

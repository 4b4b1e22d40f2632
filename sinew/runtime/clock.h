// The one clock of the runtime: steady, in nanoseconds.
#pragma once

#include <cstdint>
#include <ctime>

namespace sinew::runtime {

using Nanoseconds = std::int64_t;
inline constexpr Nanoseconds kNanosecondsPerSecond = 1'000'000'000;

inline Nanoseconds to_nanoseconds(const timespec& time) {
  return Nanoseconds{time.tv_sec} * kNanosecondsPerSecond + time.tv_nsec;
}

inline Nanoseconds now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return to_nanoseconds(time);
}

// Of the processor, spent by this thread: what it did itself, without what preempted it.
inline Nanoseconds thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return to_nanoseconds(time);
}

inline void sleep_until(Nanoseconds when) {
  const timespec time{when / kNanosecondsPerSecond, when % kNanosecondsPerSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) != 0) {
  }
}

inline Nanoseconds from_seconds(double seconds) {
  return static_cast<Nanoseconds>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5));
}
inline double to_seconds(Nanoseconds time) { return static_cast<double>(time) * 1e-9; }

}  // namespace sinew::runtime

// Time in the world model: nanoseconds since an epoch that all providers of one world agree on. The
// world never reads a clock by itself while it answers a query: whoever asks says what time it is,
// so that a recorded world answers as the live one did.
#pragma once

#include <chrono>
#include <cstdint>

namespace sinew::world {

struct WorldClock {};  // names the time base, so that stamps of other clocks do not mix in
using Duration = std::chrono::nanoseconds;
using Stamp = std::chrono::time_point<WorldClock, Duration>;

inline constexpr Stamp kBeginning = Stamp::min();
inline constexpr Duration kForever = Duration::max();

constexpr Stamp stamp_of_ns(std::int64_t nanoseconds) { return Stamp(Duration(nanoseconds)); }
constexpr std::int64_t ns_of(Stamp stamp) { return stamp.time_since_epoch().count(); }
constexpr double seconds_of(Duration duration) {
  return static_cast<double>(duration.count()) * 1e-9;
}
constexpr Duration duration_of_seconds(double seconds) {
  return Duration(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
}

// The computer's time of day, for worlds whose providers use it.
inline Stamp system_now() {
  return Stamp(
      std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()));
}

}  // namespace sinew::world

// What the operating system grants a loop: a fixed priority above everything else, and memory that
// is never paged out. Both need rights that a process may not have; the report says what was
// granted, and why not.
#pragma once

#include <string>

namespace sinew::runtime {

struct RealTimeReport {
  bool scheduled = false;  // SCHED_FIFO
  bool locked = false;     // mlockall
  std::string why_not;     // empty when both were granted
};
std::string to_string(const RealTimeReport& report);

inline constexpr int kDefaultPriority = 80;  // of 1 to 99; below the kernel's own threads at 99

// Of the calling thread, and of the whole process's memory. Also touches the thread's stack, so
// that the loop meets no page for the first time.
RealTimeReport become_real_time(int priority = kDefaultPriority);

// The calling thread goes on only when others have nothing to do (compiling beside a loop).
void become_background();

}  // namespace sinew::runtime

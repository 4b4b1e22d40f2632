#include "sinew/runtime/real_time.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace sinew::runtime {
namespace {

constexpr std::size_t kStack = std::size_t{256} * 1024;
constexpr int kBackgroundNice = 10;

void touch_stack() {
  volatile char stack[kStack];
  for (std::size_t i = 0; i < kStack; i += 1024) stack[i] = 0;
  (void)stack[0];
}

}  // namespace

std::string to_string(const RealTimeReport& report) {
  std::string text = fmt::format("scheduling {}, memory {}",
                                 report.scheduled ? "SCHED_FIFO" : "as any other thread's",
                                 report.locked ? "locked" : "not locked");
  if (!report.why_not.empty()) text += " (" + report.why_not + ")";
  return text;
}

RealTimeReport become_real_time(int priority) {
  RealTimeReport report;
  const auto refuse = [&](const char* what, int error) {
    report.why_not +=
        fmt::format("{}{}: {}", report.why_not.empty() ? "" : "; ", what, std::strerror(error));
  };
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  report.scheduled = refused == 0;
  if (refused != 0) refuse("SCHED_FIFO", refused);
  report.locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  if (!report.locked) refuse("mlockall", errno);
  touch_stack();
  return report;
}

void become_background() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kBackgroundNice);
}

}  // namespace sinew::runtime

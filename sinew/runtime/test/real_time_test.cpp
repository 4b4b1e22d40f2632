// The loop allocates nothing: every way to the heap is counted while a switch is on.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "watching.h"

namespace {
std::atomic<std::uint64_t> allocations = 0;
thread_local bool counted = false;
[[maybe_unused]] void count() {
  if (counted) allocations.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

// glibc's own names behind malloc, so that C allocations are seen too.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void __libc_free(void* memory);
#ifndef SINEW_SANITIZED  // a sanitizer has a malloc of its own
void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
  count();
  return __libc_realloc(old, size);
}
void free(void* memory) {
  if (memory != nullptr) count();
  __libc_free(memory);
}
#endif
}

namespace sinew::runtime::test {
namespace {

class RealTime : public WatchingTest {
 protected:
  // Allocations and releases in one step of the host.
  static std::uint64_t in_cycles(Host& host, std::uint64_t cycles) {
    allocations = 0;
    counted = true;
    host.step(cycles);
    counted = false;
    return allocations;
  }
};

TEST_F(RealTime, TheHookSeesAllocations) {
#ifdef SINEW_SANITIZED
  GTEST_SKIP() << "the sanitizer has its own malloc";
#endif
  allocations = 0;
  counted = true;
  delete new int(3);
  std::free(std::malloc(10));
  counted = false;
  EXPECT_GE(allocations, 2u);
}

TEST_F(RealTime, ACycleWithLogsChecksProbesSetPointsASwapAndAFaultAllocatesNothing) {
#ifdef SINEW_SANITIZED
  GTEST_SKIP() << "the sanitizer has its own malloc";
#endif
  const std::string log = std::string(testing::TempDir()) + "sinew-real-time.csv";
  bindings_.recorder = std::make_shared<Recorder>(RecorderOptions{{log}, 4096});
  bindings_.recorder->gauge("phase", [] { return 1.0; });
  const auto m = model();
  weave(*m, "log", "a so:log ; so:quantity ( ?force ?pose ) ; sa:label \"all\"");
  weave(*m, "probe", "a so:probe-time ; sa:label \"time\"");
  weave(*m, "check",
        "a so:check-range ; so:quantity ( ?force ) ; sa:lower -90.0 ; sa:upper 90.0 ; "
        "sa:action sa:stop");
  const auto h = host(*m);
  bindings_.recorder->start();
  h->step();
  EXPECT_EQ(in_cycles(*h, 1000), 0u);
  h->swap("main", executable(*m));
  EXPECT_EQ(in_cycles(*h, 10), 0u) << "with a swap";
  EXPECT_TRUE(h->last_swap().has_value());
  h->set("main", "given.joint1", std::array{1000.0});
  EXPECT_EQ(in_cycles(*h, 10), 0u) << "with a fault";
  EXPECT_EQ(h->state(), State::kFaulted);
  bindings_.recorder->stop();
  std::remove(log.c_str());
}

TEST_F(RealTime, ACycleWithEventsThatSwitchTasksAllocatesNothing) {
#ifdef SINEW_SANITIZED
  GTEST_SKIP() << "the sanitizer has its own malloc";
#endif
  const auto first = watching("contact", -7.0, 3), second = watching("released");
  HostOptions options;
  options.real_time = false;
  options.event_capacity = 2;  // one of three is lost
  Host h(options);
  h.bindings() = bindings_;
  h.add_task({"first", 1}, executable(*first));
  h.add_task({"second", 1, true}, executable(*second));
  for (const auto& [task, event] : {std::pair{"first", "contact"}, {"second", "released"}}) {
    h.set(task, "given.joint1", std::array{1.0});
    h.set(task, std::string("watched.") + event, std::array{9.0});
  }
  h.react({"event.contact", ReactionKind::kHaltTask, "first"});
  h.react({"event.contact2", ReactionKind::kStartTask, "second"});
  h.react({"event.contact3", ReactionKind::kHaltTask, "first"});
  h.react({"event.released", ReactionKind::kFault});
  h.configure();
  h.step();
  h.set("first", "watched.contact", std::array{0.0});
  EXPECT_EQ(in_cycles(h, 3), 0u);
  EXPECT_TRUE(h.is_halted("first"));
  EXPECT_FALSE(h.is_halted("second"));
  EXPECT_EQ(h.statistics().raised_lost, 1u);
  h.set("second", "watched.released", std::array{0.0});
  EXPECT_EQ(in_cycles(h, 3), 0u) << "with a fault";
  EXPECT_EQ(h.state(), State::kFaulted);
}

}  // namespace
}  // namespace sinew::runtime::test

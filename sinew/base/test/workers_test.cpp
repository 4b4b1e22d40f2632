// Pieces of work on several threads.
#include "sinew/base/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

TEST(Workers, GiveWhatEachPieceReturnsWhoeverDidIt) {
  for (const unsigned threads : {1U, 2U, 8U}) {
    Workers workers(threads);
    std::vector<std::future<int>> results;
    for (int i = 0; i < 100; ++i) results.push_back(workers.add([i] { return i * i; }));
    workers.help();
    for (int i = 0; i < 100; ++i)
      EXPECT_EQ(results[static_cast<std::size_t>(i)].get(), i * i) << threads;
  }
}

TEST(Workers, OfOneThreadAreTheCallerAlone) {
  Workers workers(1);
  std::future<std::thread::id> by = workers.add([] { return std::this_thread::get_id(); });
  EXPECT_EQ(by.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  workers.help();
  EXPECT_EQ(by.get(), std::this_thread::get_id());
}

TEST(Workers, BeginWithTheLargestOfThoseThatWait) {
  Workers workers(1);
  std::string order;
  std::vector<std::future<void>> results;
  const auto add = [&](char name, std::size_t size) {
    results.push_back(workers.add([&order, name] { order += name; }, size));
  };
  add('a', 3);
  add('b', 7);
  add('c', 0);
  add('d', 7);
  add('e', 3);
  workers.help();
  EXPECT_EQ(order, "bdaec");
}

TEST(Workers, WorkBesideTheCaller) {
  Workers workers(2);
  // Without help, another thread has to do it.
  std::future<std::thread::id> by = workers.add([] { return std::this_thread::get_id(); });
  EXPECT_NE(by.get(), std::this_thread::get_id());
}

TEST(Workers, CarryWhatAPieceThrowsToWhoeverAsksForItsResult) {
  Workers workers(2);
  std::future<int> fails = workers.add([]() -> int { throw std::runtime_error("no such joint"); });
  std::future<int> succeeds = workers.add([] { return 1; });
  workers.help();
  EXPECT_THROW(fails.get(), std::runtime_error);
  EXPECT_EQ(succeeds.get(), 1);
}

TEST(Workers, TakeWorkThatCannotBeCopied) {
  Workers workers(1);
  std::future<int> result = workers.add([p = std::make_unique<int>(7)] { return *p; });
  workers.help();
  EXPECT_EQ(result.get(), 7);
}

TEST(Workers, LeaveOutWhatHasNotBegunWhenTheyEnd) {
  std::atomic<int> done = 0;
  std::future<void> result;
  {
    Workers workers(1);
    result = workers.add([&] { ++done; });
  }
  EXPECT_THROW(result.get(), std::future_error);
  EXPECT_EQ(done, 0);
}

TEST(Workers, WaitForWhatHasBegunWhenTheyEnd) {
  std::promise<void> has_begun;
  std::atomic<bool> done = false;
  {
    Workers workers(2);
    workers.add([&] {
      has_begun.set_value();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      done = true;
    });
    has_begun.get_future().wait();
  }
  EXPECT_TRUE(done);
}

TEST(Workers, HaveALeastAndAGreatestNumber) {
  EXPECT_GE(Workers::as_many_as_the_machine_has(), 1U);
  EXPECT_LE(Workers::as_many_as_the_machine_has(), Workers::kMost);
  Workers none(0);  // the caller is always there
  std::future<int> result = none.add([] { return 3; });
  none.help();
  EXPECT_EQ(result.get(), 3);
}

}  // namespace
}  // namespace sinew

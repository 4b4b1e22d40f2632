// Triggers: what they tell, in which order, in which thread, and that nobody is lost or told too
// much while others write.
#include "sinew/world/triggers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "sinew/base/error.h"
#include "sinew/world/edit.h"

namespace sinew::world {
namespace {

Stamp at_ms(std::int64_t ms) { return stamp_of_ns(ms * 1'000'000); }
Pose at_x(double x) { return {{}, {x, 0, 0}}; }
using std::chrono::milliseconds;

// One relation that is measured, and a queue.
struct Listening {
  Listening() {
    const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
    const RelationId relation =
        world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
    seen = world.add_measurement({.name = "http://x/m", .relation = relation});
  }
  void write(std::int64_t ms, double x) { world.write(seen, at_ms(ms), at_x(x), {"w"}); }
  // Tells the events of a trigger in `told`.
  TriggerId listen(Occasion when, int priority = 0) {
    return triggers.add({.when = std::move(when),
                         .priority = priority,
                         .callback = [this](const Event& event) { told.push_back(event); }},
                        queue);
  }
  // What one look tells, after it.
  std::vector<Event> look(std::int64_t ms) {
    told.clear();
    triggers.look(at_ms(ms));
    queue->run();
    return told;
  }

  World world;
  MeasurementId seen;
  Triggers triggers{world};
  std::shared_ptr<EventQueue> queue = std::make_shared<EventQueue>();
  std::vector<Event> told;
};

TEST(Triggers, OnChangeTellsOnceAndHowManyWritesItWere) {
  Listening l;
  l.write(1, 0);  // before: not told
  l.listen(OnChange{l.seen});
  EXPECT_TRUE(l.look(1).empty());
  l.write(2, 1);
  auto told = l.look(3);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].count, 1u);
  EXPECT_EQ(told[0].now, at_ms(3));
  EXPECT_TRUE(l.look(4).empty());
  for (int i = 0; i < 7; ++i) l.write(10 + i, i);
  told = l.look(20);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].count, 7u);
  l.write(12, 5);  // a correction of the past
  EXPECT_EQ(l.look(21).size(), 1u);
  EXPECT_TRUE(l.look(22).empty());
}

TEST(Triggers, OnChangeHearsRealTimeHandles) {
  Listening l;
  l.listen(OnChange{l.seen});
  Writer writer = l.world.claim(l.seen, {"w"});
  ASSERT_EQ(writer.write(at_ms(1), at_x(1)), Status::kOk);
  ASSERT_EQ(l.look(2).size(), 1u);
  // More than the ring holds.
  for (int i = 0; i < 500; ++i) ASSERT_EQ(writer.write(at_ms(2 + i), at_x(1)), Status::kOk);
  const auto told = l.look(3);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].count, 500u);
}

TEST(Triggers, AClonesListenersHearTheClone) {
  Listening l;
  l.write(1, 1);
  World clone = l.world.clone();
  Triggers triggers(clone);
  int told = 0;
  triggers.add({.when = OnChange{l.seen}, .callback = [&](const Event&) { ++told; }}, l.queue);
  l.write(2, 2);  // in the original
  triggers.look(at_ms(3));
  l.queue->run();
  EXPECT_EQ(told, 0);
  clone.write(l.seen, at_ms(2), at_x(3), {"w"});
  triggers.look(at_ms(4));
  l.queue->run();
  EXPECT_EQ(told, 1);
}

TEST(Triggers, OnStructureTellsOfEdits) {
  Listening l;
  l.listen(OnStructure{});
  EXPECT_TRUE(l.look(1).empty());
  l.world.add_frame("http://x/c");
  EXPECT_EQ(l.look(2).size(), 1u);
  l.write(3, 1);
  EXPECT_TRUE(l.look(3).empty());
}

TEST(Triggers, OnConditionTellsWhenItBeginsToHold) {
  Listening l;
  l.listen(OnCondition{[&](const World& world, Stamp now) {
    const World::Sample sample = world.latest(l.seen, now);
    return sample.status == Status::kOk && sample.values[4] > 0.5;
  }});
  EXPECT_TRUE(l.look(0).empty());
  l.write(1, 0.2);
  EXPECT_TRUE(l.look(1).empty());
  l.write(2, 0.7);
  EXPECT_EQ(l.look(2).size(), 1u);
  l.write(3, 0.9);  // still holds
  EXPECT_TRUE(l.look(3).empty());
  l.write(4, 0.1);
  EXPECT_TRUE(l.look(4).empty());
  l.write(5, 0.6);
  EXPECT_EQ(l.look(5).size(), 1u);
}

TEST(Triggers, CyclicOnesStayOnTheirGridAndCountMissedPeriods) {
  Listening l;
  l.listen(Cyclic{milliseconds(10)});
  ASSERT_EQ(l.look(100).size(), 1u);
  EXPECT_TRUE(l.look(109).empty());
  ASSERT_EQ(l.look(113).size(), 1u);  // late
  EXPECT_TRUE(l.look(119).empty());
  ASSERT_EQ(l.look(120).size(), 1u);
  const auto told = l.look(155);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].count, 3u);  // 130, 140, 150
  EXPECT_TRUE(l.look(159).empty());
  EXPECT_EQ(l.look(160).size(), 1u);
}

TEST(Triggers, TheMoreUrgentComesFirstAndEqualsInOrder) {
  Listening l;
  const TriggerId low = l.listen(OnChange{l.seen}, -1);
  const TriggerId first = l.listen(OnChange{l.seen}, 3), second = l.listen(OnChange{l.seen}, 3);
  const TriggerId high = l.listen(OnChange{l.seen}, 9);
  l.write(1, 1);
  std::vector<TriggerId> order;
  for (const Event& event : l.look(1)) order.push_back(event.trigger);
  EXPECT_EQ(order, (std::vector<TriggerId>{high, first, second, low}));
  // To executors too, which run at once here.
  order.clear();
  const Executor at_once = [](const std::function<void()>& work) { work(); };
  Triggers triggers(l.world);
  for (const int priority : {1, 2}) {
    triggers.add({.when = OnChange{l.seen},
                  .priority = priority,
                  .callback = [&](const Event& event) { order.push_back(event.trigger); }},
                 at_once);
  }
  l.write(2, 1);
  EXPECT_EQ(triggers.look(at_ms(2)), 2u);
  EXPECT_EQ(order, (std::vector<TriggerId>{{2}, {1}}));
}

TEST(Triggers, WhatWasRemovedIsNotRunEvenIfItWaits) {
  Listening l;
  const TriggerId id = l.listen(OnChange{l.seen});
  l.write(1, 1);
  EXPECT_EQ(l.triggers.look(at_ms(1)), 1u);
  EXPECT_TRUE(l.triggers.remove(id));
  EXPECT_FALSE(l.triggers.remove(id));
  EXPECT_EQ(l.queue->run(), 1u);
  EXPECT_TRUE(l.told.empty());
  // A measurement that is removed changes no more.
  l.listen(OnChange{l.seen});
  l.world.remove(l.seen);
  EXPECT_TRUE(l.look(2).empty());
}

TEST(Triggers, ACallbackMayAddAndRemoveTriggersAndWrite) {
  Listening l;
  TriggerId id;
  int told = 0;
  const Executor at_once = [](const std::function<void()>& work) { work(); };
  id = l.triggers.add({.when = OnChange{l.seen},
                       .callback =
                           [&](const Event&) {
                             ++told;
                             l.triggers.remove(id);
                             l.write(50, 1);
                             l.listen(OnStructure{});
                           }},
                      at_once);
  l.write(1, 1);
  l.look(1);
  l.look(2);
  EXPECT_EQ(told, 1);
}

TEST(Triggers, RefusesWhatCannotWork) {
  Listening l;
  EXPECT_THROW(l.listen(OnChange{MeasurementId{77}}), Error);
  EXPECT_THROW(l.listen(Cyclic{Duration::zero()}), Error);
  EXPECT_THROW(l.listen(OnCondition{}), Error);
  EXPECT_THROW(l.triggers.add({.when = OnStructure{}, .callback = {}}, l.queue), Error);
  EXPECT_THROW(Watch(l.triggers, Duration::zero()), Error);
  EXPECT_THROW(EventQueue(0), Error);
  EXPECT_THROW(EventQueue(kMaximumQueuedEvents + 1), Error);
}

TEST(EventQueue, DropsTheLeastUrgentThatCameLastAndCounts) {
  EventQueue queue(3);
  std::vector<int> ran;
  const auto push = [&](int priority, int number) {
    return queue.push(priority, [&ran, number] { ran.push_back(number); });
  };
  EXPECT_TRUE(push(1, 10) && push(0, 20) && push(0, 30));
  EXPECT_FALSE(push(5, 40));  // 30 goes
  EXPECT_FALSE(push(0, 50));  // itself
  EXPECT_EQ(queue.dropped(), 2u);
  EXPECT_EQ(queue.run(1), 1u);
  EXPECT_EQ(queue.waiting(), 2u);
  EXPECT_EQ(queue.run(), 2u);
  EXPECT_EQ(ran, (std::vector<int>{40, 10, 20}));
  EXPECT_FALSE(queue.run_one_within(milliseconds(1)));
}

// A listener that hangs in its callback: the writer writes on, looks go on, the queue stays within
// its bound, and every event that is dropped is counted.
TEST(Triggers, ASlowListenerHoldsUpNobody) {
  Listening l;
  constexpr std::size_t kRoom = 4;
  const auto queue = std::make_shared<EventQueue>(kRoom);
  std::mutex mutex;
  std::condition_variable changed;
  bool in_callback = false, let_go = false;
  std::uint64_t ran = 0, entries = 0;
  for (int i = 0; i < 3; ++i) {
    l.triggers.add({.when = OnChange{l.seen},
                    .callback =
                        [&](const Event& event) {
                          std::unique_lock lock(mutex);
                          in_callback = true;
                          changed.notify_all();
                          changed.wait(lock, [&] { return let_go; });
                          ++ran;
                          entries += event.count;
                        }},
                   queue);
  }
  std::atomic<bool> end = false;
  std::thread listener([&] {
    while (!end || queue->waiting() > 0) queue->run_one_within(milliseconds(5));
  });
  Writer writer = l.world.claim(l.seen, {"w"});
  std::uint64_t handed_over = 0;
  ASSERT_EQ(writer.write(at_ms(0), at_x(0)), Status::kOk);
  handed_over += l.triggers.look(at_ms(0));
  {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return in_callback; });
  }
  // The listener hangs from here on.
  for (int i = 1; i <= 1000; ++i) {
    ASSERT_EQ(writer.write(at_ms(i), at_x(i)), Status::kOk);
    handed_over += l.triggers.look(at_ms(i));
    ASSERT_LE(queue->waiting(), kRoom);
  }
  EXPECT_EQ(handed_over, 3u * 1001u);
  {
    const std::lock_guard lock(mutex);
    let_go = true;
  }
  changed.notify_all();
  end = true;
  listener.join();
  EXPECT_EQ(ran + queue->dropped(), handed_over);
  EXPECT_GT(queue->dropped(), 2900u);
  EXPECT_EQ(entries, ran);  // each event was of one entry
}

// However many unimportant ones come, what is urgent is heard, and first.
TEST(Triggers, UnderLoadTheUrgentIsNotDropped) {
  Listening l;
  const auto queue = std::make_shared<EventQueue>(8);
  std::vector<int> ran;
  for (int i = 0; i < 50; ++i) {
    l.triggers.add({.when = OnChange{l.seen},
                    .priority = i % 5,
                    .callback = [&ran, i](const Event&) { ran.push_back(i % 5); }},
                   queue);
  }
  double x = 0;
  l.triggers.add({.when = OnCondition{[&](const World&, Stamp) { return x > 0; }},
                  .priority = 100,
                  .callback = [&ran](const Event&) { ran.push_back(100); }},
                 queue);
  int urgent = 0;
  for (int i = 0; i < 200; ++i) {
    x = i % 7 == 0 ? 1 : -1;
    urgent += i % 7 == 0;
    l.write(i, x);
    l.triggers.look(at_ms(i));
    ran.clear();
    queue->run();
    ASSERT_EQ(ran.size(), 8u);
    ASSERT_TRUE(std::is_sorted(ran.rbegin(), ran.rend()));
    ASSERT_EQ(ran.front() == 100, i % 7 == 0);
  }
  EXPECT_EQ(urgent, 29);
  EXPECT_EQ(queue->dropped(), 200u * 50u + 29u - 200u * 8u);
}

// A writer with a handle, a watch and a listener, each in its thread: callbacks run in the
// listener's, and all writes are accounted for.
TEST(Triggers, RunInTheListenersThreadWhileOthersWrite) {
  Listening l;
  constexpr int kWrites = 3000;
  std::atomic<std::uint64_t> told = 0;
  std::atomic<bool> elsewhere = false;
  std::thread::id listener_id;
  std::atomic<bool> ready = false, end = false;
  std::thread listener([&] {
    listener_id = std::this_thread::get_id();
    ready = true;
    while (!end || l.queue->waiting() > 0) l.queue->run_one_within(milliseconds(5));
  });
  while (!ready) std::this_thread::yield();
  l.triggers.add({.when = OnChange{l.seen},
                  .callback =
                      [&](const Event& event) {
                        told += event.count;
                        if (std::this_thread::get_id() != listener_id) elsewhere = true;
                      }},
                 l.queue);
  {
    const Watch watch(l.triggers, std::chrono::microseconds(200));
    std::thread writer([&] {
      Writer handle = l.world.claim(l.seen, {"w"});
      for (int i = 0; i < kWrites; ++i) handle.write(at_ms(i), at_x(i));
    });
    std::thread meddler([&] {  // adds and removes while the watch looks
      for (int i = 0; i < 100; ++i) {
        const TriggerId id =
            l.triggers.add({.when = OnStructure{}, .callback = [](const Event&) {}}, l.queue);
        l.world.add_frame("http://x/more" + std::to_string(i));
        l.triggers.remove(id);
      }
    });
    writer.join();
    meddler.join();
  }
  l.triggers.look(system_now());
  end = true;
  listener.join();
  EXPECT_EQ(told, static_cast<std::uint64_t>(kWrites));
  EXPECT_FALSE(elsewhere);
  EXPECT_EQ(l.queue->dropped(), 0u);
}

}  // namespace
}  // namespace sinew::world

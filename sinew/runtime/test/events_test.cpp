// Events of monitors, and what is declared for them.
#include <gmock/gmock.h>

#include <map>
#include <thread>

#include "watching.h"

namespace sinew::runtime::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class EventsTest : public WatchingTest {
 protected:
  struct TaskOf {
    TaskOptions options;
    std::string event;  // name of the monitor's event
    double given = 0;
    int events = 1;
  };

  // A host of such tasks, configured; nothing is near zero.
  std::unique_ptr<Host> host_of(const std::vector<TaskOf>& tasks,
                                const std::vector<Reaction>& reactions, HostOptions options = {}) {
    options.real_time = false;
    auto result = std::make_unique<Host>(options);
    result->bindings() = bindings_;
    for (const TaskOf& task : tasks) {
      models_.push_back(watching(task.event, -7.0, task.events));
      result->add_task(task.options, executable(*models_.back()));
      result->set(task.options.name, "given.joint1", std::array{task.given});
      result->set(task.options.name, "watched." + task.event, std::array{9.0});
    }
    for (const Reaction& reaction : reactions) result->react(reaction);
    result->configure();
    return result;
  }

  static std::vector<std::string> told(Host& host, Event::Kind kind) {
    std::vector<std::string> names;
    for (const Event& event : host.take_events())
      if (event.kind == kind) names.emplace_back(event.about.data());
    return names;
  }
  static void near(Host& host, const std::string& task, const std::string& event, bool is_near) {
    host.set(task, "watched." + event, std::array{is_near ? 0.0 : 9.0});
  }

  std::vector<std::unique_ptr<Model>> models_;
};

const std::string kContact = "https://example.org/contact";

TEST_F(EventsTest, AnEventOfNoReactionIsTold) {
  const auto h = host_of({{{"main"}, "contact"}}, {});
  h->step();
  near(*h, "main", "contact", true);
  h->step(3);
  EXPECT_THAT(told(*h, Event::Kind::kRaised), ElementsAre("event.contact"));
  EXPECT_EQ(h->statistics().raised, 0u);
}

TEST_F(EventsTest, FaultsAtTheNextBoundaryOfACycle) {
  const auto h = host_of({{{"main"}, "contact", 10}}, {{kContact, ReactionKind::kFault}});
  h->step();
  EXPECT_EQ(robot_->command_, 11.0);
  near(*h, "main", "contact", true);
  h->step();
  EXPECT_EQ(robot_->command_, 12.0) << "the cycle in which it is raised is carried out";
  h->step();
  EXPECT_EQ(robot_->command_, -7.0) << "the next one is not";
  EXPECT_EQ(h->state(), State::kFaulted);
  EXPECT_THAT(told(*h, Event::Kind::kFaulted), ElementsAre(kContact));
  near(*h, "main", "contact", false);
  h->reset();
  h->step();
  EXPECT_EQ(robot_->command_, 11.0) << "states begin anew";
}

TEST_F(EventsTest, StopsTheLoopWithTheSafeCommand) {
  const auto h = host_of({{{"main"}, "contact", 10}}, {{"event.contact", ReactionKind::kStop}},
                         {.period_s = 1e-3});
  h->start();
  near(*h, "main", "contact", true);
  h->wait();  // ends by itself
  EXPECT_EQ(robot_->command_, -7.0);
  EXPECT_EQ(h->state(), State::kConfigured) << "no fault: it may start again";
  EXPECT_THAT(told(*h, Event::Kind::kStopped), ElementsAre(kContact));
}

TEST_F(EventsTest, AStepDoesNothingOnceAnEventHasStoppedIt) {
  const auto h = host_of({{{"main"}, "contact", 10}}, {{kContact, ReactionKind::kStop}});
  near(*h, "main", "contact", true);
  h->step(100);
  EXPECT_TRUE(h->has_ended());
  EXPECT_EQ(h->statistics().cycles, 2u);
  EXPECT_EQ(robot_->command_, -7.0);
}

// Approach until contact, then push: one event halts the one and starts the other, in one boundary.
TEST_F(EventsTest, SwitchesFromOneTaskToAnotherBetweenTwoCycles) {
  const auto h = host_of({{{"approach"}, "contact", 100}, {{"push", 1, true}, "released", 200}},
                         {{kContact, ReactionKind::kHaltTask, "approach"},
                          {kContact, ReactionKind::kStartTask, "push"},
                          {"event.released", ReactionKind::kHaltTask, "push"},
                          {"event.released", ReactionKind::kStartTask, "approach"}});
  h->step(2);
  EXPECT_EQ(robot_->command_, 102.0);
  EXPECT_TRUE(h->is_halted("push"));
  near(*h, "approach", "contact", true);
  h->step();
  EXPECT_EQ(robot_->command_, 103.0);
  const std::uint64_t writes = robot_->writes;
  h->step();
  EXPECT_EQ(robot_->command_, 201.0) << "the other commands in the very next cycle";
  EXPECT_EQ(robot_->writes, writes + 1) << "and no safe command comes in between";
  EXPECT_TRUE(h->is_halted("approach"));
  near(*h, "approach", "contact", false);
  near(*h, "push", "released", true);
  h->step(2);
  EXPECT_EQ(robot_->command_, 101.0) << "what starts again starts with its first states";
  EXPECT_THAT(told(*h, Event::Kind::kStarted), ElementsAre("push", "approach"));
}

TEST_F(EventsTest, ATaskThatAloneCommandsARobotLeavesItWithTheSafeCommand) {
  const auto h =
      host_of({{{"main"}, "contact", 10}}, {{kContact, ReactionKind::kHaltTask, "main"}});
  near(*h, "main", "contact", true);
  h->step(3);
  EXPECT_EQ(robot_->command_, -7.0);
  EXPECT_EQ(h->state(), State::kConfigured);
}

TEST_F(EventsTest, TheSupervisingThreadRaisesEventsToo) {
  const auto h = host_of({{{"main", 1, true}, "contact", 10}},
                         {{"https://example.org/button", ReactionKind::kStartTask, "main", true}});
  h->step();
  EXPECT_EQ(robot_->command_, -7.0);
  h->raise("https://example.org/button");
  h->step();
  EXPECT_EQ(robot_->command_, 11.0);
  EXPECT_EQ(h->statistics().raised, 1u);
  EXPECT_THROW(h->raise("https://example.org/lever"), Error);
}

// Three events in a cycle, room for two: one is lost, counted and told.
TEST_F(EventsTest, AFullQueueLosesEventsAndCountsThem) {
  std::vector<Reaction> reactions;
  for (const char* event : {"contact", "contact2", "contact3"})
    reactions.push_back({std::string("event.") + event, ReactionKind::kStartTask, "main"});
  const auto h = host_of({{{"main"}, "contact", 10, 3}}, reactions, {.event_capacity = 2});
  near(*h, "main", "contact", true);
  h->step(2);
  EXPECT_EQ(h->statistics().raised, 2u);
  EXPECT_EQ(h->statistics().raised_lost, 1u);
  EXPECT_THAT(told(*h, Event::Kind::kEventLost), ElementsAre("event.contact3"));
  // It has been emptied: there is room again.
  near(*h, "main", "contact", false);
  h->step();
  near(*h, "main", "contact", true);
  h->step(2);
  EXPECT_EQ(h->statistics().raised, 4u);
}

TEST_F(EventsTest, AnEventThatFaultsIsNotLostInAFullQueue) {
  const auto h = host_of({{{"main"}, "contact", 10, 2}},
                         {{"event.contact", ReactionKind::kStartTask, "main"},
                          {"event.contact2", ReactionKind::kFault}},
                         {.event_capacity = 1});
  near(*h, "main", "contact", true);
  h->step(2);
  EXPECT_EQ(h->statistics().raised_lost, 1u);
  EXPECT_EQ(h->state(), State::kFaulted);
  EXPECT_EQ(robot_->command_, -7.0);
}

// With no fault in between the loop and who supervises it, what is raised is carried out, or
// counted as lost: from two threads, in a loop that runs.
TEST_F(EventsTest, EveryEventFromOutsideIsCarriedOutInALoopThatRuns) {
  const auto h = host_of({{{"main"}, "contact", 10}},
                         {{"button", ReactionKind::kStartTask, "main", true}}, {.period_s = 1e-4});
  h->start();
  std::uint64_t raised = 0;
  for (int i = 0; i < 2000; ++i) {
    try {
      h->raise("button");
      ++raised;
    } catch (const Error&) {  // too many at once
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  for (int i = 0; i < 1000 && h->statistics().raised < raised; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  h->stop();
  EXPECT_GT(raised, 0u);
  EXPECT_EQ(h->statistics().raised, raised);
}

// After a swap the events are the new program's.
TEST_F(EventsTest, ASwapBringsTheEventsOfTheNewProgram) {
  const auto h = host_of({{{"main"}, "contact", 10}}, {{kContact, ReactionKind::kFault}});
  h->step();
  const auto next = watching("contact");
  h->swap("main", executable(*next));
  near(*h, "main", "contact", true);
  h->step(2);
  EXPECT_EQ(h->state(), State::kFaulted);
}

TEST_F(EventsTest, AReactionToAnEventThatNobodyRaisesIsRefused) {
  const auto fault = [&](const Reaction& reaction) -> std::string {
    try {
      host_of({{{"main"}, "contact"}}, {reaction});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault({"https://example.org/contacts", ReactionKind::kStop}),
              HasSubstr("no task raises it; the tasks raise event.contact"));
  EXPECT_THAT(fault({kContact, ReactionKind::kHaltTask, "other"}),
              HasSubstr("no task is named 'other'"));
  EXPECT_THROW(Host({.event_capacity = 0}), Error);
}

// --- periods ---

TEST_F(EventsTest, ATaskThatIntegratesRunsInItsOwnPeriodOrNotAtAll) {
  const auto m = watching("contact");
  graph::Transaction change = m->store.begin();
  graph::Terms& terms = m->store.terms();
  change.add({m->algorithm, terms.iri("https://w3id.org/sinew/algorithm#period"), terms.real(0.002),
              m->algorithm});
  change.commit();
  Host h({.period_s = 0.001});
  h.bindings() = bindings_;
  try {
    h.add_task({"main", 1}, executable(*m));
    FAIL() << "its integrals would grow twice as fast";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("integrates over steps of 0.002 s, but would run every 0.001 s"));
  }
  h.add_task({"main", 2}, executable(*m));
  // Nor does a swap bring one.
  const auto fast = watching("contact");
  Host other({.period_s = 0.001});
  other.bindings() = bindings_;
  other.add_task({"main", 1}, executable(*fast));
  other.set("main", "given.joint1", std::array{0.0});
  other.set("main", "watched.contact", std::array{9.0});
  other.configure();
  EXPECT_THROW(other.swap("main", executable(*m)), Error);
}

}  // namespace
}  // namespace sinew::runtime::test

#include "live_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace sinew::cli {
namespace {

using runtime::Event;

std::string describe(const Event& event) {
  const char* about = event.about.data();
  switch (event.kind) {
    case Event::Kind::kStale:
      return fmt::format("{}: a measurement is {:.3f} s old", about, event.value);
    case Event::Kind::kOutOfRange:
      return fmt::format("{} is {}, out of its range", about, event.value);
    case Event::Kind::kFlag:
      return fmt::format("{} is up", about);
    case Event::Kind::kSwapped:
      return fmt::format("{} runs another program", about);
    case Event::Kind::kOverrun:
      return fmt::format("{} cycles missed", event.value);
    case Event::Kind::kFaulted:
      return fmt::format("{}: fault, from now on the safe command", about);
    case Event::Kind::kRaised:
      return about;
    case Event::Kind::kEventLost:
      return fmt::format("{} is lost: the queue of events is full", about);
    case Event::Kind::kStopped:
      return fmt::format("{} ends the run", about);
    case Event::Kind::kStarted:
      return fmt::format("the task {} starts", about);
    case Event::Kind::kHalted:
      return fmt::format("the task {} halts", about);
  }
  return "";
}

constexpr std::size_t kMaximumEventsTold = 20;

}  // namespace

void report(runtime::Host& host, const runtime::Recorder* recorder, bool timed) {
  const auto events = host.take_events();
  for (std::size_t i = 0; i < std::min(events.size(), kMaximumEventsTold); ++i)
    std::cerr << "cycle " << events[i].tick << ": " << describe(events[i]) << "\n";
  const runtime::HostStatistics statistics = host.statistics();
  if (events.size() > kMaximumEventsTold)
    std::cerr << events.size() - kMaximumEventsTold << " further events\n";
  if (statistics.events_lost > 0)
    std::cerr << statistics.events_lost << " events were not told: too many\n";
  std::cerr << "cycles     " << statistics.cycles << ", missed " << statistics.missed << "\n";
  if (statistics.raised + statistics.raised_lost > 0)
    std::cerr << "events     " << statistics.raised << " queued, " << statistics.raised_lost
              << " lost\n";
  if (timed) {
    std::cerr << "real time  " << to_string(host.real_time()) << "\n"
              << "jitter     " << to_string(*statistics.lateness) << "\n"
              << "execution  " << to_string(*statistics.execution) << "\n";
  }
  if (recorder != nullptr) std::cerr << "log        " << to_string(recorder->report()) << "\n";
}

std::string describe(const runtime::SwapReport& report) {
  std::string text;
  const auto say = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty())
      text += fmt::format("{}{} {}", text.empty() ? "" : "; ", what, fmt::join(names, ", "));
  };
  say("states carried over:", report.carried);
  say("converted:", report.converted);
  say("initialised:", report.initialised);
  say("set points kept:", report.kept);
  say("set:", report.set);
  return text.empty() ? "it has no states" : text;
}

}  // namespace sinew::cli

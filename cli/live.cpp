#include "live.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <iostream>
#include <optional>
#include <set>
#include <thread>

#include "output.h"
#include "pipeline.h"
#include "robot_tree.h"
#include "sinew/algorithm/attach.h"
#include "sinew/backend/jit.h"
#include "sinew/program/host_plan.h"
#include "sinew/robot/mujoco.h"
#include "sinew/robot/names.h"
#include "sinew/robot/print.h"
#include "sinew/robot/udp.h"
#include "sinew/runtime/host.h"

namespace sinew::cli {
namespace {

using runtime::Event;
using runtime::Host;

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

constexpr std::chrono::milliseconds kLook{20};  // how often the loop is looked at from outside

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error(Problem{{}, "", std::move(what), std::move(remedy), {}, {}});
}

// "1", or "1,2,3".
std::vector<double> numbers(const std::string& text, const std::string& option) {
  std::vector<double> result;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (at != end) {
    double value = 0;
    const auto [next, fault] = std::from_chars(at, end, value);
    if (fault != std::errc{} || !std::isfinite(value) || (next != end && *next != ','))
      fail("'" + text + "' is no list of numbers for " + option, "write them as 0.1,0.2");
    result.push_back(value);
    at = next == end ? end : next + 1;
  }
  return result;
}

// "NAME=NUMBERS"
std::pair<std::string, std::vector<double>> assignment(const std::string& text,
                                                       const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    fail("'" + text + "' assigns nothing for " + option, "write " + option + " NAME=VALUE");
  return {text.substr(0, equals), numbers(text.substr(equals + 1), option)};
}

std::map<std::string, double> start_of(const LiveOptions& options) {
  std::map<std::string, double> start;
  for (const std::string& each : options.start) {
    const auto [name, values] = assignment(each, "--start");
    if (values.size() != 1) fail("'" + each + "' is not one number", "start one joint at a time");
    start[name] = values[0];
  }
  return start;
}

std::shared_ptr<robot::Mujoco> simulated(Models& models, const QueryOptions& query,
                                         const LiveOptions& options) {
  const model::Tree tree = robot_tree(models, query);
  robot::MujocoOptions simulation;
  if (!options.scene.empty())
    simulation.scene = robot::parse_scene(read_input(options.scene), options.scene);
  for (const auto& [name, value] : start_of(options)) {
    if (name.find('.') != std::string::npos) {
      simulation.scene.start[name] = value;
      continue;
    }
    for (const model::Tree::Joint& joint : tree.joints)
      simulation.scene.start[name + "." + std::string(models.store.terms().text(joint.iri))] =
          value;
  }
  if (options.lockstep) simulation.lockstep_period_s = 1 / options.rate;
  return std::make_shared<robot::Mujoco>(tree, models.store.terms(), simulation);
}

// What only the simulation knows, as columns of the log.
void add_gauges(runtime::Recorder& recorder, const std::shared_ptr<robot::Mujoco>& robot) {
  using Signal = robot::Mujoco::Signal;
  const std::pair<const char*, Signal> gauges[] = {
      {"simulation-time", Signal::kTime}, {"phase", Signal::kPhase},  {"hand.x", Signal::kHandX},
      {"hand.y", Signal::kHandY},         {"hand.z", Signal::kHandZ}, {"contact", Signal::kContact},
      {"attached", Signal::kAttached}};
  for (const auto& [name, signal] : gauges)
    recorder.gauge(name, [robot, signal = signal] { return robot->signal(signal); });
}

// Without a `log` in the algorithm, whatever the host holds is recorded.
void log_everything(program::HostPlan& plan) {
  program::External log{"log", plan.iri, {{"label", "all"}}, {}};
  for (std::uint32_t i = 0; i < plan.blocks.size(); ++i)
    if (plan.blocks[i].role != program::Role::kConstant) log.blocks.push_back(i);
  plan.externals.push_back(std::move(log));
  plan.steps.push_back({true, static_cast<std::uint32_t>(plan.externals.size() - 1)});
}

program::HostPlan plan_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                          const LiveOptions& options) {
  const graph::Id algorithm = algorithm_of(models, files, query);
  if (!algorithm::has_robot(models.store.view(), algorithm)) {
    std::string safe = options.safe;
    if (safe.empty() && options.robot == "udp")
      fail("no safe command is declared", "say what is commanded on a fault: --safe 0");
    if (safe.empty()) safe = "0";  // nobody is hurt by a robot that is not there
    algorithm::attach_robot(models.store, algorithm,
                            {robot::interface_iri(options.robot), numbers(safe, "--safe")});
  }
  program::HostPlan plan =
      program::plan_for_host(models.store.view(), algorithm,
                             query.solver.empty() ? "program" : query.solver, &models.places);
  const bool logs = std::any_of(plan.externals.begin(), plan.externals.end(),
                                [](const program::External& e) { return e.operation == "log"; });
  if (!options.record.empty() && !logs) log_everything(plan);
  return plan;
}

// The same application on another robot: every interface that the algorithm names is this one.
void bind_robot(Host& host, const program::HostPlan& plan,
                const std::shared_ptr<runtime::RobotInterface>& robot, const std::string& name) {
  for (const program::External& external : plan.externals) {
    const std::string* iri = external.property("interface");
    if (iri == nullptr) continue;
    if (*iri != robot::interface_iri(name) && !host.bindings().robots.contains(*iri))
      std::cerr << "note: " << name << " takes the place of <" << *iri << ">\n";
    host.bindings().robots[*iri] = robot;
  }
}

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
  }
  return "";
}

constexpr std::size_t kMaximumEventsTold = 20;

void report(Host& host, const runtime::Recorder* recorder, bool timed) {
  const auto events = host.take_events();
  for (std::size_t i = 0; i < std::min(events.size(), kMaximumEventsTold); ++i)
    std::cerr << "cycle " << events[i].tick << ": " << describe(events[i]) << "\n";
  if (events.size() > kMaximumEventsTold)
    std::cerr << events.size() - kMaximumEventsTold << " further events\n";
  const runtime::HostStatistics statistics = host.statistics();
  std::cerr << "cycles     " << statistics.cycles << ", missed " << statistics.missed << "\n";
  if (timed) {
    std::cerr << "real time  " << to_string(host.real_time()) << "\n"
              << "jitter     " << to_string(*statistics.lateness) << "\n"
              << "execution  " << to_string(*statistics.execution) << "\n";
  }
  if (recorder != nullptr) std::cerr << "log        " << to_string(recorder->report()) << "\n";
}

// Until it has run for as long as asked, is interrupted, or faults.
void run_clocked(Host& host) {
  host.start();
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  while (interrupted == 0 && host.state() == runtime::State::kRunning && !host.has_ended())
    std::this_thread::sleep_for(kLook);
  host.stop();
}

void run_lockstep(Host& host, const LiveOptions& options) {
  for (const auto& [iri, robot] : host.bindings().robots) robot->start();
  if (host.bindings().recorder) host.bindings().recorder->start();
  const auto cycles = static_cast<std::uint64_t>(std::llround(options.seconds * options.rate));
  // Faster than the clock, but not faster than the log is written.
  constexpr std::uint64_t kCyclesAtOnce = 2000;
  for (std::uint64_t done = 0; done < cycles && host.state() != runtime::State::kFaulted;) {
    const std::uint64_t now = std::min(kCyclesAtOnce, cycles - done);
    host.step(now);
    done += now;
    if (host.bindings().recorder) host.bindings().recorder->drain();
  }
  for (const auto& [iri, robot] : host.bindings().robots) robot->stop();
  if (host.bindings().recorder) host.bindings().recorder->stop();
}

void check(const LiveOptions& options) {
  if (!(options.rate > 0)) fail("a rate of " + std::to_string(options.rate), "more than 0 Hz");
  if (options.lockstep && (options.robot != "mujoco" || !(options.seconds > 0)))
    fail("nothing to keep in lockstep with",
         "--lockstep goes with --robot mujoco and --for SECONDS");
}

}  // namespace

void add_live_options(CLI::App& app, LiveOptions& options) {
  const std::string group = "With a robot";
  const auto add = [&](const char* name, auto& value, const char* text) {
    return app.add_option(name, value, text)->group(group);
  };
  add("--robot", options.robot,
      "Run in a loop, with this robot: print (measurements that never change, commands printed), "
      "mujoco (simulated), udp (a bridge to hardware)")
      ->check(CLI::IsMember({"print", "mujoco", "udp"}));
  add("--rate", options.rate, "Cycles per second")->capture_default_str();
  add("--for", options.seconds, "Seconds (default: until interrupted)");
  add("--record", options.record,
      "Log file, .csv or .mcap, may be repeated; what the algorithm's logs name, or else all "
      "inputs, outputs and states");
  add("--set", options.set, "NAME=VALUE,…: an input that no robot measures; may be repeated");
  add("--start", options.start,
      "position.joint1=VALUE, or position=VALUE for all joints: where the simulated robot starts, "
      "what the printed one measures; may be repeated");
  add("--scene", options.scene,
      "What the simulated robot finds around it (JSON): table, object, an operator's hand");
  add("--safe", options.safe,
      "Command on a fault, for all joints or VALUE,VALUE,… (print, mujoco: 0)");
  add("--age-limit", options.age_limit, "Seconds after which a measurement is stale: a fault")
      ->capture_default_str();
  add("--local", options.local, "ADDRESS:PORT where measurements arrive (udp)")
      ->capture_default_str();
  add("--remote", options.remote, "ADDRESS:PORT where commands go (udp)");
  app.add_flag("--lockstep", options.lockstep,
               "Simulate step by step with the loop, as fast as it goes: the same run everywhere")
      ->group(group);
  app.add_flag("--catch-up", options.catch_up,
               "Run late cycles one right after the other instead of leaving them out")
      ->group(group);
}

int run_live(const ModelOptions& files, const QueryOptions& query, const LiveOptions& options,
             bool interpret) {
  check(options);
  const auto models = load(files);
  program::HostPlan plan = plan_of(*models, files, query, options);

  runtime::HostOptions host_options;
  host_options.period_s = 1 / options.rate;
  host_options.age_limit_s = options.age_limit;
  host_options.cycles = static_cast<std::uint64_t>(std::llround(options.seconds * options.rate));
  if (options.catch_up) host_options.late = runtime::LateCycles::kCatchUp;
  Host host(host_options);

  std::shared_ptr<runtime::Recorder> recorder;
  if (!options.record.empty()) {
    recorder = std::make_shared<runtime::Recorder>(runtime::RecorderOptions{options.record});
    host.bindings().recorder = recorder;
  }
  if (options.robot == "print") {
    robot::PrintOptions print{start_of(options),
                              [](const std::string& line) { std::cout << line << std::endl; }};
    bind_robot(host, plan, std::make_shared<robot::Print>(print), options.robot);
  } else if (options.robot == "mujoco") {
    const auto robot = simulated(*models, query, options);
    bind_robot(host, plan, robot, options.robot);
    if (recorder) add_gauges(*recorder, robot);
  } else {
    const model::Tree tree = robot_tree(*models, query);
    const auto robot = std::make_shared<robot::Udp>(
        tree, models->store.terms(), robot::UdpOptions{options.local, options.remote});
    std::cerr << "measurements are awaited at port " << robot->local_port() << "\n";
    bind_robot(host, plan, robot, options.robot);
  }
  if (std::string why; !interpret && !backend::jit_available(&why))
    std::cerr << "sinew run: interpreting, since " << why << "\n";
  host.add_task({"main", 1}, runtime::Executable::prepare(std::move(plan), host.bindings(),
                                                          {.interpret = interpret, .fast = false}));
  for (const std::string& each : options.set) {
    const auto [name, values] = assignment(each, "--set");
    host.set("main", name, values);
  }
  host.configure();
  if (options.lockstep)
    run_lockstep(host, options);
  else
    run_clocked(host);
  report(host, recorder.get(), !options.lockstep);
  const bool lost = recorder && !recorder->report().fault.empty();
  return host.state() == runtime::State::kFaulted || lost ? kFault : kOk;
}

}  // namespace sinew::cli

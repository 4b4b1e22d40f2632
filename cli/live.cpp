#include "live.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <sstream>
#include <thread>

#include "application.h"
#include "interruption.h"
#include "live_report.h"
#include "output.h"
#include "pipeline.h"
#include "robot_tree.h"
#include "sinew/backend/jit.h"
#include "sinew/program/host_plan.h"
#include "sinew/robot/mujoco.h"
#include "sinew/robot/names.h"
#include "sinew/robot/print.h"
#include "sinew/robot/udp.h"
#include "sinew/runtime/host.h"

namespace sinew::cli {
namespace {

using runtime::Host;

constexpr std::chrono::milliseconds kLook{20};  // how often the loop is looked at from outside

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error(Problem{{}, "", std::move(what), std::move(remedy), {}, {}});
}

// "NAME=NUMBERS"
std::pair<std::string, std::vector<double>> assignment(const std::string& text,
                                                       const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    fail("'" + text + "' assigns nothing for " + option, "write " + option + " NAME=VALUE");
  return {text.substr(0, equals), parse_numbers(text.substr(equals + 1), option)};
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
                                         const LiveOptions& options, double period_s) {
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
  if (options.lockstep) simulation.lockstep_period_s = period_s;
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

// A program that takes another one's place while the loop runs.
struct LateSwap {
  std::unique_ptr<runtime::Executable> next;
  std::string task;
  runtime::SwapRules rules;
  std::uint64_t cycle = 0;

  bool is_pending() const { return next != nullptr; }
  // A swap that is refused leaves the old program running.
  bool happen(Host& host) {
    try {
      const runtime::SwapReport report = host.swap(task, std::move(next), rules);
      std::cerr << "swapped " << task << ": " << describe(report) << "\n";
      return true;
    } catch (const Error& error) {
      std::cerr << error.what() << "\nthe swap is refused; " << task << " goes on as before\n";
      next = nullptr;
      return false;
    }
  }
};

struct Outcome {
  bool swapped = true;     // false: a swap was refused
  bool cut_short = false;  // by a signal, before it has run for as long as asked
};

// Where nobody reads what is printed any more, or it cannot be kept, there is no use in going on.
std::atomic<int> print_fault = 0;

void end_for_output(int fault) {
  print_fault = fault;
  interrupt(SIGPIPE);
}

void print_line(const std::string& line) {
  if (print_fault != 0) return;
  if (std::fputs((line + "\n").c_str(), stdout) != EOF && std::fflush(stdout) == 0) return;
  end_for_output(errno);
}

// Until it has run for as long as asked, is interrupted, or faults.
Outcome run_clocked(Host& host, LateSwap& swap, bool prints) {
  Outcome outcome;
  host.start();
  while (interruption() == 0 && host.state() == runtime::State::kRunning && !host.has_ended()) {
    if (swap.is_pending() && host.statistics().cycles >= swap.cycle)
      outcome.swapped = swap.happen(host);
    if (prints && print_fault == 0 && nobody_reads_output()) end_for_output(EPIPE);
    std::this_thread::sleep_for(kLook);
  }
  outcome.cut_short = interruption() != 0 && !host.has_ended();
  host.stop();
  return outcome;
}

Outcome run_lockstep(Host& host, LateSwap& swap, std::uint64_t cycles) {
  Outcome outcome;
  for (const auto& [iri, robot] : host.bindings().robots) robot->start();
  if (host.bindings().recorder) host.bindings().recorder->start();
  // Faster than the clock, but not faster than the log is written.
  constexpr std::uint64_t kCyclesAtOnce = 2000;
  std::uint64_t done = 0;
  while (done < cycles && interruption() == 0 && host.state() != runtime::State::kFaulted &&
         !host.has_ended()) {
    if (swap.is_pending() && done >= swap.cycle) outcome.swapped = swap.happen(host);
    std::uint64_t now = std::min(kCyclesAtOnce, cycles - done);
    if (swap.is_pending()) now = std::min(now, swap.cycle - done);
    host.step(now);
    done += now;
    if (host.bindings().recorder) host.bindings().recorder->drain();
  }
  outcome.cut_short = interruption() != 0 && done < cycles;
  for (const auto& [iri, robot] : host.bindings().robots) robot->stop();
  if (host.bindings().recorder) host.bindings().recorder->stop();
  return outcome;
}

void check(const LiveOptions& options) {
  if (options.rate && !(*options.rate > 0))
    fail("a rate of " + std::to_string(*options.rate), "more than 0 Hz");
  if (!(options.age_limit > 0))
    fail("an age limit of " + std::to_string(options.age_limit) + " s", "more than 0 s");
  if (options.seconds < 0)
    fail("a run of " + std::to_string(options.seconds) + " s", "more than 0 s");
  if (options.lockstep && (options.robot != "mujoco" || !(options.seconds > 0)))
    fail("nothing to keep in lockstep with",
         "--lockstep goes with --robot mujoco and --for SECONDS");
  if (options.swap.empty() && options.swap_at)
    fail("--swap-at without a program", "name it by --swap ALGO.jsonld");
  if (!options.swap.empty() && !options.swap_at)
    fail("it is not said when --swap is to happen", "add --swap-at SECONDS");
  if (options.swap_at && !(*options.swap_at >= 0))
    fail("--swap-at " + std::to_string(*options.swap_at), "0 s or later");
}

bool commands(const PlannedTask& task) {
  return std::any_of(task.plan.externals.begin(), task.plan.externals.end(),
                     [](const program::External& each) { return each.operation == "write"; });
}

std::string ending() {
  if (print_fault == 0) return std::string(signal_name(interruption()));
  return std::string("standard output, which cannot be written: ") + std::strerror(print_fault);
}

// The robot that all tasks speak to.
std::shared_ptr<runtime::RobotInterface> robot_of(Models& models, const QueryOptions& query,
                                                  const LiveOptions& options, double period_s,
                                                  runtime::Recorder* recorder) {
  if (options.robot == "print") {
    outlive_broken_pipes();
    return std::make_shared<robot::Print>(robot::PrintOptions{start_of(options), print_line});
  }
  if (options.robot == "mujoco") {
    const auto robot = simulated(models, query, options, period_s);
    if (recorder != nullptr) add_gauges(*recorder, robot);
    return robot;
  }
  const model::Tree tree = robot_tree(models, query);
  robot::UdpOptions udp;
  udp.local = options.local;
  udp.remote = options.remote;
  udp.gives_up = [] { return interruption() != 0; };
  const auto robot = std::make_shared<robot::Udp>(tree, models.store.terms(), udp);
  std::cerr << "measurements are awaited at port " << robot->local_port() << "\n";
  return robot;
}

// Each set point that is named, in every task that has it.
void set_points_of(Host& host, const Application& application, const LiveOptions& options,
                   LateSwap& swap) {
  for (const std::string& each : options.set) {
    const auto [name, values] = assignment(each, "--set");
    std::string known;
    bool found = false;
    for (const PlannedTask& task : application.tasks) {
      for (const std::uint32_t at : set_points(task.plan)) {
        const program::Variable& point = task.plan.blocks[at];
        known += (known.empty() ? "" : ", ") + point.name;
        if (point.name != name && point.iri != name) continue;
        host.set(task.options.name, name, values);
        found = true;
      }
    }
    if (swap.is_pending())
      for (const std::uint32_t point : swap.next->set_points())
        if (!found && (swap.next->storage().about(point).name == name ||
                       swap.next->storage().about(point).iri == name)) {
          swap.rules.set_points.emplace_back(name, values);
          found = true;
        }
    if (!found)
      fail("there is no set point '" + name + "'",
           known.empty() ? "nothing is to be set" : "set " + known);
  }
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
  add("--rate", options.rate,
      "Cycles per second (default: what the task's controllers state, otherwise 1000; the tasks of "
      "a "
      "host model have periods of their own)");
  add("--for", options.seconds, "Seconds (default: until interrupted)");
  add("--record", options.record,
      "Log file, .csv or .mcap, may be repeated; what the algorithm's logs name, or else all "
      "inputs, outputs and states");
  add("--set", options.set, "NAME=VALUE,…: an input that no robot measures; may be repeated");
  add("--swap", options.swap,
      "Algorithm (of 'sinew synth') that takes the running one's place at --swap-at, between two "
      "cycles; states are carried over, or become what sa:at-swap declares");
  add("--swap-at", options.swap_at, "Seconds of cycles after which --swap happens");
  add("--swap-task", options.swap_task, "Task that goes over to it, where there are several");
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

std::string misplaced_option(const CLI::App& app, const std::string& robot) {
  struct Use {
    const char *option, *robots;  // "rows": without a robot
  };
  constexpr Use kUses[] = {
      {"--input", "rows"},
      {"--output", "rows"},
      {"--rate", "print mujoco udp"},
      {"--for", "print mujoco udp"},
      {"--record", "print mujoco udp"},
      {"--set", "print mujoco udp"},
      {"--swap", "print mujoco udp"},
      {"--swap-at", "print mujoco udp"},
      {"--swap-task", "print mujoco udp"},
      {"--start", "print mujoco"},
      {"--scene", "mujoco"},
      {"--safe", "print mujoco udp"},
      {"--age-limit", "print mujoco udp"},
      {"--local", "udp"},
      {"--remote", "udp"},
      {"--lockstep", "mujoco"},
      {"--catch-up", "print mujoco udp"},
  };
  const std::string here = robot.empty() ? "rows" : robot;
  for (const Use& use : kUses) {
    if (app.count(use.option) == 0) continue;
    std::istringstream robots(use.robots);
    std::string one, others;
    bool used = false;
    while (robots >> one) {
      used |= one == here;
      others += (others.empty() ? "" : " or ") +
                (one == "rows" ? std::string("--input ROWS.csv") : "--robot " + one);
    }
    if (!used) return std::string(use.option) + " goes with " + others;
  }
  return {};
}

int run_live(const ModelOptions& files, const QueryOptions& query, const LiveOptions& options,
             bool interpret) {
  check(options);
  const auto models = load(files);
  const Application application = application_of(*models, files, query, options);

  runtime::HostOptions host_options;
  host_options.period_s = application.period_s;
  host_options.age_limit_s = options.age_limit;
  host_options.cycles =
      static_cast<std::uint64_t>(std::llround(options.seconds / application.period_s));
  if (application.event_capacity) host_options.event_capacity = *application.event_capacity;
  if (options.catch_up) host_options.late = runtime::LateCycles::kCatchUp;
  Host host(host_options);

  std::shared_ptr<runtime::Recorder> recorder;
  if (!options.record.empty()) {
    recorder = std::make_shared<runtime::Recorder>(runtime::RecorderOptions{options.record});
    host.bindings().recorder = recorder;
  }
  const auto robot = robot_of(*models, query, options, application.period_s, recorder.get());
  for (const PlannedTask& task : application.tasks)
    bind_robot(host, task.plan, robot, options.robot);
  if (std::string why; !interpret && !backend::jit_available(&why))
    std::cerr << "sinew run: interpreting, since " << why << "\n";
  const runtime::PrepareOptions how{.interpret = interpret, .fast = false};
  for (const PlannedTask& task : application.tasks)
    host.add_task(task.options, runtime::Executable::prepare(task.plan, host.bindings(), how));
  if (std::none_of(application.tasks.begin(), application.tasks.end(), commands))
    std::cerr << "note: no joint force is computed, so the robot is only watched\n";
  for (const runtime::Connection& connection : application.connections) host.connect(connection);
  for (const runtime::Reaction& reaction : application.reactions) host.react(reaction);

  LateSwap swap;
  if (!options.swap.empty()) {
    ModelOptions later = files;
    later.files = {options.swap};
    const auto others = load(later);
    program::HostPlan plan = plan_of(*others, later, {}, options);
    bind_robot(host, plan, robot, options.robot);
    swap.task = options.swap_task;
    if (swap.task.empty() && application.tasks.size() > 1)
      fail("--swap does not say which task goes over to it", "add --swap-task NAME");
    if (swap.task.empty()) swap.task = application.tasks.front().options.name;
    swap.cycle = static_cast<std::uint64_t>(std::llround(*options.swap_at / application.period_s));
    swap.next = runtime::Executable::prepare(std::move(plan), host.bindings(), how);
  }
  set_points_of(host, application, options, swap);
  host.configure();
  const Interruptible interruptible;
  Outcome outcome;
  try {
    outcome = options.lockstep ? run_lockstep(host, swap, host_options.cycles)
                               : run_clocked(host, swap, options.robot == "print");
  } catch (const Error& error) {
    if (interruption() == 0) throw;
    std::cerr << error.what() << "\nended by " << signal_name(interruption())
              << " before the first cycle\n";
    return interrupted_exit_code(interruption());
  }
  if (interruption() != 0) std::cerr << "ended by " << ending() << "\n";
  report(host, recorder.get(), !options.lockstep);
  const bool never = swap.is_pending();
  if (never) std::cerr << "the run ended before --swap-at\n";
  const bool lost = recorder && !recorder->report().fault.empty();
  if (host.state() == runtime::State::kFaulted || lost || !outcome.swapped) return kFault;
  if (outcome.cut_short && print_fault != 0 && print_fault != EPIPE) return kFault;
  // Without --for a signal is how a run ends.
  if (outcome.cut_short && (options.seconds > 0 || print_fault != 0))
    return interrupted_exit_code(interruption());
  return never ? kFault : kOk;
}

}  // namespace sinew::cli

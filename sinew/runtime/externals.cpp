#include "sinew/runtime/externals.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "sinew/base/error.h"

namespace sinew::runtime {
namespace {

[[noreturn]] void fail(const program::External& external, std::string what, std::string remedy) {
  throw Error(Problem{
      {}, external.iri, external.operation + ": " + std::move(what), std::move(remedy), {}, {}});
}

const std::string& require(const program::External& external, std::string_view name,
                           std::string remedy) {
  const std::string* value = external.property(name);
  if (value == nullptr) fail(external, fmt::format("has no sa:{}", name), std::move(remedy));
  return *value;
}

// "1 2.5 -3": the numbers of a property.
std::vector<double> numbers_of(const program::External& external, std::string_view name,
                               const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  for (;;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) break;
    numbers.push_back(number);
    at = end;
  }
  while (*at == ' ') ++at;
  if (*at != 0) fail(external, fmt::format("sa:{} is '{}'", name, text), "list numbers");
  return numbers;
}

// One number for each of `count`, from a list of as many or from a single one.
std::vector<double> one_for_each(const program::External& external, std::string_view name,
                                 std::size_t count, std::string remedy) {
  std::vector<double> numbers =
      numbers_of(external, name, require(external, name, std::move(remedy)));
  if (numbers.size() == 1) numbers.resize(count, numbers[0]);
  if (numbers.size() != count)
    fail(external, fmt::format("sa:{} has {} numbers for {}", name, numbers.size(), count),
         "state one for each number, or one for all");
  return numbers;
}

std::size_t count_numbers(const program::External& external, const Storage& storage) {
  std::size_t count = 0;
  for (const std::uint32_t block : external.blocks) count += storage.about(block).size;
  return count;
}

std::string label_of(const program::External& external) {
  const std::string* label = external.property("label");
  return label != nullptr ? *label : external.operation;
}

std::shared_ptr<RobotInterface> robot_of(const program::External& external,
                                         const Bindings& bindings) {
  const std::string& iri =
      require(external, "interface", "name a robot interface, as sr:print, sr:mujoco or sr:udp");
  const auto found = bindings.robots.find(iri);
  if (found != bindings.robots.end()) return found->second;
  std::string known;
  for (const auto& [name, robot] : bindings.robots) known += " <" + name + ">";
  fail(external, "no robot is bound to <" + iri + ">",
       known.empty() ? "bind one to the host" : "bound are" + known);
}

BoundExternal bind_read(const program::External& external, Storage& storage,
                        const Bindings& bindings) {
  const auto robot = robot_of(external, bindings);
  std::vector<Transfer> transfers;
  for (const std::uint32_t block : external.blocks)
    transfers.push_back({robot->measurement(storage.about(block)), storage.numbers(block).data(),
                         storage.about(block).size});
  const std::string label = label_of(external);
  return {[robot, transfers, label](const Cycle& cycle) {
            const Nanoseconds taken = robot->read(transfers);
            const Nanoseconds age = taken == 0 ? cycle.age_limit + 1 : now() - taken;
            if (age <= cycle.age_limit) return Verdict::kContinue;
            Event event{Event::Kind::kStale, cycle.tick, cycle.start, to_seconds(age), {}};
            event.set_about(label.c_str());
            cycle.events->note(event);
            return Verdict::kFault;
          },
          {}};
}

BoundExternal bind_write(const program::External& external, Storage& storage,
                         const Bindings& bindings) {
  const auto robot = robot_of(external, bindings);
  std::vector<Transfer> transfers, safe_transfers;
  auto safe = std::make_shared<std::vector<double>>(
      one_for_each(external, "safe", count_numbers(external, storage),
                   "declare what is commanded on a fault: one number for each, or one for all"));
  std::size_t at = 0;
  for (const std::uint32_t block : external.blocks) {
    const program::Variable& about = storage.about(block);
    transfers.push_back({robot->command(about), storage.numbers(block).data(), about.size});
    safe_transfers.push_back({transfers.back().channel, safe->data() + at, about.size});
    at += about.size;
  }
  return {[robot, transfers](const Cycle&) {
            robot->write(transfers);
            return Verdict::kContinue;
          },
          [robot, safe_transfers, safe](const Cycle&) {
            robot->write(safe_transfers);
            return Verdict::kContinue;
          },
          robot.get()};
}

std::shared_ptr<Recorder> recorder_of(const program::External& external, const Bindings& bindings) {
  if (bindings.recorder == nullptr)
    fail(external, "there is no recorder", "give the log a file, or leave the closure out");
  return bindings.recorder;
}

BoundExternal bind_log(const program::External& external, Storage& storage,
                       const Bindings& bindings) {
  const auto recorder = recorder_of(external, bindings);
  std::vector<std::string> columns, units;
  const std::string* prefix = external.property("prefix");
  for (const std::uint32_t block : external.blocks) {
    for (const std::string& column : column_names(storage.about(block)))
      columns.push_back(prefix != nullptr ? *prefix + column : column);
    units.resize(columns.size(), storage.about(block).unit);
  }
  const auto places = recorder->channel(label_of(external), columns, units);
  struct Copy {
    const double* from;
    std::uint32_t to;
  };
  std::vector<Copy> copies;
  for (const std::uint32_t block : external.blocks)
    for (const double& number : storage.numbers(block))
      copies.push_back({&number, places[copies.size()]});
  return {[recorder, copies](const Cycle&) {
            double* row = recorder->row();
            for (const Copy& copy : copies) row[copy.to] = *copy.from;
            return Verdict::kContinue;
          },
          {}};
}

// Seconds from the start of the cycle to where the probe stands.
BoundExternal bind_probe(const program::External& external, Storage&, const Bindings& bindings) {
  const auto recorder = recorder_of(external, bindings);
  const std::string label =
      require(external, "label", "name the probe; its column in the log is called so");
  const std::uint32_t place = recorder->channel(label, {label}, {"SEC"})[0];
  return {[recorder, place](const Cycle& cycle) {
            recorder->row()[place] = to_seconds(now() - cycle.start);
            return Verdict::kContinue;
          },
          {}};
}

bool stops(const program::External& external) {
  const std::string& action =
      require(external, "action", "sa:stop ends the commands, sa:report only tells");
  if (action.ends_with("stop")) return true;
  if (action.ends_with("report")) return false;
  fail(external, "sa:action is '" + action + "'", "it is sa:stop or sa:report");
}

struct Watched {
  const double* number;
  double lower, upper;
  std::string about;
};

Action watch(std::vector<Watched> numbers, Event::Kind kind, bool stop) {
  return [numbers = std::move(numbers), kind, stop, broken = false](const Cycle& cycle) mutable {
    const Watched* found = nullptr;
    for (const Watched& watched : numbers) {
      // Written so that what is not a number is out of range too.
      if (!(*watched.number >= watched.lower && *watched.number <= watched.upper)) {
        found = &watched;
        break;
      }
    }
    // Told once, until all is well again.
    if (found != nullptr && !broken) {
      Event event{kind, cycle.tick, cycle.start, *found->number, {}};
      event.set_about(found->about.c_str());
      cycle.events->note(event);
    }
    broken = found != nullptr;
    return broken && stop ? Verdict::kFault : Verdict::kContinue;
  };
}

BoundExternal bind_check_range(const program::External& external, Storage& storage,
                               const Bindings&) {
  const std::size_t count = count_numbers(external, storage);
  const std::string remedy = "state the least and the greatest number that are allowed";
  const auto lower = one_for_each(external, "lower", count, remedy);
  const auto upper = one_for_each(external, "upper", count, remedy);
  std::vector<Watched> numbers;
  for (const std::uint32_t block : external.blocks) {
    const auto names = column_names(storage.about(block));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::size_t at = numbers.size();
      if (!(lower[at] <= upper[at]))
        fail(external, fmt::format("the range of {} is {} to {}", names[i], lower[at], upper[at]),
             "the lower limit comes first");
      numbers.push_back({&storage.numbers(block)[i], lower[at], upper[at], names[i]});
    }
  }
  return {watch(std::move(numbers), Event::Kind::kOutOfRange, stops(external)), {}};
}

BoundExternal bind_check_flag(const program::External& external, Storage& storage,
                              const Bindings&) {
  std::vector<Watched> numbers;
  for (const std::uint32_t block : external.blocks) {
    const auto names = column_names(storage.about(block));
    for (std::size_t i = 0; i < names.size(); ++i)
      numbers.push_back({&storage.numbers(block)[i], 0, 0, names[i]});
  }
  return {watch(std::move(numbers), Event::Kind::kFlag, stops(external)), {}};
}

struct Row {
  std::string_view operation;
  BoundExternal (*bind)(const program::External&, Storage&, const Bindings&);
};
constexpr Row kRows[] = {
    {"read", bind_read},
    {"write", bind_write},
    {"log", bind_log},
    {"probe-time", bind_probe},
    {"check-range", bind_check_range},
    {"check-flag", bind_check_flag},
};

}  // namespace

BoundExternal bind_external(const program::External& external, Storage& storage,
                            const Bindings& bindings) {
  for (const Row& row : kRows)
    if (row.operation == external.operation) return row.bind(external, storage, bindings);
  fail(external, "the host does not know how to carry it out", "use an operator of the catalogue");
}

std::vector<std::string> column_names(const program::Variable& block) {
  if (block.size == 1) return {block.name};
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < block.size; ++i)
    names.push_back(block.name + "[" + std::to_string(i) + "]");
  return names;
}

}  // namespace sinew::runtime

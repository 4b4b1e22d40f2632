#include "sinew/robot/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "sinew/base/error.h"

namespace sinew::robot {
namespace {

constexpr std::chrono::milliseconds kPause{5};
// Measurements are handed over as (channel, number) in a fixed table.
constexpr std::size_t kMaximumMeasurements = 1024;

}  // namespace

Print::Print(PrintOptions options) : options_(std::move(options)) {
  values_.reserve(kMaximumMeasurements);
}

Print::~Print() { stop(); }

runtime::Channel Print::measurement(const program::Variable& block) const {
  auto found = options_.measurements.find(block.name);
  if (found == options_.measurements.end())
    found = options_.measurements.find(block.name.substr(0, block.name.find('.')));
  if (found == options_.measurements.end() || block.size != 1) {
    throw Error(Problem{{},
                        block.iri,
                        "the printed robot has no measurement for " + block.name,
                        "state one, as position.joint1=0.2 or, for all joints, position=0.2",
                        {},
                        {}});
  }
  const std::lock_guard lock(naming_);
  if (values_.size() == kMaximumMeasurements)
    throw Error(Problem{{}, block.iri, "too many measurements", "at most 1024", {}, {}});
  values_.push_back(found->second);
  return static_cast<runtime::Channel>(values_.size() - 1);
}

runtime::Channel Print::command(const program::Variable& block) const {
  const std::lock_guard lock(naming_);
  const auto found = std::find(commands_.begin(), commands_.end(), block.name);
  if (found != commands_.end()) return static_cast<runtime::Channel>(found - commands_.begin());
  if (block.size != 1 || commands_.size() == kMaximumCommands)
    throw Error(Problem{{},
                        block.iri,
                        "cannot print " + block.name,
                        "at most 128 commands, of one number each",
                        {},
                        {}});
  commands_.push_back(block.name);
  return static_cast<runtime::Channel>(commands_.size() - 1);
}

void Print::start() {
  if (printer_.joinable()) return;
  ending_ = false;
  printer_ = std::thread([this] { print_all(); });
}

void Print::stop() {
  if (!printer_.joinable()) return;
  ending_ = true;
  printer_.join();
}

runtime::Nanoseconds Print::read(std::span<const runtime::Transfer> measurements) noexcept {
  for (const runtime::Transfer& transfer : measurements)
    transfer.numbers[0] = values_.data()[transfer.channel];
  return runtime::now();
}

void Print::write(std::span<const runtime::Transfer> commands) noexcept {
  for (const runtime::Transfer& transfer : commands) row_[transfer.channel] = transfer.numbers[0];
  if (!rows_.push(row_.data())) dropped_.fetch_add(1, std::memory_order_relaxed);
}

void Print::print_all() {
  std::vector<double> row(kMaximumCommands),
      before(kMaximumCommands, std::numeric_limits<double>::quiet_NaN());
  const auto print_pending = [&] {
    while (rows_.pop(row.data())) {
      std::vector<std::string> names;
      {
        const std::lock_guard lock(naming_);
        names = commands_;
      }
      if (options_.only_changes &&
          std::equal(row.data(), row.data() + names.size(), before.begin()))
        continue;
      before = row;
      std::string line;
      for (std::size_t i = 0; i < names.size(); ++i)
        line += fmt::format("{}{} {}", i == 0 ? "" : "  ", names[i], row[i]);
      options_.print(line);
    }
  };
  while (!ending_.load(std::memory_order_acquire)) {
    print_pending();
    std::this_thread::sleep_for(kPause);
  }
  print_pending();
}

}  // namespace sinew::robot

// The robot that is not there: its measurements never change, its commands are printed. For looking
// at what a program commands before it meets a robot.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "sinew/runtime/ring.h"
#include "sinew/runtime/robot_interface.h"

namespace sinew::robot {

struct PrintOptions {
  // Numbers by a block's name ("position.joint1") or, for all blocks of a kind, the part before the
  // dot ("position"). A block that is read and not here is an error.
  std::map<std::string, double> measurements;
  // Gets each line; called from the printing thread.
  std::function<void(const std::string&)> print;
  // Commands that are equal to the ones before are not printed again.
  bool only_changes = true;
};

class Print final : public runtime::RobotInterface {
 public:
  explicit Print(PrintOptions options);
  ~Print() override;

  runtime::Channel measurement(const program::Variable& block) const override;
  runtime::Channel command(const program::Variable& block) const override;
  void start() override;
  void stop() override;
  runtime::Nanoseconds read(std::span<const runtime::Transfer> measurements) noexcept override;
  void write(std::span<const runtime::Transfer> commands) noexcept override;

  // Sets of commands that came faster than they could be printed.
  std::uint64_t dropped() const { return dropped_.load(); }

 private:
  static constexpr std::size_t kMaximumCommands = 128;  // channels
  void print_all();

  PrintOptions options_;
  // Channels are places in these; they only grow, and only the binding thread and the printing one
  // use the names.
  mutable std::mutex naming_;
  mutable std::vector<std::string> commands_;
  mutable std::vector<double> values_;  // of measurements, fixed when they are bound
  runtime::RowRing rows_{kMaximumCommands, 1024};
  std::vector<double> row_ = std::vector<double>(kMaximumCommands);  // the loop's
  std::thread printer_;
  std::atomic<bool> ending_ = false;
  std::atomic<std::uint64_t> dropped_ = 0;
};

}  // namespace sinew::robot

// What `read` and `write` closures talk to: a robot, a simulation, a bridge.
//
// Design time: each data block is matched to one of the robot's channels. Real time: whole sets of
// channels are read or written at once; both return soon, whatever the robot does, and never throw.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sinew/program/program.h"
#include "sinew/runtime/clock.h"

namespace sinew::runtime {

using Channel = std::uint32_t;

// One data block on its way from or to a channel.
struct Transfer {
  Channel channel = 0;
  double* numbers = nullptr;
  std::uint32_t size = 0;
};

class RobotInterface {
 public:
  virtual ~RobotInterface() = default;

  // The channel that delivers, or takes, this block. Throws Error when the robot has none. May be
  // called while another thread reads and writes (a new program is being prepared).
  virtual Channel measurement(const program::Variable& block) const = 0;
  virtual Channel command(const program::Variable& block) const = 0;

  // Before the first cycle, after the last. Not real time; start throws Error.
  virtual void start() {}
  virtual void stop() {}

  // Fills all transfers from one measurement and returns when it was taken (runtime::now()'s
  // clock); 0: there is none yet.
  virtual Nanoseconds read(std::span<const Transfer> measurements) noexcept = 0;
  // Hands over one set of commands.
  virtual void write(std::span<const Transfer> commands) noexcept = 0;
  // Every task of this cycle has run: what is simulated in lockstep moves on by one period.
  virtual void end_cycle() noexcept {}
};

}  // namespace sinew::runtime

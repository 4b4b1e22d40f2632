// A robot behind a bridge: measurements come in, commands go out, as frames (frame.h) over UDP.
//
// The sockets never block: a cycle takes at most kFramesPerCycle frames and uses the newest. A
// measurement's age counts from when it arrived here; a frame that was seen before, or comes out of
// order, is no new measurement. While nothing new arrives the measurement grows old, and the host's
// watchdog does its work.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sinew/robot/frame.h"
#include "sinew/robot/joints.h"
#include "sinew/runtime/robot_interface.h"

namespace sinew::robot {

struct UdpOptions {
  std::string local =
      "127.0.0.1:0";           // ADDRESS:PORT where measurements arrive; port 0: any free one
  std::string remote;          // ADDRESS:PORT where commands go
  double start_timeout_s = 5;  // for the first measurement
  std::function<bool()> gives_up = {};  // asked while it waits for it
};

class Udp final : public runtime::RobotInterface {
 public:
  Udp(const model::Tree& tree, const graph::Terms& terms, UdpOptions options);  // throws Error
  ~Udp() override;
  Udp(const Udp&) = delete;
  Udp& operator=(const Udp&) = delete;

  runtime::Channel measurement(const program::Variable& block) const override;
  runtime::Channel command(const program::Variable& block) const override;
  void start() override;  // waits for the first measurement; throws Error when none comes
  runtime::Nanoseconds read(std::span<const runtime::Transfer> measurements) noexcept override;
  void write(std::span<const runtime::Transfer> commands) noexcept override;

  std::uint16_t local_port() const;
  // Datagrams that were no frames, or of another layout.
  std::uint64_t refused() const { return refused_.load(std::memory_order_relaxed); }
  // What both ends must agree on.
  std::uint32_t measurement_layout() const { return measurement_layout_; }
  std::uint32_t command_layout() const { return command_layout_; }

  static constexpr int kFramesPerCycle = 32;

 private:
  bool take_frames() noexcept;

  Joints joints_;
  UdpOptions options_;
  int socket_ = -1;
  std::uint32_t measurement_layout_ = 0, command_layout_ = 0;
  std::vector<double> newest_, incoming_, command_;
  std::uint32_t seen_ = 0, sent_ = 0;
  runtime::Nanoseconds arrived_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;
};

}  // namespace sinew::robot
